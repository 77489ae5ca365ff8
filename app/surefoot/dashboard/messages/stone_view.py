"""From stones to what is drawn of them; below which place of a sole one is put, and whether a sole is above it."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.geometry.rotations import quaternion_wxyz
from surefoot.robot.feet import Foot
from surefoot.simulation.ground import Ground, GroundPose
from surefoot.simulation.stones import BOX, WEDGE, PlacedStone, Stone


@dataclass(frozen=True)
class StoneView:
    """One stone as it is seen.

    Attributes:
        number: counts stones of a run.
        stone: what it is.
        position: centre of what is drawn (3,) in world [m]; of a wedge the ground's point below its top's middle.
        wxyz: its orientation; of a wedge the ground's.
        lengths: full lengths (3,) along its own axes.
        top_m: how high its highest point is above the ground now.
    """

    number: int
    stone: Stone
    position: tuple[float, float, float]
    wxyz: tuple[float, float, float, float]
    lengths: tuple[float, float, float]
    top_m: float


def stone_views(placed: Iterable[PlacedStone], time_s: float, ground: GroundPose) -> tuple[StoneView, ...]:
    """All stones that are out of the ground at a time."""
    there = (p for p in placed if p.placed_s <= time_s < p.removed_s and p.stone.top_at(time_s) > 0.0)
    return tuple(stone_view(p.number, p.stone, time_s, ground) for p in sorted(there, key=lambda p: p.number))


def stone_view(number: int, stone: Stone, time_s: float, ground: GroundPose) -> StoneView:
    """One stone at a time; of a box only what is above the ground, so that one that drops is as thick as it will be."""
    centre, lengths, top = stone.centre_at(time_s), 2.0 * stone.half_lengths(), stone.top_at(time_s)
    if stone.shape == BOX:
        lengths[2] = stone.height_m if stone.drops else top
        centre[2] = top - 0.5 * lengths[2]
    elif stone.shape == WEDGE:
        centre = np.array((stone.x_m, stone.y_m, 0.0))
    place = ground.to_world(centre)
    wxyz = quaternion_wxyz(ground.rotation)
    return StoneView(number, stone, tuple(place.tolist()), tuple(wxyz.tolist()), tuple(lengths.tolist()), top)


def preview_of(stone: Stone, rotation: np.ndarray, pivot: np.ndarray) -> StoneView:
    """A stone as it will stand when it has come up."""
    ground = GroundPose(Ground(), pivot)
    ground.lie(rotation)
    return stone_view(-1, replace(stone, drops=False), np.inf, ground)


SOLE_PLACES = ("outer edge", "inner edge", "toe", "heel")
_AHEAD = 5.0 / 17.0  # the side edges are hit this far before the ankle, as a share of the way to the toe


def stone_footprint(x_m: float, y_m: float, size_m: tuple[float, float]) -> ConvexPolygon:
    """The rectangle that a stone covers, in world."""
    a, b = 0.5 * size_m[0], 0.5 * size_m[1]
    return convex_hull([(x_m - a, y_m - b), (x_m + a, y_m - b), (x_m + a, y_m + b), (x_m - a, y_m + b)])


def overlap(one: ConvexPolygon, other: ConvexPolygon) -> bool:
    """Whether two convex polygons share area: no edge of either separates them."""
    return not (_separates(one, other) or _separates(other, one))


def _separates(one: ConvexPolygon, other: ConvexPolygon) -> bool:
    beyond = one.normals @ other.vertices.T - one.offsets[:, None]  # (edges of one, corners of the other)
    return bool((beyond >= 0.0).all(axis=1).any())


def sole_place(foot: Foot, place: str) -> tuple[float, float]:
    """A place of a sole relative to the point P below its ankle, foot axes [m]."""
    outward = 1.0 if foot.side == "left" else -1.0
    corners: np.ndarray = foot.sole.vertices
    if place in ("toe", "heel"):
        return (float(corners[:, 0].max() if place == "toe" else corners[:, 0].min()), 0.0)
    side = outward if place == "outer edge" else -outward
    reach = foot.sole.distance_to_edge(np.zeros(2), np.array((0.0, side)))
    return round(_AHEAD * float(corners[:, 0].max()), 4), side * round(reach - 0.0025, 3)


def place_on_sole(foot: Foot, corners: np.ndarray, place: str) -> np.ndarray:
    """A place of a sole in world (3,) [m], from where its corners (n, 3) are, in the order of ``sole.vertices``."""
    local = np.column_stack((foot.sole.vertices, np.ones(len(foot.sole.vertices))))
    map_to_world = np.linalg.lstsq(local, corners, rcond=None)[0]
    return np.array((*sole_place(foot, place), 1.0)).dot(map_to_world)
