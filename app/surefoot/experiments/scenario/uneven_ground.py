"""``[ground] tiles``, ``[[ledges]]`` and ``[stones_under_steps]`` of a scenario, and the blocks that come of them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.field_metadata import check_fields, count, number
from surefoot.gait.footsteps import Footstep
from surefoot.robot.description import RobotDescription
from surefoot.simulation.ground import Tiles
from surefoot.simulation.terrain import Block, Terrain

_AROUND_M = 0.6  # a field of tiles goes so far beyond the outermost feet
_LEDGE_LONG_M, _LEDGE_WIDE_M = 60.0, 40.0
_CLEAR_M = 0.005  # between a foot at the start and the nearest stone
_TRIES = 100  # places drawn for a stone, until one is clear of the feet at the start


@dataclass(frozen=True, kw_only=True)
class Ledge:
    """``[[ledges]]``: the whole ground beyond a line is higher or lower; several make stairs.

    Attributes:
        x_m: where it begins, forward of the ankles at the start.
        height_m: up from the ground before it; negative: down.
    """

    x_m: float = number(0.5, -50.0, 50.0, "m", "where it begins, forward of the ankles at the start", step=0.05)
    height_m: float = number(0.02, -0.2, 0.2, "m", "up from the ground before it; negative: down", step=0.005)

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "ledges")


@dataclass(frozen=True, kw_only=True)
class StonesUnderSteps:
    """``[stones_under_steps]``: one stone under each planned footprint of a walk.

    Attributes:
        height_m: of all of them; 0: none.
        size_m: edge.
        seed: of their places.
        offset_x_m, offset_y_m: the place, in the foot's axes from the point below its ankle; None: anywhere below the
            sole, another place for each step.
    """

    height_m: float = number(0.0, 0.0, 0.1, "m", "height of each; 0: none", step=0.005)
    size_m: float = number(0.05, 0.003, 0.3, "m", "edge of each", step=0.01)
    seed: int = count(0, 0, 10**9, "of their places")
    offset_x_m: float | None = None
    offset_y_m: float | None = None

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "stones_under_steps")
        for name in ("offset_x_m", "offset_y_m"):
            value = getattr(self, name)
            number_in_range = isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= 0.3
            if value is not None and not number_in_range:
                raise InvalidInput(f"stones_under_steps.{name}", value, "must be a length", ["-0.3 to 0.3 m"])


def build_terrain(
    robot: RobotDescription,
    feet: Sequence[Footstep],
    steps: Sequence[Footstep],
    *,
    tiles: Tiles | None,
    ledges: Sequence[Ledge],
    stones: StonesUnderSteps,
) -> Terrain:
    """The blocks of tiles or ledges, and the stones on them.

    Args:
        robot: for the outline of its soles.
        feet: both, where they stand at the start.
        steps: where they are to step; may be empty.
        tiles: what is asked for, as the next two.
        ledges: see ``Ledge``.
        stones: see ``StonesUnderSteps``.

    Raises:
        InvalidInput: tiles and ledges; a ledge that begins below a foot.
    """
    if tiles is not None and ledges:
        raise InvalidInput("ledges", len(ledges), "there are tiles too", ["[[ledges]] or [ground] tiles, not both"])
    soles = [_footprint(robot, foot) for foot in feet]
    if tiles is not None:
        terrain = _field(tiles, soles, [_footprint(robot, step) for step in steps])
    else:
        terrain = _stairs(ledges, feet, soles)
    return Terrain((*terrain.blocks, *_stones(stones, robot, soles, steps, terrain)), terrain.depth_m)


def _footprint(robot: RobotDescription, foot: Footstep) -> np.ndarray:
    """Least and greatest x and y (2, 2) in world [m] of a sole that lies there."""
    corners = foot.point + robot.feet[foot.foot].sole.vertices.dot(foot.axes.T)
    return np.array((corners.min(axis=0), corners.max(axis=0)))


def _field(tiles: Tiles, soles: Sequence[np.ndarray], steps: Sequence[np.ndarray]) -> Terrain:
    """Tiles around all footprints, the feet at the start on one level slab as large as the tiles that it covers."""
    size, around = tiles.size_m, np.array((*soles, *steps))
    low = np.floor((around[:, 0].min(axis=0) - _AROUND_M) / size).astype(int)
    high = np.ceil((around[:, 1].max(axis=0) + _AROUND_M) / size).astype(int)
    start = np.array(soles)
    slab_low = np.floor((start[:, 0].min(axis=0) - _CLEAR_M) / size).astype(int)
    slab_high = np.ceil((start[:, 1].max(axis=0) + _CLEAR_M) / size).astype(int)
    heights = np.random.default_rng(tiles.seed).uniform(-tiles.amplitude_m, tiles.amplitude_m, high - low)
    blocks = [_between(size * slab_low, size * slab_high, 0.0)]
    for i, j in np.ndindex(*heights.shape):
        place = low + (i, j)
        if not ((slab_low <= place) & (place < slab_high)).all():
            blocks.append(_between(size * place, size * (place + 1), float(heights[i, j])))
    return Terrain(tuple(blocks), tiles.amplitude_m)


def _stairs(ledges: Sequence[Ledge], feet: Sequence[Footstep], soles: Sequence[np.ndarray]) -> Terrain:
    """A block for each stretch of ground that is higher than the lowest one."""
    ankles = float(feet[0].point[0])
    rear, front = min(sole[0, 0] for sole in soles) - ankles, max(sole[1, 0] for sole in soles) - ankles
    for i, ledge in enumerate(ledges):
        if rear - _CLEAR_M < ledge.x_m < front + _CLEAR_M:
            valid = [f"up to {rear - _CLEAR_M:.3f} m", f"from {front + _CLEAR_M:.3f} m"]
            raise InvalidInput(f"ledges.{i}.x_m", ledge.x_m, "begins below a foot at the start", valid)
    ordered = sorted(ledges, key=lambda ledge: ledge.x_m)
    begins = np.array([-_LEDGE_LONG_M, *(ankles + ledge.x_m for ledge in ordered), _LEDGE_LONG_M])
    levels = np.cumsum([0.0, *(ledge.height_m for ledge in ordered)])
    levels -= levels[int(np.searchsorted(begins, ankles)) - 1]  # zero where the robot stands at the start
    half = 0.5 * _LEDGE_WIDE_M
    blocks = [
        _between(np.array((low, -half)), np.array((high, half)), float(level))
        for low, high, level in zip(begins, begins[1:], levels, strict=False)
        if high > low and level > levels.min()
    ]
    return Terrain(tuple(blocks), float(-levels.min()))


def _stones(
    spec: StonesUnderSteps,
    robot: RobotDescription,
    soles: Sequence[np.ndarray],
    steps: Sequence[Footstep],
    terrain: Terrain,
) -> Iterator[Block]:
    """A stone below each footprint; none where every place that is drawn lies below a foot at the start."""
    random = np.random.default_rng(spec.seed)
    for step in steps if spec.height_m > 0.0 else ():
        outline = robot.feet[step.foot].sole.vertices
        for _ in range(_TRIES):
            offset = random.uniform(outline.min(axis=0), outline.max(axis=0))
            for axis, given in enumerate((spec.offset_x_m, spec.offset_y_m)):
                offset[axis] = offset[axis] if given is None else given
            x, y = (step.point + step.axes.dot(offset)).tolist()
            stone = Block(x, y, spec.size_m, spec.size_m, terrain.height_at(x, y) + spec.height_m)
            if not any(stone.overlaps(*sole) for sole in soles):
                yield stone
                break


def _between(low: np.ndarray, high: np.ndarray, top_m: float) -> Block:
    (x, y), (length, width) = (0.5 * (low + high)).tolist(), (high - low).tolist()
    return Block(x, y, length, width, top_m)
