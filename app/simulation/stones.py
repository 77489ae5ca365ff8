"""Stones: a pool of boxes that rise from the ground under a foot, or drop onto it elsewhere."""

from dataclasses import dataclass, replace

import mujoco
import numpy as np

from app.errors import InvalidInput
from app.fields import check_fields, number, switch
from app.simulation.ground import Ground, GroundPose
from app.task.reference import quintic

POOL_SIZE = 24
STONE_PREFIX = "stone_"
_ROOT_M = 0.05  # how far a stone reaches into the ground, so that none is ever thin
_PARKED_M = -5.0
_DROP_FROM_M = 0.3
_GRAVITY = 9.81


@dataclass(frozen=True, kw_only=True)
class Stone:
    """A box on the ground. Checked at birth (InvalidInput).

    Attributes:
        x_m, y_m: centre; in a scenario relative to the point below the stance ankle at t = 0, in the plant in world.
            On a slope, along the ground: where it would be if the ground were turned back to flat.
        height_m: how far its top stands above the ground in the end.
        size_m: length (x) and width (y).
        rise_start_s, rise_duration_s: when it rises, and how long that takes.
        lying: it does not rise but lies there from the start; for robots that land on it.
        drops: falls from above instead (the page, away from the feet).
    """

    x_m: float = number(0.0, -5.0, 5.0, "m", "centre, forward")
    y_m: float = number(0.0, -5.0, 5.0, "m", "centre, to the left")
    height_m: float = number(0.01, 0.001, 0.1, "m", "height above the ground", step=0.001)
    size_m: tuple[float, float] = (0.06, 0.06)
    rise_start_s: float = number(0.5, 0.0, 1e6, "s", "when it starts to rise")
    rise_duration_s: float = number(0.3, 0.05, 10.0, "s", "how long it takes to rise")
    lying: bool = switch(False, "lies there from the start instead of rising")
    drops: bool = False

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "stone")
        size = self.size_m
        pair = isinstance(size, list | tuple) and len(size) == 2
        if not pair or not all(isinstance(s, int | float) and 0.01 <= s <= 0.5 for s in size):
            raise InvalidInput("stone.size_m", size, "must be two lengths", ["0.01 to 0.5 m each"])
        object.__setattr__(self, "size_m", (float(size[0]), float(size[1])))
        if self.lying and (self.rise_start_s, self.rise_duration_s) != (Stone.rise_start_s, Stone.rise_duration_s):
            raise InvalidInput("stone.lying", True, "a stone that lies there does not rise: leave out rise_start_s")

    def top_at(self, time_s: float) -> float:
        """Height [m] of its top at a time; below the ground before it starts."""
        if self.lying:
            return self.height_m
        elapsed = time_s - self.rise_start_s
        if elapsed < 0.0:
            return -_ROOT_M
        if self.drops:
            return self.height_m + max(0.0, _DROP_FROM_M - 0.5 * _GRAVITY * elapsed**2)
        return self.height_m * quintic(elapsed / self.rise_duration_s)[0]

    def settled_at(self, time_s: float) -> bool:
        """Whether it no longer moves."""
        return time_s > self.rise_start_s + max(self.rise_duration_s, 1.0)

    def at(self, x_m: float, y_m: float) -> "Stone":
        """The same stone elsewhere."""
        return replace(self, x_m=x_m, y_m=y_m)


def add_stone_pool(spec: mujoco.MjSpec, contact_bits: dict[str, int]) -> None:
    """Add the parked boxes to a model before it is compiled."""
    for i in range(POOL_SIZE):
        body = spec.worldbody.add_body(name=f"{STONE_PREFIX}{i}", mocap=True, pos=[0.0, 0.0, _PARKED_M - i])
        body.add_geom(
            name=f"{STONE_PREFIX}{i}", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.03, 0.03, 0.03],
            rgba=[0.45, 0.38, 0.30, 1.0], **contact_bits,
        )  # fmt: skip


class StonePool:
    """The stones of one plant. The oldest makes room when the pool is used up.

    Args:
        model, data: MuJoCo's, made with ``add_stone_pool``.
        ground: what they lie on, and tilt with.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, ground: GroundPose | None = None):
        self._model, self._data = model, data
        self._ground = ground or GroundPose(Ground(), np.zeros(3))
        self._geoms = [model.geom(f"{STONE_PREFIX}{i}").id for i in range(POOL_SIZE)]
        self._mocap = [int(model.body(f"{STONE_PREFIX}{i}").mocapid[0]) for i in range(POOL_SIZE)]
        self._stones: dict[int, Stone] = {}  # slot -> stone, oldest first
        self._moving: set[int] = set()
        self.clear()

    @property
    def stones(self) -> tuple[Stone, ...]:
        """All stones, oldest first; positions in world."""
        return tuple(self._stones.values())

    def place(self, stone: Stone) -> None:
        """Put a stone into the world; its coordinates are world coordinates."""
        free = [slot for slot in range(POOL_SIZE) if slot not in self._stones]
        slot = free[0] if free else next(iter(self._stones))
        self._stones.pop(slot, None)
        self._stones[slot] = stone
        half = np.array((0.5 * stone.size_m[0], 0.5 * stone.size_m[1], 0.5 * (stone.height_m + _ROOT_M)))
        geom = self._geoms[slot]
        self._model.geom_size[geom] = half
        self._model.geom_rbound[geom] = float(np.linalg.norm(half))
        self._model.geom_aabb[geom] = np.concatenate((np.zeros(3), half))
        self._moving.add(slot)
        self.move(self._data.time)

    def remove_last(self) -> bool:
        """Take the newest stone away; False when there is none."""
        if not self._stones:
            return False
        slot = next(reversed(self._stones))
        del self._stones[slot]
        self._park(slot)
        return True

    def clear(self) -> None:
        """Take all stones away."""
        self._stones.clear()
        for slot in range(POOL_SIZE):
            self._park(slot)

    def move(self, time_s: float, *, ground_moved: bool = False) -> None:
        """Bring every moving stone to where it is at a time; all of them when the ground has moved."""
        if ground_moved:
            self._moving.update(self._stones)
        for slot in tuple(self._moving):
            stone = self._stones[slot]
            z = stone.top_at(time_s) - float(self._model.geom_size[self._geoms[slot], 2])
            place = self._ground.to_world(np.array((stone.x_m, stone.y_m, z)))
            self._data.mocap_pos[self._mocap[slot]] = place
            mujoco.mju_mat2Quat(self._data.mocap_quat[self._mocap[slot]], self._ground.rotation.ravel())
            if stone.settled_at(time_s):
                self._moving.discard(slot)

    def _park(self, slot: int) -> None:
        self._moving.discard(slot)
        self._data.mocap_pos[self._mocap[slot]] = (0.0, 0.0, _PARKED_M - slot)
