"""A base whose frame does not lie x forward, y left, z up, turned in memory; models of motion capture have y up."""

from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot_import.mjcf_writer import numbers

_AXES = {sign + "xyz"[i]: np.eye(3)[i] * (-1.0 if sign else 1.0) for i in range(3) for sign in ("", "-")}
AXIS_NAMES = tuple(_AXES)


@record
class BaseAxes:
    """Which axes of the base's frame, as the MJCF has it, point where; ``AXIS_NAMES``.

    Attributes:
        forward: e.g. ``z``.
        up: e.g. ``y``.
    """

    forward: str
    up: str

    def __post_init__(self) -> None:
        """Refuse what is no axis, and two along one line."""
        for key, value in (("forward", self.forward), ("up", self.up)):
            if value not in AXIS_NAMES:
                raise InvalidInput(f"base.{key}", value, "must be an axis of the base's frame in the MJCF", AXIS_NAMES)
        if self.forward[-1] == self.up[-1]:
            raise InvalidInput("base.up", self.up, f"must be another axis than forward = {self.forward!r}")

    @property
    def quaternion(self) -> np.ndarray:
        """(4,) w first: frame with x forward and z up -> frame of the MJCF."""
        x, z = _AXES[self.forward], _AXES[self.up]
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, np.column_stack((x, np.cross(z, x), z)).ravel())
        return quaternion


def turn_base(root: Element, axes: BaseAxes) -> None:
    """Give the base of a plain MJCF a frame with x forward and z up, in place, and draw it upright.

    Args:
        root: as ``mjcf_writer`` spells it out.
        axes: of the base as it is.
    """
    base, back = root.find("worldbody/body"), np.zeros(4)
    assert base is not None
    mujoco.mju_negQuat(back, axes.quaternion)
    for part in base:
        if part.tag in ("inertial", "geom", "body"):
            position, quaternion = (np.array(part.get(key, "").split(), dtype=float) for key in ("pos", "quat"))
            turned, placed = np.zeros(4), np.zeros(3)
            mujoco.mju_mulQuat(turned, back, quaternion)
            mujoco.mju_rotVecQuat(placed, position, back)
            part.set("pos", numbers(placed))
            part.set("quat", numbers(turned))
    base.set("quat", numbers((1.0, 0.0, 0.0, 0.0)))


def turned_orientation(quaternion: np.ndarray, axes: BaseAxes) -> np.ndarray:
    """Orientation (4,) of the turned base, w first, where that of the base as it is has ``quaternion``."""
    turned = np.zeros(4)
    mujoco.mju_mulQuat(turned, quaternion, axes.quaternion)
    return turned
