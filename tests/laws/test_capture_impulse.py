"""Law of the capture bound: its closed form against simulating the pendulum with the best ZMP there is."""

import numpy as np
import pytest

from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.momentum.zmp import capture_impulse, capture_point, natural_frequency

MASS_KG, HEIGHT_M = 104.81, 0.975
OMEGA = np.sqrt(9.81 / HEIGHT_M)
SOLE = convex_hull(((0.17, 0.09), (-0.12, 0.06), (-0.12, -0.06), (0.17, -0.09)))
BOTH_SOLES = convex_hull([(x, y + shift) for x, y in SOLE.vertices.tolist() for shift in (0.11, -0.11)])
DIRECTIONS = {"forward": (1.0, 0.0), "back": (-1.0, 0.0), "left": (0.0, 1.0), "right": (0.0, -1.0)}
COM = np.array((0.02, 0.0))  # ahead of the ankle, above it sideways


def survives(force: float, edge: float, duration: float) -> bool:
    """Simulate x'' = omega^2 (x - c) + F/m with the ZMP c pressed to the edge as soon as the CoM moves towards it.

    That is the most any ZMP in the sole can do. Survived: the capture point has been brought back behind the edge.
    Steps of 20 us, each integrated exactly for constant c and F.
    """
    dt = 2e-5
    c, s = np.cosh(OMEGA * dt), np.sinh(OMEGA * dt)
    x, v = 0.0, 0.0
    for step in range(round((duration + 1.5) / dt)):
        acting = force / MASS_KG if step * dt < duration - 0.5 * dt else 0.0
        target = edge - acting / OMEGA**2
        x, v = target + c * (x - target) + s / OMEGA * v, OMEGA * s * (x - target) + c * v
        if x + v / OMEGA <= 0.0 and acting == 0.0:
            return True
    return x + v / OMEGA < edge


@pytest.mark.parametrize("duration", [0.02, 0.1, 0.5])
@pytest.mark.parametrize("direction", DIRECTIONS.values(), ids=DIRECTIONS.keys())
def test_greatest_survived_impulse_of_a_simulated_pendulum_is_the_closed_form(direction, duration):
    bound = capture_impulse(MASS_KG, OMEGA, SOLE, COM, np.array(direction), duration)
    edge = SOLE.distance_to_edge(COM, np.array(direction))
    # at the bound itself the pendulum balances on the edge for ever: a thousandth to either side decides
    assert survives(0.999 * bound / duration, edge, duration)
    assert not survives(1.001 * bound / duration, edge, duration)


def test_instantaneous_impulse_is_the_limit_of_short_pushes():
    forward = np.array((1.0, 0.0))
    at_once = capture_impulse(MASS_KG, OMEGA, SOLE, COM, forward, 0.0)
    assert at_once == pytest.approx(MASS_KG * OMEGA * 0.15, rel=1e-12)
    assert capture_impulse(MASS_KG, OMEGA, SOLE, COM, forward, 1e-6) == pytest.approx(at_once, rel=1e-5)
    durations = np.linspace(0.0, 1.0, 20)
    bounds = [capture_impulse(MASS_KG, OMEGA, SOLE, COM, forward, t) for t in durations]
    assert (np.diff(bounds) > 0.0).all()  # the longer it takes, the more can be survived


@pytest.mark.parametrize(
    ("support", "direction", "impulse"),
    [
        (SOLE, "forward", 58.2), (SOLE, "back", 54.3), (SOLE, "left", 28.9), (SOLE, "right", 28.9),
        (BOTH_SOLES, "forward", 58.2), (BOTH_SOLES, "left", 71.6), (BOTH_SOLES, "right", 71.6),
    ],
)  # fmt: skip
def test_known_values_of_the_standing_postures(support, direction, impulse):
    found = capture_impulse(MASS_KG, OMEGA, support, COM, np.array(DIRECTIONS[direction]), 0.1)
    assert round(found, 1) == impulse


def test_known_values_do_not_depend_on_the_frame(robot):
    """The same with the robot's own sole, turned and shifted with the CoM."""
    c, s = np.cos(0.4), np.sin(0.4)
    turn, shift = np.array(((c, -s), (s, c))), np.array((0.5, -0.3))
    moved: ConvexPolygon = robot.feet[0].sole.moved(turn, shift)
    found = capture_impulse(robot.mass_kg, OMEGA, moved, turn @ COM + shift, turn @ (0.0, 1.0), 0.1)
    assert round(found, 1) == 28.9


@pytest.mark.parametrize("zmp", [0.0, 0.05, -0.1])
def test_capture_point_runs_away_from_the_zmp_at_its_own_rate(zmp):
    """xi' = omega (xi - c): checked on the exact solution of x'' = omega^2 (x - c)."""
    x, v, t = 0.03, 0.2, 0.3
    c, s = np.cosh(OMEGA * t), np.sinh(OMEGA * t)
    later = np.array((zmp + c * (x - zmp) + s / OMEGA * v, 0.0)), np.array((OMEGA * s * (x - zmp) + c * v, 0.0))
    xi = capture_point(np.array((x, 0.0)), np.array((v, 0.0)), OMEGA)[0]
    assert capture_point(*later, OMEGA)[0] == pytest.approx(zmp + np.exp(OMEGA * t) * (xi - zmp), abs=1e-12)


def test_natural_frequency_is_that_of_the_pendulum_and_finite_near_the_ground():
    assert natural_frequency(0.975, 9.81) == pytest.approx(OMEGA, rel=1e-12)
    assert np.isfinite(natural_frequency(0.0))
    assert np.isfinite(natural_frequency(-1.0))
