"""Meshes of stones: what the ground leaves to be seen of them."""

import numpy as np

from surefoot.simulation.stones import Stone

Mesh = tuple[np.ndarray, np.ndarray]
_MOST_CORNERS = 6  # of a cube's face once a plane has cut it, and one more
_SIDES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def cube() -> Mesh:
    """Vertices and faces of a cube of edge 1 about the origin."""
    corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    return corners, np.array([face for a, b, c, d in _SIDES for face in ((a, b, c), (a, c, d))])


def half_ball(rings: int = 10, sides: int = 28) -> Mesh:
    """Vertices and faces of the upper half of a ball of diameter 1 about the origin."""
    polar = np.linspace(0.0, 0.5 * np.pi, rings + 1)
    around = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    vertices = np.array([
        (0.5 * np.sin(p) * np.cos(a), 0.5 * np.sin(p) * np.sin(a), 0.5 * np.cos(p)) for p in polar for a in around
    ])  # fmt: skip
    faces = []
    for i in range(rings):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            faces += [(a, a + sides, b + sides), (a, b + sides, b)]
    return vertices, np.array(faces)


def wedge(stone: Stone, top_m: float) -> Mesh:
    """What the ground leaves of a wedge whose highest point is that high: always as many vertices and faces.

    In the ground's axes, from the ground's point below the middle of its top [m].
    """
    half, R = stone.half_lengths(), stone.rotation()
    middle = np.array((0.0, 0.0, top_m - float(np.abs(R[2, :2]).dot(half[:2])))) - R[:, 2] * half[2]
    corners = middle + (2.0 * half * cube()[0]).dot(R.T)
    floor = max(0.0, top_m - stone.height_m)  # one that drops is as thick as it will be
    rows = []
    for side in _SIDES:
        cut = _above([corners[i] for i in side], floor)
        rows += [*cut, *[cut[-1]] * (_MOST_CORNERS - len(cut))]
    fans = [(6 * face, 6 * face + i, 6 * face + i + 1) for face in range(len(_SIDES)) for i in range(1, 5)]
    return np.array(rows), np.array(fans)


def _above(polygon: list[np.ndarray], floor: float) -> list[np.ndarray]:
    """The part of a convex polygon above a height; one point where there is none."""
    kept = []
    for here, there in zip(polygon, [*polygon[1:], polygon[0]], strict=True):
        inside, next_inside = here[2] >= floor, there[2] >= floor
        if inside:
            kept.append(here)
        if inside != next_inside:
            kept.append(here + (floor - here[2]) / (there[2] - here[2]) * (there - here))
    return kept or [np.array((*polygon[0][:2], floor))]
