"""Convex polygons: hull, edges, margins, centroid; against SciPy's hull and against sums over triangles."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial import ConvexHull

from surefoot.geometry.polygon import ConvexPolygon, convex_hull

SOLE = np.array(((0.17, 0.09), (-0.12, 0.06), (-0.12, -0.06), (0.17, -0.09)))  # counter-clockwise
SEEDS = range(10)
NANOMETRE = {"rtol": 0, "atol": 1e-9}  # hulls are snapped to it


@pytest.fixture(params=SEEDS)
def cloud(request) -> np.ndarray:
    return np.random.default_rng(request.param).normal(scale=0.1, size=(30, 2))


def corner_set(vertices: np.ndarray) -> np.ndarray:
    """The vertices in one order, whatever the hull started with."""
    return np.array(sorted(vertices.tolist(), key=lambda corner: (round(corner[0], 6), corner[1])))


def test_hull_has_the_vertices_that_scipys_has(cloud):
    theirs = cloud[ConvexHull(cloud).vertices]
    assert_allclose(corner_set(convex_hull(cloud).vertices), corner_set(theirs), **NANOMETRE)


def test_hull_is_counter_clockwise_and_strictly_convex(cloud):
    vertices = convex_hull(cloud).vertices
    edges = np.roll(vertices, -1, axis=0) - vertices
    following = np.roll(edges, -1, axis=0)
    assert (edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0]).min() > 0.0


def test_every_point_is_inside_its_hull(cloud):
    polygon = convex_hull(cloud)
    assert all(polygon.contains(point, tolerance=2e-9) for point in cloud)
    assert not polygon.contains(cloud.max(axis=0) + 0.01)


@pytest.mark.parametrize("dust", [1e-17, 1e-16, 1e-15, 1e-13, 1e-11])
@pytest.mark.parametrize("seed", SEEDS)
def test_hull_of_two_soles_does_not_mind_rounding_dust(dust, seed):
    """Eight corners of two level soles, in line up to the rounding of a kinematics chain."""
    rng = np.random.default_rng(seed)
    corners = np.vstack((SOLE + [0.0, 0.11], SOLE - [0.0, 0.11])) + dust * rng.normal(size=(8, 2))
    vertices = convex_hull(corners).vertices
    expected = [[-0.12, -0.17], [-0.12, 0.17], [0.17, -0.2], [0.17, 0.2]]
    assert_allclose(corner_set(vertices), expected, **NANOMETRE)


@pytest.mark.parametrize("dust", [0.0, 1e-16, 1e-13, 1e-10, 1e-9, 1e-8, 1e-6])
@pytest.mark.parametrize("seed", SEEDS)
def test_no_corner_of_a_sole_is_ever_lost(dust, seed):
    rng = np.random.default_rng(seed)
    corners = np.vstack((SOLE + [0.0, 0.11], SOLE - [0.0, 0.11])) + dust * rng.normal(size=(8, 2))
    polygon = convex_hull(corners)
    assert all(polygon.contains(corner, tolerance=2e-9) for corner in corners)


@pytest.mark.parametrize("points", [[(0, 0)], [(0, 0), (1, 1)], [(0, 0), (1, 1), (2, 2)], [(0.3, 0.1)] * 5])
def test_points_that_span_no_area_are_refused(points):
    with pytest.raises(ValueError, match="no area"):
        convex_hull(points)


def test_normals_are_outward_unit_vectors_and_offsets_belong_to_both_ends_of_an_edge(cloud):
    polygon = convex_hull(cloud)
    assert_allclose(np.linalg.norm(polygon.normals, axis=1), 1.0, rtol=1e-12)
    for ends in (polygon.vertices, np.roll(polygon.vertices, -1, axis=0)):
        assert_allclose((polygon.normals * ends).sum(axis=1), polygon.offsets, rtol=0, atol=1e-12)
    assert (polygon.normals @ polygon.vertices.mean(axis=0) < polygon.offsets).all()


def test_centroid_is_that_of_the_triangles_it_is_made_of(cloud):
    polygon = convex_hull(cloud)
    first, areas, centres = polygon.vertices[0], [], []
    for a, b in zip(polygon.vertices[1:-1], polygon.vertices[2:], strict=True):
        (ux, uy), (vx, vy) = a - first, b - first
        areas.append(0.5 * (ux * vy - uy * vx))
        centres.append((first + a + b) / 3.0)
    assert_allclose(polygon.centroid, np.array(areas) @ np.array(centres) / sum(areas), rtol=0, atol=1e-12)


def test_centroid_of_the_sole_lies_ahead_of_its_middle():
    assert_allclose(ConvexPolygon(SOLE).centroid, [0.025 + 0.29 * 0.03 / 0.15 / 6, 0.0], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("point", "margin"), [((0.0, 0.0), None), ((0.16, 0.0), 0.01), ((-0.13, 0.0), -0.01), ((0.17, 0.09), 0.0)]
)
def test_margin_is_positive_inside_zero_on_the_edge_negative_outside(point, margin):
    polygon = ConvexPolygon(SOLE)
    if margin is None:  # the nearest edge below the ankle is a slanted side: y = 0.06 at x = -0.12, 0.09 at 0.17
        slope = 0.03 / 0.29
        margin = (0.06 + 0.12 * slope) / np.hypot(1.0, slope)
    assert polygon.signed_margin(np.array(point)) == pytest.approx(margin, abs=1e-12)
    assert polygon.contains(np.array(point), tolerance=1e-12) == (margin >= 0.0)


def test_scaling_keeps_the_centroid_and_scales_the_area(cloud):
    polygon = convex_hull(cloud)
    small = polygon.scaled(0.85)
    assert_allclose(small.centroid, polygon.centroid, rtol=0, atol=1e-12)
    assert ConvexHull(small.vertices).volume == pytest.approx(0.85**2 * ConvexHull(polygon.vertices).volume, rel=1e-9)
    assert all(polygon.contains(vertex) for vertex in small.vertices)


def test_moving_keeps_margins(cloud):
    polygon = convex_hull(cloud)
    c, s = np.cos(0.7), np.sin(0.7)
    rotation, shift = np.array(((c, -s), (s, c))), np.array((0.3, -0.2))
    moved = polygon.moved(rotation, shift)
    for point in cloud:
        there = rotation @ point + shift
        assert moved.signed_margin(there) == pytest.approx(polygon.signed_margin(point), abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_distance_to_edge_ends_on_the_boundary(seed):
    polygon, rng = ConvexPolygon(SOLE), np.random.default_rng(seed)
    inner, angle = rng.uniform(-0.05, 0.05, size=2), rng.uniform(-np.pi, np.pi)
    direction = np.array((np.cos(angle), np.sin(angle)))
    distance = polygon.distance_to_edge(inner, direction)
    assert distance > 0.0
    assert polygon.signed_margin(inner + distance * direction) == pytest.approx(0.0, abs=1e-12)
