"""Where a stone is put: below which place of a sole, and whether a sole is above it."""

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.robot.feet import Foot

SOLE_PLACES = ("outer edge", "inner edge", "toe", "heel")
_BEFORE_ANKLE_M = 0.05  # the side edges are hit this far before the ankle


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
    return _BEFORE_ANKLE_M, side * round(reach - 0.0025, 3)


def place_on_sole(foot: Foot, corners: np.ndarray, place: str) -> np.ndarray:
    """A place of a sole in world (3,) [m], from where its corners (n, 3) are, in the order of ``sole.vertices``."""
    local = np.column_stack((foot.sole.vertices, np.ones(len(foot.sole.vertices))))
    map_to_world = np.linalg.lstsq(local, corners, rcond=None)[0]
    return np.array((*sole_place(foot, place), 1.0)).dot(map_to_world)
