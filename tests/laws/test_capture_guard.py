"""Properties of margin and capture guard: what they leave alone, what they promise, what they do when they conflict."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import linprog

from surefoot.control.balance.capture_guard import guard_bounds, limit_zmp, scaled_offsets
from surefoot.geometry.polygon import convex_hull

SOLE = convex_hull(((0.17, 0.09), (-0.12, 0.06), (-0.12, -0.06), (0.17, -0.09)))
MARGIN = 0.95
SEEDS = range(200)
TOLERANCE_M = 2e-9  # what the projection takes as being on an edge


def draw(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A wanted ZMP and a capture point, in and around the sole."""
    rng = np.random.default_rng(seed)
    return rng.uniform((-0.25, -0.2), (0.3, 0.2)), rng.uniform((-0.2, -0.15), (0.25, 0.15))


def in_margin(point: np.ndarray, margin: float = MARGIN) -> bool:
    return SOLE.scaled(margin).contains(point, tolerance=TOLERANCE_M)


def test_offsets_are_those_of_the_scaled_polygon():
    assert_allclose(scaled_offsets(SOLE, 0.8), SOLE.scaled(0.8).offsets, rtol=0, atol=1e-15)


@pytest.mark.parametrize("guard", [True, False])
@pytest.mark.parametrize("seed", range(40))
def test_a_zmp_within_all_limits_is_left_alone(seed, guard):
    rng = np.random.default_rng(seed)
    zmp, xi = (SOLE.centroid + rng.uniform(-0.02, 0.02, size=2) for _ in range(2))
    limited = limit_zmp(zmp, xi, SOLE, MARGIN, guard=guard)
    assert limited.point is zmp
    assert not limited.active
    assert not limited.relaxed


@pytest.mark.parametrize("guard", [True, False])
@pytest.mark.parametrize("margin", [0.95, 0.5, 1.0])
@pytest.mark.parametrize("seed", range(40))
def test_the_result_always_keeps_the_margin(seed, margin, guard):
    limited = limit_zmp(*draw(seed), SOLE, margin, guard=guard)
    assert in_margin(limited.point, margin)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_result_keeps_the_guard_unless_it_says_that_it_was_relaxed(seed):
    zmp, xi = draw(seed)
    limited = limit_zmp(zmp, xi, SOLE, MARGIN, guard=True)
    shortfall = (guard_bounds(SOLE, xi, MARGIN) - SOLE.normals @ limited.point).max()
    assert (shortfall > 1e-7) == limited.relaxed
    assert limited.active == (limited.point is not zmp)


@pytest.mark.parametrize("seed", SEEDS)
def test_nothing_nearer_would_do(seed):
    """Between the result and the wanted ZMP every point breaks a limit: the change is as small as it can be."""
    zmp, xi = draw(seed)
    limited = limit_zmp(zmp, xi, SOLE, MARGIN, guard=True)
    if not limited.active or limited.relaxed:
        return
    for part in (0.01, 0.1, 0.5, 1.0):
        nearer = limited.point + part * (zmp - limited.point)
        kept = in_margin(nearer) and (SOLE.normals @ nearer >= guard_bounds(SOLE, xi, MARGIN) - TOLERANCE_M).all()
        assert not kept or np.linalg.norm(nearer - limited.point) < 1e-7


@pytest.mark.parametrize("edge", range(4))
@pytest.mark.parametrize("beyond_m", [0.0, 0.002, 0.004])
def test_near_an_edge_the_zmp_is_ahead_of_the_capture_point(edge, beyond_m):
    """When the capture point is at the 0.85 edge or a little beyond, the ZMP is at least as far out."""
    n, guard_edge = SOLE.normals[edge], SOLE.scaled(0.85)
    middle = 0.5 * (guard_edge.vertices[edge] + guard_edge.vertices[(edge + 1) % 4])
    xi = middle + beyond_m * n
    limited = limit_zmp(SOLE.centroid, xi, SOLE, MARGIN, guard=True)
    assert limited.active
    ceiling = scaled_offsets(SOLE, MARGIN)[edge] - 0.002
    assert n @ limited.point >= min(n @ xi, ceiling) - 1e-9
    unguarded = limit_zmp(SOLE.centroid, xi, SOLE, MARGIN, guard=False)
    assert not unguarded.active


@pytest.mark.parametrize("xi", [(0.11, 0.03), (0.16, 0.0), (-0.11, -0.04), (0.3, 0.2)])
def test_guard_is_the_documented_formula(xi):
    """n.c >= min(n.xi - 2 (b_0.85 - n.xi), b_0.95 - 2 mm) for every edge."""
    for n, b_085, b_095, least in zip(
        SOLE.normals,
        SOLE.scaled(0.85).offsets,
        SOLE.scaled(0.95).offsets,
        guard_bounds(SOLE, np.array(xi), 0.95),
        strict=True,
    ):
        assert least == pytest.approx(min(n @ xi - 2.0 * (b_085 - n @ xi), b_095 - 0.002), abs=1e-12)


def test_a_capture_point_deep_inside_asks_for_nothing():
    least = guard_bounds(SOLE, SOLE.centroid, MARGIN)
    for zmp in SOLE.scaled(0.5).vertices:
        assert (SOLE.normals @ zmp >= least).all()


def test_conflicts_are_solved_with_the_least_worst_violation():
    """Where a short edge lies between two that both ask for the ZMP: random polygons, against a linear program."""
    relaxed = 0
    for seed in range(400):
        rng = np.random.default_rng(seed)
        polygon = convex_hull(rng.normal(scale=0.1, size=(9, 2)))
        zmp, xi = rng.normal(scale=0.1, size=2), rng.normal(scale=0.2, size=2)
        limited = limit_zmp(zmp, xi, polygon, MARGIN, guard=True)
        if not limited.relaxed:
            continue
        relaxed += 1
        least = guard_bounds(polygon, xi, MARGIN)
        n = len(least)
        answer = linprog(
            [0.0, 0.0, 1.0],
            np.vstack((np.c_[polygon.normals, np.zeros(n)], np.c_[-polygon.normals, -np.ones(n)])),
            np.r_[scaled_offsets(polygon, MARGIN), -least],
            bounds=[(None, None)] * 3,
        )
        assert answer.success
        assert (least - polygon.normals @ limited.point).max() == pytest.approx(answer.fun, abs=1e-7)
        assert polygon.scaled(MARGIN).contains(limited.point, tolerance=1e-7)
    assert relaxed > 20
