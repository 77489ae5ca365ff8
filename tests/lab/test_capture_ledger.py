"""eta = J / J_cap, and the accounts of what lies above 1."""

import numpy as np
import pytest

from app.control.settings import ControllerSettings
from app.experiments.lab.bounds import push_bound, support_polygon_at_rest
from app.experiments.lab.episode import GroundHistory, play
from app.experiments.lab.ledger import Ledger, momentum_ledger
from app.experiments.scenario import scenario_from_table

DT = 0.001


def pushed(direction: float, *, support="left", duration=0.1, impulse=10.0, seconds=1.0, **more):
    push = {"direction_deg": direction, "impulse_ns": impulse, "start_s": 0.1, "duration_s": duration}
    return scenario_from_table(
        {"robot": "bip", "support": support, "duration_s": seconds, "pushes": [push], **more}, "push"
    )


@pytest.mark.parametrize(
    ("support", "direction", "impulse"),
    [("left", 0.0, 58.2), ("left", 180.0, 54.3), ("left", 90.0, 28.9), ("double", 0.0, 58.2), ("double", 90.0, 71.6)],
)
def test_capture_bound_of_bip_for_a_tenth_of_a_second(support, direction, impulse):
    assert push_bound(pushed(direction, support=support)).impulse_ns == pytest.approx(impulse, abs=0.06)


def test_the_bound_is_that_of_the_pushs_duration_and_the_plants_mass():
    shorter, longer = (push_bound(pushed(90.0, duration=t)).impulse_ns for t in (0.001, 0.3))
    assert shorter < 25.0 < 28.9 < longer
    heavy = push_bound(pushed(90.0, physics={"mass_scale": 1.1})).impulse_ns
    assert heavy == pytest.approx(1.1 * push_bound(pushed(90.0)).impulse_ns)


def test_linear_impulse_is_the_bound_times_omega_over_damping():
    bound = push_bound(pushed(0.0))
    expected = bound.impulse_ns * np.sqrt(9.81 / 0.975) / 14.0
    assert bound.linear_impulse_ns(ControllerSettings()) == pytest.approx(expected, rel=1e-12)


def flywheel(bound, impulse_ns: float, moment_nm: float, hold_s: float) -> GroundHistory:
    """A point mass on its edge with a flywheel, by semi-implicit steps: pushed, saved by a moment about G, at rest."""
    g = 9.81
    h, m = g / bound.omega**2, bound.mass_kg
    x, v, rows = float(bound.com @ bound.direction), 0.0, []
    edge = bound.offset
    for i in range(4000):
        t = i * DT
        xi = x + v / bound.omega
        zmp = min(edge, xi + 2.0 * (xi - 0.02)) if t > 0.0 else x
        moment = moment_nm if t < hold_s else 0.0  # pitching forward brakes a forward fall
        force = m * bound.omega**2 * (x - zmp) - moment / h
        push = impulse_ns / bound.duration_s if t < bound.duration_s - 1e-9 else 0.0
        rows.append((t, x, v, force, moment))
        v += DT * (force + push) / m
        x += DT * v
    t, x, v, force, moment = np.array(rows).T
    zero = np.zeros_like(t)
    return GroundHistory(
        t, np.column_stack((x, zero, zero + h)), np.column_stack((v, zero, zero)),
        np.column_stack((force, zero, zero + m * g)), np.column_stack((zero, moment, zero)),
        np.tile(edge * bound.normal, (len(t), 1, 1)),
    )  # fmt: skip


def test_the_accounts_of_a_flywheel_name_its_angular_momentum():
    bound = push_bound(pushed(0.0))
    impulse = 1.04 * bound.impulse_ns
    ledger = momentum_ledger(flywheel(bound, impulse, 60.0, 0.3), bound, 0.0, impulse)
    kappa = -np.expm1(-bound.omega * 0.1) / (bound.omega * 0.1)
    height = 9.81 / bound.omega**2
    expected = 60.0 / (bound.omega * height * kappa) * -np.expm1(-bound.omega * 0.3)
    assert ledger.angular_momentum_ns == pytest.approx(expected, rel=2e-3)
    assert ledger.vertical_ns == pytest.approx(0.0, abs=1e-9)
    assert abs(ledger.gap_ns) < 2e-3 * bound.impulse_ns  # the integration of this test
    assert ledger.excess_ns == pytest.approx(0.04 * bound.impulse_ns)
    assert ledger.explained


def test_an_excess_without_angular_momentum_is_not_explained():
    assert Ledger(103.0, 100.0, 0.0, 3.0, 0.0, 0.0, 0.0).unexplained_ns == 3.0  # a slipping foot is no excuse
    assert not Ledger(103.0, 100.0, 3.0, 0.0, 0.0, 0.0, 0.0).explained
    assert not Ledger(103.0, 100.0, 0.0, 0.0, -5.0, 8.0, 0.0).explained
    assert Ledger(103.0, 100.0, 0.0, 0.0, 1.0, 2.0, 0.0).explained  # 2 % are allowed
    assert Ledger(103.0, 100.0, -1.0, 0.0, 4.0, 0.0, 0.0).explained
    assert Ledger(60.0, 100.0, -40.0, 0.0, 0.0, 0.0, 0.0).explained  # nothing to explain below the bound


@pytest.mark.parametrize("direction", [90.0, 225.0])
def test_the_accounts_of_a_simulated_push_close(direction):
    scenario = pushed(direction, impulse=12.0, seconds=2.5)
    ground = play(scenario, "two-part", keep_ground=True).ground
    assert ground is not None
    bound = push_bound(scenario)
    ledger = momentum_ledger(ground, bound, 0.1, 12.0)
    assert abs(ledger.gap_ns) < 1e-3 * bound.impulse_ns
    assert abs(ledger.vertical_ns) < 0.02 * bound.impulse_ns
    assert ledger.sole_ns < 0.0
    assert abs(ledger.foot_moved_ns) < 0.01 * bound.impulse_ns


def test_the_support_polygon_at_rest_is_the_sole_below_the_stance_ankle():
    low, high = (f(support_polygon_at_rest(pushed(0.0)).vertices, axis=0) for f in (np.min, np.max))
    assert low == pytest.approx((-0.12, 0.02))
    assert high == pytest.approx((0.17, 0.20))
