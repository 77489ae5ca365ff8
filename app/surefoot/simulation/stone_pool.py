"""The stones of one plant in MuJoCo: bodies made beforehand, parked far below, sized and moved when they are wanted."""

from collections import deque
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from surefoot.errors import InvalidInput
from surefoot.simulation.ground import Ground, GroundPose
from surefoot.simulation.stones import HALF_BALL, POOL_SIZE, PlacedStone, Stone, stone_pose

STONE_PREFIX = "stone_"
_PARKED_M = -5.0
_REMEMBERED = 300  # stones that were taken away: a replay draws them where they were
_SLOTS = 2 * POOL_SIZE  # first the boxes, then the half-balls: boxes alone act as they did before there were others


def add_stone_pool(spec: mujoco.MjSpec, contact_bits: dict[str, int]) -> None:
    """Add the parked bodies to a model before it is compiled."""
    for i in range(_SLOTS):
        body = spec.worldbody.add_body(name=f"{STONE_PREFIX}{i}", mocap=True, pos=[0.0, 0.0, _PARKED_M - i])
        kind = mujoco.mjtGeom.mjGEOM_BOX if i < POOL_SIZE else mujoco.mjtGeom.mjGEOM_ELLIPSOID
        body.add_geom(
            name=f"{STONE_PREFIX}{i}",
            type=kind,
            size=[0.03, 0.03, 0.03],
            rgba=[0.45, 0.38, 0.30, 1.0],
            **contact_bits,
        )


@dataclass(frozen=True)
class PoolState:
    """All that a pool remembers, to be put back by ``StonePool.restore``.

    Attributes:
        placed: stones in the world, oldest first.
        gone: stones that were taken away in this run, oldest first.
        moving: slots that have not settled.
        count: stones placed in this run.
    """

    placed: tuple[PlacedStone, ...] = ()
    gone: tuple[PlacedStone, ...] = ()
    moving: frozenset[int] = frozenset()
    count: int = 0


