"""What the shipped scenarios show: who stands, who falls, who is warned."""

import pytest

from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import load_scenario

CONTROLLERS = ("two-part", "optimization", "soft-qp", "two-part-literal")
STANDING = ("stand_left", "stand_double")
STANDING_ERROR_M = 0.005


def assert_stands_still(summary, seconds: float) -> None:
    assert summary["fell"] is False
    assert summary["duration_s"] == seconds
    assert summary["com_error_max_m"] < STANDING_ERROR_M
    assert summary["qp_infeasible_ticks"] == summary["fallback_ticks"] == 0
    assert summary["first_limit"] is None
    assert summary["warnings"] == []


@pytest.mark.parametrize("scenario", STANDING)
@pytest.mark.parametrize("controller", CONTROLLERS)
def test_every_controller_stands_for_five_seconds(controller, scenario):
    assert_stands_still(run(load_scenario(scenario), controller).summary, 5.0)


@pytest.mark.slow
@pytest.mark.parametrize("support", ["left", "right", "double"])
@pytest.mark.parametrize("controller", CONTROLLERS)
def test_every_controller_stands_for_a_minute(controller, support):
    changes = {"duration_s": 60.0, "support": support}
    assert_stands_still(run(load_scenario("stand_left", changes), controller).summary, 60.0)


@pytest.mark.parametrize("scenario", ["stone_outer_edge", "swing_inward"])
def test_the_baseline_falls_where_the_two_part_law_stands(scenario):
    loaded = load_scenario(scenario)
    baseline, two_part = (run(loaded, name).summary for name in ("optimization", "two-part"))
    assert baseline["fell"] is True
    assert baseline["qp_infeasible_ticks"] > 0
    assert two_part["fell"] is False
    assert two_part["duration_s"] == 5.0
    assert two_part["com_error_final_m"] < 0.1 * baseline["com_error_final_m"]


def test_a_swing_that_ends_out_of_range_warns_of_the_joint():
    changes = {"reference.amplitude_m": 0.045, "duration_s": 0.01}
    summary = run(load_scenario("swing_inward", changes), "two-part").summary
    assert any("end of the swing" in line and "_frontal at " in line for line in summary["warnings"])


def test_the_same_swing_inward_does_not_warn():
    setup = build_simulation(load_scenario("swing_inward"), "two-part", rows=1)
    assert setup.warnings == ()
