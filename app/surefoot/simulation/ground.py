"""The ground: flat, a slope from the start, or a plane that tilts while the robot stands on it.

Gravity stays vertical and the plane turns; turning gravity instead would be the same at rest only, and would turn the
controllers' idea of "up" with it. MuJoCo knows where the plane is, not how fast it turns: the contact feels the motion
through its penetration, a lag of some tenths of a millimetre at the speeds that make sense here.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.field_metadata import check_fields, count, from_mapping, number
from surefoot.geometry.rotations import rotation_from_vector
from surefoot.task.reference import quintic


@dataclass(frozen=True, kw_only=True)
class Tiles:
    """``[ground] tiles``: a field of square tiles, each as high as chance has it. Validated likewise.

    Attributes:
        size_m: edge of a tile.
        amplitude_m: heights are uniform between minus and plus this; level zero where the feet stand at the start.
        seed: of the heights.
    """

    size_m: float = number(0.1, 0.05, 0.5, "m", "edge of a tile", step=0.01, goes_with="sole_length")
    amplitude_m: float = number(0.02, 0.0003, 0.06, "m", "heights are between minus and plus this", step=0.005)
    seed: int = count(0, 0, 10**9, "of the tiles' heights")

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "ground.tiles")


@dataclass(frozen=True, kw_only=True)
class Ground:
    """``[ground]``: how the ground lies. Flat unless told. Validated in ``__post_init__`` (InvalidInput).

    Attributes:
        slope_deg: angle to the horizontal, in the end [deg].
        direction_deg: where it rises to [deg]: 0 = forward, 90 = to the left.
        tilt_start_s: when it starts to tilt [s].
        tilt_duration_s: how long that takes [s], by a quintic from rest to rest; 0: it lies so from the start.
        tiles: uneven ground around the way that the robot is to walk; None: it is even.
    """

    slope_deg: float = number(0.0, 0.0, 20.0, "deg", "slope of the ground", step=0.5)
    direction_deg: float = number(0.0, -360.0, 360.0, "deg", "where it rises to: 0 = forward, 90 = left", step=5.0)
    tilt_start_s: float = number(0.0, 0.0, 600.0, "s", "when it starts to tilt", step=0.1)
    tilt_duration_s: float = number(0.0, 0.0, 60.0, "s", "how long it tilts; 0: sloped from the start", step=0.1)
    tiles: Tiles | None = None

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types, values out of range, and a tilt in no time."""
        check_fields(self, "ground")
        if isinstance(self.tiles, Mapping):
            object.__setattr__(self, "tiles", from_mapping(Tiles, self.tiles, "ground.tiles"))
        if not isinstance(self.tiles, Tiles | None):
            reason = "must be a table"
            raise InvalidInput("ground.tiles", self.tiles, reason, ["{ size_m = 0.1, amplitude_m = 0.02, seed = 0 }"])
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


@dataclass(frozen=True)
class Tilt:
    """The ground turned on request, from however it lay.

    Attributes:
        start_s, duration_s: when, and how long by a quintic from rest to rest [s].
        before, after: slope as a vector (2,) [rad]: its angle, towards where the ground rises.
    """

    start_s: float
    duration_s: float
    before: tuple[float, float]
    after: tuple[float, float]

    def slope_at(self, time_s: float) -> np.ndarray:
        """Slope (2,) [rad] at a time [s]."""
        part = quintic((time_s - self.start_s) / self.duration_s)[0]
        return (1.0 - part) * np.array(self.before) + part * np.array(self.after)


def slope_rotation(slope: np.ndarray) -> np.ndarray:
    """Ground axes to world (3, 3) of a slope (2,) [rad]: its angle, towards where the ground rises."""
    x, y = slope
    return rotation_from_vector(np.array((y, -x, 0.0)))


class GroundPose:
    """Where the ground of one plant is now.

    Args:
        ground: how it lies over time.
        pivot: point (3,) in world [m] that stays where it is: below the stance ankle, or midway between the feet.

    Attributes:
        slope: as a vector (2,) [rad]: its angle, towards where the ground rises.
        rotation: the same as ground axes to world (3, 3).
        tilts: what was asked for on top, oldest first; the newest that has begun counts.
    """

    def __init__(self, ground: Ground, pivot: np.ndarray):
        self.ground, self.pivot = ground, pivot
        self.slope, self.rotation = np.zeros(2), np.eye(3)
        self.tilts: tuple[Tilt, ...] = ()
        self._angle = 0.0

    @property
    def up(self) -> np.ndarray:
        """Normal (3,) of the ground in world."""
        return self.rotation[:, 2]

    def tilt(self, time_s: float, slope_deg: float, direction_deg: float, duration_s: float) -> None:
        """Start to turn the ground towards another slope. Raises InvalidInput."""
        wanted = Ground(slope_deg=slope_deg, direction_deg=direction_deg, tilt_duration_s=duration_s)
        if duration_s == 0.0:
            raise InvalidInput("ground.tilt_duration_s", duration_s, "is too sudden", ["0.05 to 60 s"])
        angle, direction = np.deg2rad(wanted.slope_deg), np.deg2rad(wanted.direction_deg)
        after = (float(angle * np.cos(direction)), float(angle * np.sin(direction)))
        before = self._slope_at(time_s)
        self.tilts = (*self.tilts, Tilt(time_s, wanted.tilt_duration_s, (float(before[0]), float(before[1])), after))

    def rotation_at(self, time_s: float) -> np.ndarray:
        """Ground axes to world (3, 3) at a time [s]."""
        return self._where(time_s)[1]

    def move(self, time_s: float) -> bool:
        """Bring it to where it is at a time [s]; whether it has moved."""
        angle, rotation = self._where(time_s)
        if angle == self._angle and (not self.tilts or np.array_equal(rotation, self.rotation)):
            return False
        self._angle, self.rotation, self.slope = angle, rotation, self._slope_at(time_s)
        return True

    def lie(self, rotation: np.ndarray) -> None:
        """Let it lie as a rotation (3, 3) says, ground axes to world (for views, which have no time of their own)."""
        self.rotation, self._angle = rotation, float(np.arccos(min(1.0, rotation[2, 2])))

    def lie_at(self, slope: np.ndarray) -> None:
        """Let it lie with a slope (2,) [rad] (for runs that were recorded)."""
        self.slope, self.rotation, self._angle = slope, slope_rotation(slope), float(np.hypot(*slope))

    def to_world(self, point: np.ndarray) -> np.ndarray:
        """A point (3,) [m] given as if the ground were flat, carried along with the ground."""
        return self.pivot + self.rotation.dot(point - self.pivot) if self._angle else point

    def _where(self, time_s: float) -> tuple[float, np.ndarray]:
        tilt = self._tilt_at(time_s)
        if tilt is None:
            angle = self.ground.angle_at(time_s)
            return angle, self.rotation if angle == self._angle and not self.tilts else self.ground.rotation_at(time_s)
        slope = tilt.slope_at(time_s)
        return float(np.hypot(*slope)), slope_rotation(slope)

    def _slope_at(self, time_s: float) -> np.ndarray:
        tilt = self._tilt_at(time_s)
        if tilt is not None:
            return tilt.slope_at(time_s)
        direction = np.deg2rad(self.ground.direction_deg)
        return self.ground.angle_at(time_s) * np.array((np.cos(direction), np.sin(direction)))

    def _tilt_at(self, time_s: float) -> Tilt | None:
        return next((tilt for tilt in reversed(self.tilts) if tilt.start_s <= time_s), None)
