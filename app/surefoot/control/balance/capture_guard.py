"""Where the commanded ZMP may be: inside the sole with a margin, and ahead of the capture point near an edge.

These are safety limits, not gains: they are constants here and no slider moves them, but for the margin.
"""

from functools import lru_cache

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon, least_violating_point, project_onto_halfplanes
from surefoot.record import record

GUARD_SCALE = 0.85  # of the polygon: where the capture point meets the guard
GUARD_SLOPE = 2.0  # how soon before that edge the ZMP must move ahead of it
GUARD_INSET_M = 0.002  # the guard never asks for more than this inside the margin


@record
class LimitedZMP:
    """A ZMP after limits.

    Attributes:
        point: (2,) [m].
        active: it was moved.
        relaxed: guard and margin could not both be kept; the margin was.
    """

    point: np.ndarray
    active: bool
    relaxed: bool


@lru_cache(maxsize=16)  # a single support's polygon is one object for the whole run
def scaled_offsets(polygon: ConvexPolygon, scale: float) -> np.ndarray:
    """Edge offsets (n,) [m] of the polygon scaled about its centroid; its normals stay the same."""
    at_centroid = polygon.normals.dot(polygon.centroid)
    return at_centroid + scale * (polygon.offsets - at_centroid)


def guard_bounds(polygon: ConvexPolygon, capture_point: np.ndarray, margin: float) -> np.ndarray:
    """For every edge the least n.c (n,) [m] the guard allows.

    n.c >= min(n.xi - 2 (b - n.xi), b_margin - 2 mm) with b the edge of the polygon scaled to 0.85: with the capture
    point xi well inside this asks for nothing; when xi reaches the 0.85 edge the ZMP must be beyond it.
    """
    along = polygon.normals.dot(capture_point)
    guard_edge = scaled_offsets(polygon, min(GUARD_SCALE, margin))
    ceiling = scaled_offsets(polygon, margin) - GUARD_INSET_M
    return np.minimum(along - GUARD_SLOPE * (guard_edge - along), ceiling)


def limit_zmp(
    zmp: np.ndarray, capture_point: np.ndarray, polygon: ConvexPolygon, margin: float, *, guard: bool
) -> LimitedZMP:
    """Move the ZMP to the nearest point that margin and guard allow.

    Args:
        zmp: wanted C (2,) [m], the polygon's frame.
        capture_point: xi (2,) [m], the same frame.
        polygon: true support polygon.
        margin: scale of the polygon the ZMP must stay in.
        guard: whether the capture guard is on.
    """
    normals, bounds = polygon.normals, scaled_offsets(polygon, margin)
    at = normals.dot(zmp)
    inside = not (at > bounds).any()
    if not guard:
        if inside:
            return LimitedZMP(zmp, False, False)
        point = project_onto_halfplanes(zmp, normals, bounds)
        return LimitedZMP(polygon.centroid if point is None else point, True, False)
    least = guard_bounds(polygon, capture_point, margin)
    if inside and not (at < least).any():
        return LimitedZMP(zmp, False, False)
    point = project_onto_halfplanes(zmp, np.vstack((normals, -normals)), np.concatenate((bounds, -least)))
    if point is not None:
        return LimitedZMP(point, True, False)
    return LimitedZMP(least_violating_point(normals, bounds, -normals, -least), True, True)
