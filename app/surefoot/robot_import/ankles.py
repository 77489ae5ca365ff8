"""The ankle: which of the leg's last two joints pitches the foot and which rolls it, and the foot's frame."""

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.problem import RefusedError

_FARTHEST_DEG = 45.0  # of a joint's axis from the axis that it is named after


@record
class Ankle:
    """An ankle in the posture.

    Attributes:
        pitch, roll: hinges.
        centre_in_world: (3,) the point of the lower axis nearest to the upper one: fixed in the foot [m].
        gap_m: distance between the two axes.
        how: how the joints were found.
    """

    pitch: int
    roll: int
    centre_in_world: np.ndarray
    gap_m: float
    how: str

    @property
    def lower(self) -> int:
        """The joint next to the foot, whose axis is fixed in the foot."""
        return max(self.pitch, self.roll)


def find_ankle(tree: KinematicTree, leg: list[int], said: tuple[str, str] | None, where: str) -> Ankle:
    """The ankle of a leg.

    Args:
        tree: the robot in its posture.
        leg: its hinges from the hip down.
        said: names of the pitch and the roll joint, if robot.toml has them.
        where: key of robot.toml, for an error.

    Raises:
        InvalidInput: a named joint is not in the leg.
        RefusedError: the last two joints do not pitch and roll the foot.
    """
    names = tree.joint_names(leg)
    if said is not None:
        for name in said:
            if name not in names:
                raise InvalidInput(where, name, "is no joint of that leg", names)
        pitch, roll = (leg[names.index(name)] for name in said)
        how = "named in robot.toml"
    else:
        pitch, roll = _by_axes(tree, leg)
        how = "the last two joints of the leg, told apart by their axes"
    upper, lower = sorted((pitch, roll))
    centre, gap = _nearest_point(tree.anchor(lower), tree.axis(lower), tree.anchor(upper), tree.axis(upper))
    return Ankle(pitch, roll, centre, gap, how)


def _by_axes(tree: KinematicTree, leg: list[int]) -> tuple[int, int]:
    """Pitch turns about the base's y axis, roll about its x axis."""
    last = leg[-2:]
    base = tree.rotation(tree.base)
    along = {joint: np.abs(base.T @ tree.axis(joint)) for joint in last}
    pitch = max(last, key=lambda joint: along[joint][1] - along[joint][0])
    roll = next(joint for joint in last if joint != pitch)
    least = np.cos(np.radians(_FARTHEST_DEG))
    if along[pitch][1] < least or along[roll][0] < least:
        raise RefusedError(
            "ankles",
            f"the last joints of a leg, {' and '.join(tree.joint_names(last))}, do not pitch and roll it; "
            f"their axes in the base are {' and '.join(_shown(base.T @ tree.axis(joint)) for joint in last)}",
            "name them in robot.toml (ankle_joints = [pitch, roll]), or say how the base's frame lies where not x "
            "forward, z up ([base] forward = ..., up = ...); nothing helps an ankle that has no roll joint",
        )
    return pitch, roll


def _shown(axis: np.ndarray) -> str:
    return f"({', '.join(f'{value:.2f}' for value in axis)})"


def _nearest_point(p: np.ndarray, u: np.ndarray, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, float]:
    """The point of the line p + s u nearest to the line q + t v, and the distance of the lines [m]."""
    common = np.cross(u, v)
    length = np.linalg.norm(common)
    if length < 1e-6:  # parallel: every point is as near
        return p, float(np.linalg.norm(np.cross(q - p, u)))
    s = np.dot(np.cross(q - p, v), common) / length**2
    return p + s * u, float(abs(np.dot(q - p, common)) / length)
