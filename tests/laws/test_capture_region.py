"""Law of the capture regions: the polygons against a search over a simulated pendulum, and against one dimension."""

import itertools

import numpy as np
import pytest

from surefoot.geometry.polygon import ConvexPolygon, convex_hull, minkowski_sum
from surefoot.momentum.capture_region import (
    StepReach,
    capture_region_1,
    capture_region_2,
    led_into,
)
from surefoot.momentum.zmp import capture_impulse

MASS_KG, HEIGHT_M = 104.81, 0.975
OMEGA = float(np.sqrt(9.81 / HEIGHT_M))
SOLE = convex_hull(((0.17, 0.09), (-0.12, 0.06), (-0.12, -0.06), (0.17, -0.09)))
COM = np.array((0.02, 0.0))  # ahead of the ankle, above it sideways
T = 0.4


def places(side: float) -> ConvexPolygon:
    """0.3 m back to 0.4 m ahead, 0.2 to 0.3 m to the left (+1) or to the right (-1)."""
    return convex_hull((x, side * y) for x in (-0.3, 0.4) for y in (0.2, 0.3))


def right_step(time_s: float = T) -> StepReach:
    return StepReach(places=places(-1.0), sole=SOLE, landing_s=time_s)


def left_step(time_s: float = T) -> StepReach:
    return StepReach(places=places(1.0), sole=SOLE, landing_s=time_s)


def after(xi: np.ndarray, zmp: np.ndarray, time_s: float) -> np.ndarray:
    """The pendulum's capture point after a time with the ZMP held still, step by step (1 000 per second)."""
    steps = round(time_s * 1_000)
    for _ in range(steps):
        middle = xi + 0.5 * OMEGA * (xi - zmp) * time_s / steps
        xi = xi + OMEGA * (middle - zmp) * time_s / steps
    return xi


def grid(polygon: ConvexPolygon, n: int) -> list[np.ndarray]:
    """Its corners and points along its edges."""
    corners = polygon.vertices
    edges = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    return [a + share * (b - a) for a, b in edges for share in np.linspace(0.0, 1.0, n, endpoint=False)]


def best_margin(xi: np.ndarray, step: StepReach, then=None) -> float:
    """The best that any held ZMP and any foothold of a grid can do: how far inside the hull of both soles it ends [m].

    ``then``: what is asked of the capture point relative to the foot that has landed instead.
    """
    ends = [after(xi, zmp, step.landing_s) for zmp in grid(SOLE, 5)]
    best = -np.inf
    for place in grid(step.places, 9):
        landed = SOLE.vertices + place
        both = convex_hull([*SOLE.vertices.tolist(), *landed.tolist()]) if then is None else None
        for end in ends:
            best = max(best, both.signed_margin(end) if both else then(end - place))
    return best


def rays(n: int) -> np.ndarray:
    angles = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False) + 0.1
    return np.column_stack((np.cos(angles), np.sin(angles)))


@pytest.mark.parametrize("direction", rays(8), ids=str)
def test_one_step_catches_what_lies_inside_and_nothing_outside(direction):
    region = capture_region_1(SOLE, right_step(), OMEGA)
    edge = region.distance_to_edge(COM, direction)
    assert best_margin(COM + 0.97 * edge * direction, right_step()) > 0.0
    assert best_margin(COM + 1.01 * edge * direction, right_step()) < 0.0


@pytest.mark.parametrize("direction", rays(5), ids=str)
def test_two_steps_catch_what_lies_inside_and_nothing_outside(direction):
    step, second = right_step(0.3), left_step(0.3)
    region = capture_region_2(SOLE, step, second, OMEGA)
    edge = region.distance_to_edge(COM, direction)
    inner = capture_region_1(SOLE, second, OMEGA)  # held against the search above
    assert best_margin(COM + 0.97 * edge * direction, step, inner.signed_margin) > 0.0
    assert best_margin(COM + 1.01 * edge * direction, step, inner.signed_margin) < 0.0


def test_along_a_line_it_is_the_known_one_dimensional_bound():
    """Forward, d_1 = r + l e^(-omega T): r from the CoM to the edge, l the reach (Koolen et al. 2012)."""
    edge = SOLE.distance_to_edge(COM, np.array((1.0, 0.0)))
    region = capture_region_1(SOLE, right_step(), OMEGA)
    aim = region.vertices[:, 0].max() - COM[0]
    assert aim == pytest.approx(edge + 0.4 * np.exp(-OMEGA * T), abs=2e-9)


def test_a_step_that_takes_for_ever_is_none_and_one_at_once_is_all():
    never = capture_region_1(SOLE, right_step(100.0), OMEGA)
    np.testing.assert_allclose(never.vertices, SOLE.vertices, atol=1e-8)
    at_once = capture_region_1(SOLE, right_step(0.0), OMEGA)
    landed = minkowski_sum(places(-1.0), SOLE)
    hull = convex_hull([*SOLE.vertices.tolist(), *landed.vertices.tolist()])
    np.testing.assert_allclose(at_once.vertices, hull.vertices, atol=1e-9)


def test_the_sooner_it_lands_the_more_it_catches():
    regions = [capture_region_1(SOLE, right_step(time_s), OMEGA) for time_s in (0.5, 0.4, 0.3)]
    for later, sooner in itertools.pairwise(regions):
        assert all(sooner.contains(corner, tolerance=1e-9) for corner in later.vertices)
        assert not all(later.contains(corner, tolerance=1e-3) for corner in sooner.vertices)


# What a step from the left foot gains, found beforehand by a search of another kind: landing after 0.4 s, same reach
GAINS = {0: 1.75, 45: 1.00, 90: 1.00, 135: 1.00, 180: 1.60, 225: 2.25, 270: 2.25, 315: 2.08}


@pytest.mark.parametrize("angle", GAINS)
def test_the_impulse_that_a_step_survives_is_as_much_larger_as_another_search_found(angle):
    direction = np.array((np.cos(np.radians(angle)), np.sin(np.radians(angle))))
    region = capture_region_1(SOLE, right_step(), OMEGA)
    impulses = [capture_impulse(MASS_KG, OMEGA, support, COM, direction, 0.1) for support in (region, SOLE)]
    assert impulses[0] / impulses[1] == pytest.approx(GAINS[angle], abs=0.02)


def test_from_two_feet_the_weight_has_to_leave_a_foot_first():
    both = convex_hull([*SOLE.vertices.tolist(), *(SOLE.vertices - (0.0, 0.22)).tolist()])
    stepping = capture_region_1(SOLE, right_step(), OMEGA)
    first = led_into(stepping, both, OMEGA, 0.1)
    assert led_into(stepping, both, OMEGA, 0.0) is stepping
    for corner in first.vertices:  # each corner is led into the other region by a ZMP that both soles have
        ends = [after(corner, zmp, 0.1) for zmp in grid(both, 5)]
        assert max(stepping.signed_margin(end) for end in ends) == pytest.approx(0.0, abs=1e-4)
