"""Stones: boxes, wedges and half-balls that rise from the ground under a foot, or drop onto it elsewhere."""

from dataclasses import dataclass, replace

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.field_metadata import check_fields, choice, number, switch
from surefoot.geometry.rotations import rotation_from_vector
from surefoot.simulation.ground import GroundPose
from surefoot.task.reference import quintic

SHAPES = (BOX, WEDGE, HALF_BALL) = ("box", "wedge", "half-ball")
POOL_SIZE = 24  # of each kind: boxes and wedges together, half-balls
ROOT_M = 0.05  # how far a stone reaches into the ground, so that none is ever thin
_DROP_FROM_M = 0.3
_GRAVITY = 9.81
_WEDGE_DEG = 10.0  # slope of a wedge that nobody described: the ankle can follow it
_WEDGE_TOWARDS_DEG = 90.0  # and where it rises to: the left


@dataclass(frozen=True, kw_only=True)
class Stone:
    """A stone on the ground. Validated in ``__post_init__`` (InvalidInput).

    Attributes:
        x_m, y_m: centre; in a scenario relative to the point below the stance ankle at t = 0, in the plant in world.
            On a slope, along the ground: where it would be if the ground were turned back to flat.
        height_m: how far its highest point stands above the ground in the end.
        size_m: length (x) and width (y); of a half-ball the diameters of what the ground cuts out of it.
        shape: ``box``, ``wedge`` (a box whose top is a slope) or ``half-ball`` (of an ellipsoid).
        slope_deg, slope_direction_deg: of a wedge's top, and where it rises to: 0 = forward, 90 = to the left.
        rise_start_s, rise_duration_s: when it rises, and how long that takes.
        lying: it does not rise but lies there from the start; for robots that land on it.
        drops: falls from above instead (the page, away from the feet).
    """

    x_m: float = number(0.0, -50.0, 50.0, "m", "centre, forward")
    y_m: float = number(0.0, -50.0, 50.0, "m", "centre, to the left")
    height_m: float = number(0.01, 0.0003, 0.1, "m", "height of its highest point above the ground", step=0.001)
    size_m: tuple[float, float] = (0.06, 0.06)
    shape: str = choice(BOX, SHAPES, "box, wedge (its top is a slope) or half-ball")
    slope_deg: float = number(_WEDGE_DEG, 1.0, 30.0, "deg", "slope of a wedge's top", step=1.0)
    slope_direction_deg: float = number(
        _WEDGE_TOWARDS_DEG, -360.0, 360.0, "deg", "where a wedge rises to: 0 = forward, 90 = left", step=15.0
    )
    rise_start_s: float = number(0.5, 0.0, 1e6, "s", "when it starts to rise")
    rise_duration_s: float = number(0.3, 0.05, 10.0, "s", "how long it takes to rise")
    lying: bool = switch(False, "lies there from the start instead of rising")
    drops: bool = False

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types, values out of range, and what belongs to another shape."""
        check_fields(self, "stone")
        size = self.size_m
        pair = isinstance(size, list | tuple) and len(size) == 2
        if not pair or not all(isinstance(s, int | float) and 0.003 <= s <= 0.5 for s in size):
            raise InvalidInput("stone.size_m", size, "must be two lengths", ["0.003 to 0.5 m each"])
        object.__setattr__(self, "size_m", (float(size[0]), float(size[1])))
        if self.lying and (self.rise_start_s, self.rise_duration_s) != (Stone.rise_start_s, Stone.rise_duration_s):
            raise InvalidInput("stone.lying", True, "a stone that lies there does not rise: leave out rise_start_s")
        sloped = (self.slope_deg, self.slope_direction_deg) != (_WEDGE_DEG, _WEDGE_TOWARDS_DEG)
        if sloped and self.shape != WEDGE:
            raise InvalidInput("stone.slope_deg", self.slope_deg, f"a {self.shape} has no slope", ['shape = "wedge"'])

    def top_at(self, time_s: float) -> float:
        """Height [m] of its highest point at a time; below the ground before it starts."""
        if self.lying:
            return self.height_m
        elapsed = time_s - self.rise_start_s
        if elapsed < 0.0:
            return -ROOT_M
        if self.drops:
            return self.height_m + max(0.0, _DROP_FROM_M - 0.5 * _GRAVITY * elapsed**2)
        return self.height_m * quintic(elapsed / self.rise_duration_s)[0]

    def settled_at(self, time_s: float) -> bool:
        """Whether it no longer moves."""
        return time_s > self.rise_start_s + max(self.rise_duration_s, 1.0)

    def at(self, x_m: float, y_m: float) -> "Stone":
        """The same stone elsewhere."""
        return replace(self, x_m=x_m, y_m=y_m)

    def __deepcopy__(self, memo: object) -> "Stone":
        """Nothing in it changes, so that whoever keeps a whole simulation aside need not copy it."""
        return self

    def half_lengths(self) -> np.ndarray:
        """Half its lengths (3,) along its own axes [m], its root in the ground included."""
        a, b = 0.5 * self.size_m[0], 0.5 * self.size_m[1]
        if self.shape == HALF_BALL:
            return np.array((a, b, self.height_m))
        # a wedge's own axis leans: it reaches deep enough for its lowest corner to lie in the ground as well
        return np.array((a, b, 0.5 * (self.height_m + ROOT_M) / (np.cos(self._lean) if self.shape == WEDGE else 1.0)))

    def rotation(self) -> np.ndarray:
        """Its axes to the ground's (3, 3): a wedge is a box that leans."""
        if self.shape != WEDGE:
            return np.eye(3)
        direction = np.deg2rad(self.slope_direction_deg)
        return rotation_from_vector(self._lean * np.array((np.sin(direction), -np.cos(direction), 0.0)))

    def centre_at(self, time_s: float) -> np.ndarray:
        """Its centre (3,) on flat ground at a time [m], so that its highest point is where ``top_at`` says.

        A wedge's top is centred over (x, y), and its highest corner is that high.
        """
        half, top = self.half_lengths(), self.top_at(time_s)
        if self.shape != WEDGE:
            return np.array((self.x_m, self.y_m, top - float(half[2])))
        R = self.rotation()
        middle_of_top = np.array((self.x_m, self.y_m, top - float(np.abs(R[2, :2]).dot(half[:2]))))
        return middle_of_top - R[:, 2] * half[2]

    @property
    def _lean(self) -> float:
        return float(np.deg2rad(self.slope_deg))


def stone_pose(stone: Stone, time_s: float, ground: GroundPose) -> tuple[np.ndarray, np.ndarray]:
    """Centre (3,) in world [m] and rotation (3, 3), its own axes to world, of the solid of ``half_lengths``."""
    turned = ground.rotation.dot(stone.rotation()) if stone.shape == WEDGE else ground.rotation
    return ground.to_world(stone.centre_at(time_s)), turned


@dataclass(frozen=True)
class PlacedStone:
    """A stone in the world.

    Attributes:
        number: counts stones from 0; never used twice in a run.
        slot: of the pool.
        stone: what it is; positions in world.
        placed_s: when it was placed.
        removed_s: when it was taken away; infinite while it is there.
    """

    number: int
    slot: int
    stone: Stone
    placed_s: float
    removed_s: float = np.inf

    def __deepcopy__(self, memo: object) -> "PlacedStone":
        """Nothing in it changes either."""
        return self
