"""Meshes with fewer faces: points that share a cell of a grid become one, where it keeps the surface best.

Lindstrom, "Out-of-core simplification of large polygonal models" (2000): of each cell the point with the least sum of
squared distances to the planes of the faces that touch it.
"""

import numpy as np

_FINEST = 512  # cells along the longest edge
_FIRST = 24  # with which the search begins
_ENOUGH = 0.95  # of the faces allowed: no finer grid is looked for
_TOWARDS_MEAN = 1e-3  # of the quadric's trace: settles where the planes leave a direction free


def simplified(vertices: np.ndarray, faces: np.ndarray, most_faces: int) -> tuple[np.ndarray, np.ndarray]:
    """The mesh itself where it is small enough, else one with at most so many faces, but never with none.

    Args:
        vertices: (n, 3) [m].
        faces: (m, 3) indices of the vertices.
        most_faces: how many may be left.

    Returns:
        Vertices and faces.
    """
    if len(faces) <= most_faces:
        return vertices, faces
    coarse, fine, along, close = 1, _FINEST, _FIRST, False
    while fine - coarse > 1 and not close:
        along = min(max(along, coarse + 1), fine - 1)
        count = len(_clustered(vertices, faces, along)[1])
        coarse, fine = (along, fine) if count <= most_faces else (coarse, along)
        close = _ENOUGH * most_faces <= count <= most_faces
        along = round(along * np.sqrt((1.0 - 0.5 * (1.0 - _ENOUGH)) * most_faces / max(count, 1)))  # of a surface
    for along in (coarse, fine):
        cells, left = _clustered(vertices, faces, along)
        if len(left):
            break
    else:  # splinters, smaller than the finest cell
        return vertices, faces
    points = _best_points(vertices, faces, cells, _cell_size(vertices, along))
    used, numbers = np.unique(left, return_inverse=True)
    return points[used], numbers.reshape(left.shape)


def _cell_size(vertices: np.ndarray, along: int) -> float:
    return float(np.ptp(vertices, axis=0).max()) / along


def _clustered(vertices: np.ndarray, faces: np.ndarray, along: int) -> tuple[np.ndarray, np.ndarray]:
    """Number of each vertex's cell (n,), and the faces (k, 3) that still have three corners, each once."""
    size = _cell_size(vertices, along)
    places = np.minimum((vertices - vertices.min(axis=0)) / size, along - 1).astype(np.int64)
    keys = (places[:, 0] * along + places[:, 1]) * along + places[:, 2]
    cells = np.unique(keys, return_inverse=True)[1].reshape(-1)
    corners = cells[faces]
    a, b, c = corners.T
    corners = corners[(a != b) & (b != c) & (c != a)]
    if len(corners):
        first = corners.argmin(axis=1)  # turned, not sorted: a face keeps the side that it shows
        a, b, c = np.take_along_axis(corners, (first[:, None] + np.arange(3)) % 3, axis=1).T
        count = int(cells.max()) + 1  # at most as many as there are vertices: the number of a face fits into 63 bits
        numbers = np.unique((a * count + b) * count + c)
        corners = np.column_stack((numbers // count**2, numbers // count % count, numbers % count))
    return cells, corners


def _best_points(vertices: np.ndarray, faces: np.ndarray, cells: np.ndarray, size: float) -> np.ndarray:
    """(cells, 3) the point of each cell that lies nearest to the planes of the faces that touch it."""
    count = int(cells.max()) + 1
    shares = np.bincount(cells, minlength=count)
    mean = np.column_stack([np.bincount(cells, column, minlength=count) for column in vertices.T]) / shares[:, None]
    one, two, three = (vertices[faces[:, i]] for i in range(3))
    normal = np.cross(two - one, three - one)  # as long as twice the area, which weighs the squared distance
    matrices, sides = np.zeros((count, 3, 3)), np.zeros((count, 3))
    for i in range(3):
        cell = cells[faces[:, i]]
        apart = ((one - mean[cell]) * normal).sum(axis=1)
        for row in range(3):
            sides[:, row] += np.bincount(cell, apart * normal[:, row], minlength=count)
            for column in range(3):
                weights = normal[:, row] * normal[:, column]
                matrices[:, row, column] += np.bincount(cell, weights, minlength=count)
    trace = np.einsum("kii->k", matrices) * _TOWARDS_MEAN + np.finfo(float).tiny
    shift = np.linalg.solve(matrices + trace[:, None, None] * np.eye(3), sides[:, :, None])[:, :, 0]
    return mean + np.clip(shift, -0.5 * size, 0.5 * size)