class StonePool:
    """The stones of one plant. The oldest of a kind makes room when its part of the pool is used up.

    Args:
        model, data: MuJoCo's, made with ``add_stone_pool``.
        ground: what they lie on, and tilt with.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, ground: GroundPose | None = None):
        self._model, self._data = model, data
        self._ground = ground or GroundPose(Ground(), np.zeros(3))
        self._geoms = [model.geom(f"{STONE_PREFIX}{i}").id for i in range(_SLOTS)]
        self._bodies = [model.body(f"{STONE_PREFIX}{i}").id for i in range(_SLOTS)]
        self._touching = [(int(model.geom_contype[g]), int(model.geom_conaffinity[g])) for g in self._geoms]
        self._mocap = [int(model.body(f"{STONE_PREFIX}{i}").mocapid[0]) for i in range(_SLOTS)]
        self._placed: dict[int, PlacedStone] = {}  # by slot, oldest first
        self._gone: deque[PlacedStone] = deque(maxlen=_REMEMBERED)
        self._moving: set[int] = set()
        self._count = 0
        self.clear()

    @property
    def stones(self) -> tuple[Stone, ...]:
        """All stones, oldest first; positions in world."""
        return tuple(placed.stone for placed in self._placed.values())

    @property
    def placed(self) -> tuple[PlacedStone, ...]:
        """The same with their numbers."""
        return tuple(self._placed.values())

    @property
    def history(self) -> tuple[PlacedStone, ...]:
        """Every stone of this run, those that were taken away first."""
        return (*self._gone, *self._placed.values())

    def state(self) -> PoolState:
        """All that it remembers."""
        return PoolState(self.placed, tuple(self._gone), frozenset(self._moving), self._count)

    def restore(self, state: PoolState) -> None:
        """Put a state back, sizes and places included; as at MuJoCo's present time."""
        for slot in range(_SLOTS):
            self._park(slot)
        self._placed = {placed.slot: placed for placed in state.placed}
        self._gone, self._count = deque(state.gone, maxlen=_REMEMBERED), state.count
        for slot, placed in self._placed.items():
            self._size(slot, placed.stone)
        self._moving = set(self._placed)
        self.move(self._data.time)
        self._moving = set(state.moving)

    def place(self, stone: Stone) -> int:
        """Put a stone into the world; its coordinates are world coordinates. Returns its number."""
        kind = range(POOL_SIZE, _SLOTS) if stone.shape == HALF_BALL else range(POOL_SIZE)
        free = [slot for slot in kind if slot not in self._placed]
        slot = free[0] if free else next(slot for slot in self._placed if slot in kind)
        self._take_out(slot)
        number, self._count = self._count, self._count + 1
        self._placed[slot] = PlacedStone(number, slot, stone, float(self._data.time))
        self._size(slot, stone)
        self._moving.add(slot)
        self.move(self._data.time)
        return number

    def number_of(self, geom: int) -> int | None:
        """Number of the stone that a geom is; None when it is none."""
        slot = self._geoms.index(geom) if geom in self._geoms else -1
        return self._placed[slot].number if slot in self._placed else None

    def find(self, number: int) -> PlacedStone:
        """The stone of that number. Raises InvalidInput."""
        for placed in self._placed.values():
            if placed.number == number:
                return placed
        present = [placed.number + 1 for placed in self._placed.values()]  # people count from 1
        raise InvalidInput("stone", number + 1, "there is no such stone" if present else "there is no stone", present)

    def move_to(self, number: int, stone: Stone) -> None:
        """Let a stone be another one of the same shape, elsewhere. Raises InvalidInput: no such stone."""
        placed, now = self.find(number), float(self._data.time)
        self._gone.append(replace(placed, removed_s=now))
        self._placed[placed.slot] = replace(placed, stone=stone, placed_s=now)
        self._size(placed.slot, stone)
        self._moving.add(placed.slot)
        self.move(now)

    def remove(self, number: int) -> Stone:
        """Take one stone away. Raises InvalidInput."""
        placed = self.find(number)
        self._take_out(placed.slot)
        self._park(placed.slot)
        return placed.stone

    def remove_last(self) -> bool:
        """Take the newest stone away; False when there is none."""
        if not self._placed:
            return False
        self.remove(max(placed.number for placed in self._placed.values()))
        return True

    def clear(self) -> None:
        """Take all stones away, and forget that there were any at a time zero."""
        for slot in tuple(self._placed):
            self._take_out(slot)
        if self._data.time == 0.0:
            self._gone.clear()
            self._count = 0
        for slot in range(_SLOTS):
            self._park(slot)

    def move(self, time_s: float, *, ground_moved: bool = False) -> None:
        """Bring every moving stone to where it is at a time; all of them when the ground has moved."""
        if ground_moved:
            self._moving.update(self._placed)
        for slot in tuple(self._moving):
            stone, mocap = self._placed[slot].stone, self._mocap[slot]
            self._data.mocap_pos[mocap], rotation = stone_pose(stone, time_s, self._ground)
            mujoco.mju_mat2Quat(self._data.mocap_quat[mocap], rotation.ravel())
            if stone.settled_at(time_s):
                self._moving.discard(slot)

    def _let_touch(self, slot: int, touches: bool) -> None:
        """A parked stone takes no part in the search for contacts, which would take a third of MuJoCo's step."""
        geom, body, model = self._geoms[slot], self._bodies[slot], self._model
        bits = self._touching[slot] if touches else (0, 0)
        model.geom_contype[geom], model.geom_conaffinity[geom] = bits
        model.body_contype[body], model.body_conaffinity[body] = bits

    def _size(self, slot: int, stone: Stone) -> None:
        self._let_touch(slot, True)
        geom, half = self._geoms[slot], stone.half_lengths()
        self._model.geom_size[geom] = half
        self._model.geom_rbound[geom] = float(half.max() if stone.shape == HALF_BALL else np.linalg.norm(half))
        self._model.geom_aabb[geom] = np.concatenate((np.zeros(3), half))

    def _take_out(self, slot: int) -> None:
        placed = self._placed.pop(slot, None)
        if placed is not None:
            self._gone.append(replace(placed, removed_s=float(self._data.time)))

    def _park(self, slot: int) -> None:
        self._moving.discard(slot)
        self._let_touch(slot, False)
        self._data.mocap_pos[self._mocap[slot]] = (0.0, 0.0, _PARKED_M - slot)
