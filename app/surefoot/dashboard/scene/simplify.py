"""Meshes with fewer faces: points that share a cell of a grid become one, where it keeps the surface best.

Lindstrom, "Out-of-core simplification of large polygonal models" (2000): of each cell the point with the least sum of
squared distances to the planes of the faces that touch it.
"""

import numpy as np

_FINEST = 512  # cells along the longest edge
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
    coarse, fine = 1, _FINEST
    while fine - coarse > 1:
        middle = (coarse + fine) // 2
        _, left = _clustered(vertices, faces, middle)
        coarse, fine = (middle, fine) if len(left) <= most_faces else (coarse, middle)
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
        turned = np.take_along_axis(corners, (first[:, None] + np.arange(3)) % 3, axis=1)
        corners = np.unique(turned, axis=0)
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
        np.add.at(matrices, cell, normal[:, :, None] * normal[:, None, :])
        np.add.at(sides, cell, apart[:, None] * normal)
    trace = np.einsum("kii->k", matrices) * _TOWARDS_MEAN + np.finfo(float).tiny
    shift = np.linalg.solve(matrices + trace[:, None, None] * np.eye(3), sides[:, :, None])[:, :, 0]
    return mean + np.clip(shift, -0.5 * size, 0.5 * size)
