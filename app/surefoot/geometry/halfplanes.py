"""The nearest point of an intersection of half-planes, by enumerating its few candidates."""

import numpy as np

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
    crossings = np.column_stack((
        (bounds[i] * normals[j, 1] - bounds[j] * normals[i, 1]) / determinant,
        (bounds[j] * normals[i, 0] - bounds[i] * normals[j, 0]) / determinant,
    ))  # fmt: skip
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
    rows = np.vstack((
        np.column_stack((hard_normals, np.zeros(len(hard_normals)))),
        np.column_stack((soft_normals, -np.ones(len(soft_normals)))),
    ))  # fmt: skip
    bounds = np.concatenate((hard_bounds, soft_bounds))
    triples = np.array([
        (i, j, k) for i in range(len(rows)) for j in range(i) for k in range(j) if i >= len(hard_bounds)
    ])  # fmt: skip
    systems = rows[triples]
    regular = np.abs(np.linalg.det(systems)) > 1e-9
    vertices = np.linalg.solve(systems[regular], bounds[triples[regular]][..., None])[..., 0]
    feasible = (vertices @ rows.T - bounds).max(axis=1) <= 1e-7
    vertices = vertices[feasible]
    return vertices[vertices[:, 2].argmin(), :2]
