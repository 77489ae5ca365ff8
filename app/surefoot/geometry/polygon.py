"""Convex polygons in the plane, as vertices and as half-planes, and the nearest point that half-planes allow."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, eq=False)
class ConvexPolygon:
    """A convex polygon.

    Attributes:
        vertices: (n, 2) [m], counter-clockwise, no three on a line.
        normals: (n, 2) unit outward normal of the edge from vertex i to vertex i + 1.
        offsets: (n,) [m]; a point p is inside when ``normals @ p <= offsets``.
        centroid: (2,) [m] of the area.
    """

    vertices: np.ndarray
    normals: np.ndarray = field(init=False)
    offsets: np.ndarray = field(init=False)
    centroid: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        """Derive edges and centroid once; they are read every tick."""
        normals, offsets, area, cx, cy = [], [], 0.0, 0.0, 0.0
        points = self.vertices.tolist()
        for (x, y), (xn, yn) in zip(points, points[1:] + points[:1], strict=True):  # a dozen corners: no numpy
            length = math.hypot(xn - x, yn - y)
            nx, ny = (yn - y) / length, (x - xn) / length
            normals.append((nx, ny))
            offsets.append(nx * x + ny * y)
            w = x * yn - xn * y
            area, cx, cy = area + w, cx + (x + xn) * w, cy + (y + yn) * w
        object.__setattr__(self, "normals", np.array(normals))
        object.__setattr__(self, "offsets", np.array(offsets))
        object.__setattr__(self, "centroid", np.array((cx / (3.0 * area), cy / (3.0 * area))))

    def signed_margin(self, point: np.ndarray) -> float:
        """Distance [m] from the point (2,) to the nearest edge line: positive inside, negative outside."""
        return float((self.offsets - self.normals @ point).min())

    def contains(self, point: np.ndarray, *, tolerance: float = 0.0) -> bool:
        """Whether the point (2,) lies inside, up to ``tolerance`` [m]."""
        return self.signed_margin(point) >= -tolerance

    def scaled(self, factor: float) -> "ConvexPolygon":
        """The polygon with its vertices scaled about its centroid."""
        return ConvexPolygon(self.centroid + factor * (self.vertices - self.centroid))

    def moved(self, rotation: np.ndarray, translation: np.ndarray) -> "ConvexPolygon":
        """The polygon turned by ``rotation`` (2, 2) and then shifted by ``translation`` (2,) [m]."""
        return ConvexPolygon(self.vertices @ rotation.T + translation)

    def distance_to_edge(self, point: np.ndarray, direction: np.ndarray) -> float:
        """Distance [m] from an inner point (2,) along a unit direction (2,) to the boundary."""
        speed = self.normals @ direction
        ahead = speed > 1e-12
        return float(((self.offsets - self.normals @ point)[ahead] / speed[ahead]).min())


def convex_hull(points: Iterable[Iterable[float]]) -> ConvexPolygon:
    """The convex hull of points (n, 2) [m] (monotone chain). Raises ValueError when they span no area.

    Points are snapped to whole nanometres: rounding dust in coordinates that should be equal would spoil their order.
    """
    pts = sorted({(round(float(x), 9), round(float(y), 9)) for x, y in points})

    def half(ordered: list[tuple[float, float]]) -> list[tuple[float, float]]:
        chain: list[tuple[float, float]] = []
        for x, y in ordered:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2], chain[-1]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 1e-15:
                    break
                chain.pop()
            chain.append((x, y))
        return chain[:-1]

    hull = half(pts) + half(pts[::-1])
    if len(hull) < 3:
        raise ValueError(f"{len(pts)} distinct points span no area")
    return ConvexPolygon(np.array(hull))


def minkowski_sum(one: ConvexPolygon, other: ConvexPolygon) -> ConvexPolygon:
    """All sums of a point of one convex polygon and a point of another [m]."""
    return convex_hull((one.vertices[:, None, :] + other.vertices[None, :, :]).reshape(-1, 2))


_TOLERANCE = 1e-9  # m: a candidate computed from two edges lies on them only up to rounding


def project_onto_halfplanes(point: np.ndarray, normals: np.ndarray, bounds: np.ndarray) -> np.ndarray | None:
    """The point nearest to ``point`` that satisfies ``normals @ p <= bounds``, or None when nothing does.

    The nearest point is the point itself, its projection on one edge, or a crossing of two edges: with the dozen
    edges of a sole all of them are tried at once, which is exact and needs no iteration.

    Args:
        point: (2,) [m].
        normals: (k, 2) unit outward normals.
        bounds: (k,) [m].
    """
    excess = normals @ point - bounds
    if excess.max() <= _TOLERANCE:
        return point
    on_edges = point - excess[:, None] * normals
    i, j = np.triu_indices(len(bounds), k=1)
    determinant = normals[i, 0] * normals[j, 1] - normals[i, 1] * normals[j, 0]
    crossing = np.abs(determinant) > 1e-9
    i, j, determinant = i[crossing], j[crossing], determinant[crossing]
    crossings = np.column_stack(
        (
            (bounds[i] * normals[j, 1] - bounds[j] * normals[i, 1]) / determinant,
            (bounds[j] * normals[i, 0] - bounds[i] * normals[j, 0]) / determinant,
        )
    )
    candidates = np.vstack((on_edges, crossings))
    feasible = (candidates @ normals.T - bounds).max(axis=1) <= _TOLERANCE
    if not feasible.any():
        return None
    candidates = candidates[feasible]
    return candidates[((candidates - point) ** 2).sum(axis=1).argmin()]


def least_violating_point(
    hard_normals: np.ndarray, hard_bounds: np.ndarray, soft_normals: np.ndarray, soft_bounds: np.ndarray
) -> np.ndarray:
    """The point inside the hard half-planes whose worst violation of the soft ones is least (a 3-variable LP).

    The optimum (p, t) of "minimise t subject to hard, soft <= bound + t" is a vertex, i.e. three constraints hold
    with equality: all triples are solved at once.
    """
    rows = np.vstack(
        (
            np.column_stack((hard_normals, np.zeros(len(hard_normals)))),
            np.column_stack((soft_normals, -np.ones(len(soft_normals)))),
        )
    )
    bounds = np.concatenate((hard_bounds, soft_bounds))
    triples = np.array(
        [(i, j, k) for i in range(len(rows)) for j in range(i) for k in range(j) if i >= len(hard_bounds)]
    )
    systems = rows[triples]
    regular = np.abs(np.linalg.det(systems)) > 1e-9
    vertices = np.linalg.solve(systems[regular], bounds[triples[regular]][..., None])[..., 0]
    feasible = (vertices @ rows.T - bounds).max(axis=1) <= 1e-7
    vertices = vertices[feasible]
    return vertices[vertices[:, 2].argmin(), :2]
