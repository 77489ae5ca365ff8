"""eta = J / J_cap, and the accounts of what lies above 1."""

import dataclasses

import numpy as np
import pytest

from surefoot.control.settings import ControllerSettings
from surefoot.experiments.bench.episode import play
from surefoot.experiments.bench.impulse_budget import Ledger, ledger_of, momentum_ledger
from surefoot.experiments.scenario.bounds import push_bound, support_polygon_at_rest
from surefoot.experiments.scenario.scenario import scenario_from_table


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


def test_the_accounts_of_a_flywheel_name_its_angular_momentum(point_mass):
    bound = push_bound(pushed(0.0))
    impulse = 1.04 * bound.impulse_ns
    ledger = momentum_ledger(point_mass(bound, impulse, moment_nm=60.0, hold_s=0.3), bound, 0.0, impulse)
    kappa = -np.expm1(-bound.omega * 0.1) / (bound.omega * 0.1)
    height = 9.81 / bound.omega**2
    expected = 60.0 / (bound.omega * height * kappa) * -np.expm1(-bound.omega * 0.3)
    assert ledger.angular_momentum_ns == pytest.approx(expected, rel=2e-3)
    assert ledger.vertical_ns == pytest.approx(0.0, abs=1e-9)
    assert abs(ledger.gap_ns) < 2e-3 * bound.impulse_ns  # the integration of this test
    assert ledger.excess_ns == pytest.approx(0.04 * bound.impulse_ns)
    assert ledger.adds_up
    assert list(ledger.causes) == ["angular_momentum_ns"]


def test_a_foot_that_slides_is_a_cause_by_its_value_and_sign(point_mass):
    """The edge goes forward by 2 cm within the push: the integral of that by hand."""
    bound = push_bound(pushed(0.0))
    impulse, way, duration, omega = 1.05 * bound.impulse_ns, 0.02, 0.1, bound.omega
    ledger = momentum_ledger(point_mass(bound, impulse, slide_m=way), bound, 0.0, impulse)
    kappa = -np.expm1(-omega * duration) / (omega * duration)
    ramp = way / duration * (1.0 / omega - np.exp(-omega * duration) * (duration + 1.0 / omega))
    expected = bound.mass_kg * omega / kappa * (ramp + way * np.exp(-omega * duration))
    assert ledger.foot_moved_ns == pytest.approx(expected, rel=5e-3)
    assert ledger.sole_ns < 0.0 and abs(ledger.angular_momentum_ns) < 1e-9
    assert ledger.adds_up
    assert ledger.causes == {"foot_moved_ns": ledger.foot_moved_ns}


def test_a_push_that_starts_between_two_ticks_has_the_same_accounts(point_mass):
    bound = push_bound(pushed(0.0))
    impulse = 0.9 * bound.impulse_ns
    on, between = (
        momentum_ledger(point_mass(bound, impulse, begins_s=0.3), bound, start, impulse) for start in (0.3, 0.2991)
    )
    assert between.sole_ns == pytest.approx(on.sole_ns, rel=1e-9)
    assert between.ends_ns == pytest.approx(on.ends_ns, abs=1e-9)


@pytest.mark.parametrize(
    ("what", "change"),
    [
        ("com_velocity", lambda v: v * 1.05 + 0.01),
        ("force", lambda f: f * (1.0, 1.0, 0.97)),
        ("moment_about_com", lambda m: m + (0.0, 3.0, 0.0)),
        ("zmp_load", lambda p: p + (10.0, 0.0)),
        ("zmp_load", lambda p: p * np.nan),
    ],
)
def test_a_history_that_is_wrong_anywhere_does_not_add_up(point_mass, what, change):
    bound = push_bound(pushed(0.0))
    impulse = 1.04 * bound.impulse_ns
    history = point_mass(bound, impulse, moment_nm=60.0)
    assert momentum_ledger(history, bound, 0.0, impulse).adds_up
    wrong = dataclasses.replace(history, **{what: change(getattr(history, what))})
    assert not momentum_ledger(wrong, bound, 0.0, impulse).adds_up


def test_a_foot_that_is_not_where_it_is_said_to_be_puts_the_zmp_beyond_the_sole(point_mass):
    """The gap does not see it: what the sole has too much, the foot has too little."""
    bound = push_bound(pushed(0.0))
    impulse = 1.04 * bound.impulse_ns
    history = point_mass(bound, impulse, moment_nm=60.0)
    behind = dataclasses.replace(history, sole_corners=history.sole_corners - 0.05 * bound.normal)
    ledger = momentum_ledger(behind, bound, 0.0, impulse)
    assert ledger.sole_ns > 0.0 > ledger.foot_moved_ns
    assert abs(ledger.gap_ns) < 2e-3 * bound.impulse_ns
    assert not ledger.adds_up and ledger.unexplained_ns == ledger.sole_ns


def test_what_adds_up_and_what_made_it():
    def ledger(*entries):  # impulse, bound, sole, foot moved, angular momentum, vertical, ends
        return Ledger(103.0, 100.0, *entries)

    slid = ledger(-8.0, 10.0, -1.0, 1.5, 0.5)
    assert slid.adds_up and slid.gap_ns == 0.0
    assert list(slid.causes.items()) == [("foot_moved_ns", 10.0), ("vertical_ns", 1.5)]  # 0.5 % of 100 is nothing
    assert ledger(0.0, 2.6, 0.0, 0.0, 0.0).adds_up and ledger(0.0, 3.4, 0.0, 0.0, 0.0).adds_up
    for short in (ledger(0.0, 2.4, 0.0, 0.0, 0.0), ledger(0.0, 3.6, 0.0, 0.0, 0.0)):
        assert not short.adds_up and short.unexplained_ns == pytest.approx(0.6)
    assert not ledger(0.6, 2.4, 0.0, 0.0, 0.0).adds_up  # the ZMP beyond the sole
    assert not any(ledger(*np.where(np.arange(5) == i, np.nan, 0.6)).adds_up for i in range(5))
    assert Ledger(100.2, 100.0, -0.2, 0.0, 0.3, 0.1, 0.0).causes == {"angular_momentum_ns": 0.3}  # the greatest, always


def test_a_row_of_the_table_holds_its_ledger():
    whole = Ledger(103.0, 100.0, -8.0, 10.0, -1.0, 1.5, 0.5)
    row = {"excess_ns": whole.excess_ns, **{key: value for key, value in vars(whole).items()}}
    assert ledger_of(row | {"explained": False}) == whole


@pytest.mark.parametrize("direction", [90.0, 225.0])
def test_the_accounts_of_a_simulated_push_close(direction):
    scenario = pushed(direction, impulse=12.0, seconds=2.5)
    ground = play(scenario, "two-part", keep_ground=True).ground
    assert ground is not None
    bound = push_bound(scenario)
    ledger = momentum_ledger(ground, bound, 0.1, 12.0)
    assert abs(ledger.gap_ns) < 2e-4 * bound.impulse_ns
    assert abs(ledger.vertical_ns) < 0.02 * bound.impulse_ns
    assert ledger.sole_ns < 0.0
    assert abs(ledger.foot_moved_ns) < 0.01 * bound.impulse_ns


def test_the_support_polygon_at_rest_is_the_sole_below_the_stance_ankle():
    low, high = (f(support_polygon_at_rest(pushed(0.0)).vertices, axis=0) for f in (np.min, np.max))
    assert low == pytest.approx((-0.12, 0.02))
    assert high == pytest.approx((0.17, 0.20))
