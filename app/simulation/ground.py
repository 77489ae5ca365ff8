"""The ground: flat, a slope from the start, or a plane that tilts while the robot stands on it.

Gravity stays vertical and the plane turns; turning gravity instead would be the same at rest only, and would turn the
controllers' idea of "up" with it. MuJoCo knows where the plane is, not how fast it turns: the contact feels the motion
through its penetration, a lag of some tenths of a millimetre at the speeds that make sense here.
"""

from dataclasses import dataclass

import numpy as np

from app.errors import InvalidInput
from app.fields import check_fields, number
from app.geometry.rotations import rotation_from_vector
from app.task.reference import quintic


@dataclass(frozen=True, kw_only=True)
class Ground:
    """``[ground]``: how the ground lies. Flat unless told. Checked at birth (InvalidInput).

    Attributes:
        slope_deg: angle to the horizontal, in the end [deg].
        direction_deg: where it rises to [deg]: 0 = forward, 90 = to the left.
        tilt_start_s: when it starts to tilt [s].
        tilt_duration_s: how long that takes [s], by a quintic from rest to rest; 0: it lies so from the start.
    """

    slope_deg: float = number(0.0, 0.0, 20.0, "deg", "slope of the ground", step=0.5)
    direction_deg: float = number(0.0, -360.0, 360.0, "deg", "where it rises to: 0 = forward, 90 = left", step=5.0)
    tilt_start_s: float = number(0.0, 0.0, 600.0, "s", "when it starts to tilt", step=0.1)
    tilt_duration_s: float = number(0.0, 0.0, 60.0, "s", "how long it tilts; 0: sloped from the start", step=0.1)

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types, values out of range, and a tilt in no time."""
        check_fields(self, "ground")
        if 0.0 < self.tilt_duration_s < 0.05:
            raise InvalidInput("ground.tilt_duration_s", self.tilt_duration_s, "is too sudden", ["0", "0.05 to 60 s"])
        if self.tilt_start_s > 0.0 and self.tilt_duration_s == 0.0:
            reason = "needs tilt_duration_s: without it the ground is sloped from the start"
            raise InvalidInput("ground.tilt_start_s", self.tilt_start_s, reason, ["tilt_duration_s = 0.05 to 60 s"])

    def angle_at(self, time_s: float) -> float:
        """Slope [rad] at a time [s]."""
        part = quintic((time_s - self.tilt_start_s) / self.tilt_duration_s)[0] if self.tilt_duration_s > 0.0 else 1.0
        return float(np.deg2rad(self.slope_deg * part))

    def rotation_at(self, time_s: float) -> np.ndarray:
        """Ground axes to world (3, 3) at a time [s]: by the slope about the horizontal line that does not rise."""
        direction = np.deg2rad(self.direction_deg)
        return rotation_from_vector(self.angle_at(time_s) * np.array((np.sin(direction), -np.cos(direction), 0.0)))


class GroundPose:
    """Where the ground of one plant is now.

    Args:
        ground: how it lies over time.
        pivot: point (3,) in world [m] that stays where it is: below the stance ankle, or midway between the feet.
    """

    def __init__(self, ground: Ground, pivot: np.ndarray):
        self.ground, self.pivot = ground, pivot
        self.rotation = np.eye(3)
        self._angle = 0.0

    @property
    def up(self) -> np.ndarray:
        """Normal (3,) of the ground in world."""
        return self.rotation[:, 2]

    def move(self, time_s: float) -> bool:
        """Bring it to where it is at a time [s]; whether it has moved."""
        angle = self.ground.angle_at(time_s)
        if angle == self._angle:
            return False
        self._angle, self.rotation = angle, self.ground.rotation_at(time_s)
        return True

    def to_world(self, point: np.ndarray) -> np.ndarray:
        """A point (3,) [m] given as if the ground were flat, carried along with the ground."""
        return self.pivot + self.rotation.dot(point - self.pivot) if self._angle else point
