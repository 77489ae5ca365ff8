"""The posture that a robot is looked at in: keyframe and robot.toml, else straight with a little bend in the knees."""

from collections.abc import Mapping

import mujoco
import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot_import.base_frame import BaseAxes, turned_orientation
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.mjcf_source import joint_type
from surefoot.robot_import.normalise import robot_bodies

_BEND_RAD = 0.4  # of the knees; half of it at hip and ankle: straight knees make H singular
_STRAIGHT_RAD = 0.1  # less bent than this is straight
_ROUNDING_RAD = 1e-6  # robot init writes angles to so many digits
_SIDEWAYS = 0.8  # least part of a pitch axis along the base's y


@record
class Posture:
    """Where the joints are.

    Attributes:
        qpos: configuration (nq,) of the plain MJCF.
        how: where it comes from.
        is_as_said: whether all of it is in a keyframe or in robot.toml.
    """

    qpos: np.ndarray
    how: str
    is_as_said: bool

    def angles(self, model: mujoco.MjModel) -> dict[str, float]:
        """Joint name -> angle [rad]."""
        return {name: float(self.qpos[adr]) for name, adr in _addresses(model).items()}


def choose_posture(
    model: mujoco.MjModel,
    original: mujoco.MjModel,
    keyframe: str | None,
    keyframe_qpos: np.ndarray,
    said: Mapping[str, float],
    base_axes: BaseAxes | None = None,
) -> Posture:
    """The posture.

    Args:
        model: the plain one.
        original: as its owner wrote it.
        keyframe: name of the keyframe of the original, None: there is none.
        keyframe_qpos: its configuration.
        said: joint name -> angle in robot.toml [rad].
        base_axes: of the base of the original, where the plain one has been turned: without a keyframe it is upright.

    Raises:
        InvalidInput: robot.toml names a joint that is not there, or an angle that is outside the joint's range.
    """
    addresses = _addresses(model)
    for name, value in said.items():
        if name not in addresses:
            raise InvalidInput(f"posture.{name}", value, "the robot has no such joint", addresses)
        lower, upper = model.joint(name).range.tolist()
        if not lower - _ROUNDING_RAD <= value <= upper + _ROUNDING_RAD:
            reason = "is outside the joint's range; which way it bends is the model's"
            raise InvalidInput(f"posture.{name}", value, reason, [f"{lower:.4g} to {upper:.4g} rad"])
    qpos = model.qpos0.copy()
    for name, address in addresses.items():
        there = int(original.joint(name).qposadr[0])
        qpos[address] = said.get(name, keyframe_qpos[there] - original.qpos0[there])
    drawn = qpos[3:7].copy()
    qpos[:7] = _base_pose(original, keyframe_qpos)
    if base_axes is not None:
        qpos[3:7] = drawn if keyframe is None else turned_orientation(qpos[3:7], base_axes)
    sources = [f"keyframe {keyframe}"] if keyframe else []
    sources += [f"{len(said)} joints by robot.toml"] if said else []
    return Posture(qpos, " and ".join(sources), bool(sources))


def _base_pose(original: mujoco.MjModel, qpos: np.ndarray) -> np.ndarray:
    """(7,) position [m] and orientation, w first, of the base in a configuration of the original, however it hangs."""
    base = robot_bodies(original)[0]
    joint = int(original.body_jntadr[base])
    if joint >= 0 and joint_type(original, joint) == "free":
        first = int(original.jnt_qposadr[joint])
        return qpos[first : first + 7]
    data = mujoco.MjData(original)
    data.qpos[:] = qpos
    mujoco.mj_kinematics(original, data)
    return np.concatenate((data.xpos[base], data.xquat[base]))


def knees_are_straight(tree: KinematicTree, legs: tuple[list[int], list[int]]) -> bool:
    """Whether hip, knee and ankle lie (nearly) on a line in a leg: H is singular there."""
    for leg in legs:
        pitch = _pitch_joints(tree, leg)
        if pitch is None:
            continue
        thigh, shank = (tree.anchor(pitch[i + 1]) - tree.anchor(pitch[i]) for i in (0, 1))
        y = tree.rotation(tree.base)[:, 1]
        thigh, shank = (part - (part @ y) * y for part in (thigh, shank))
        angle = np.arctan2(np.linalg.norm(np.cross(thigh, shank)), thigh @ shank)
        if angle < _STRAIGHT_RAD:
            return True
    return False


def bend_knees(tree: KinematicTree, qpos: np.ndarray, legs: tuple[list[int], list[int]]) -> Posture:
    """A posture for a robot that comes without one: its hip, knee and ankle pitch joints bent, the knees forward.

    A leg without three pitch joints stays as it is.
    """
    bent, model = qpos.copy(), tree.model
    y = tree.rotation(tree.base)[:, 1]
    for leg in legs:
        for joint, angle in zip(
            _pitch_joints(tree, leg) or (), (-0.5 * _BEND_RAD, _BEND_RAD, -0.5 * _BEND_RAD), strict=False
        ):
            address = model.jnt_qposadr[joint]
            wanted = bent[address] + angle * np.sign(tree.axis(joint) @ y)
            bent[address] = np.clip(wanted, *model.jnt_range[joint])
    how = f"none given: as drawn, the knees bent by {_BEND_RAD:g} rad (say [posture] or keyframe)"
    return Posture(bent, how, False)


def _pitch_joints(tree: KinematicTree, leg: list[int]) -> tuple[int, ...] | None:
    """Hip, knee and ankle pitch joint; None where a leg has not three joints about the base's y axis."""
    y = tree.rotation(tree.base)[:, 1]
    pitch = tuple(joint for joint in leg if abs(tree.axis(joint) @ y) > _SIDEWAYS)
    return pitch if len(pitch) == 3 else None


def _addresses(model: mujoco.MjModel) -> dict[str, int]:
    """Joint name -> address in qpos, of the hinges."""
    return {
        model.joint(joint).name: int(model.jnt_qposadr[joint])
        for joint in range(model.njnt)
        if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE
    }
