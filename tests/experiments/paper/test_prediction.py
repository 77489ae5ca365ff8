"""When the hard QP becomes infeasible is known from the reference alone."""

import pytest

from surefoot.experiments.paper.plan import PREDICTED, SWING, SWING_HARDER
from surefoot.experiments.paper.prediction import predict
from surefoot.experiments.runs.cases import Case, run_case
from surefoot.experiments.scenario.scenario import load_scenario

WITHIN_S = 0.010
AFTERWARDS_S = 0.05


@pytest.fixture(scope="module")
def predictions():
    return {scenario: predict(load_scenario(scenario)) for scenario in PREDICTED}


def test_at_least_five_swings_are_predicted():
    assert len(set(PREDICTED)) >= 5


@pytest.mark.parametrize("scenario", PREDICTED)
def test_first_infeasible_tick_is_within_10_ms_of_the_prediction(scenario, predictions):
    predicted = predictions[scenario].infeasible_s
    assert predicted is not None
    cut = (("duration_s", round(predicted + AFTERWARDS_S, 3)),)
    measured = run_case(Case(scenario, "optimization", cut), keep_ticks=False).summary["qp_infeasible_first_s"]
    assert measured is not None
    assert measured == pytest.approx(predicted, abs=WITHIN_S)


@pytest.mark.parametrize("scenario", [SWING, SWING_HARDER])
def test_calibrated_swings_become_infeasible_at_0_92_s(scenario, predictions):
    assert predictions[scenario].infeasible_s == pytest.approx(0.92, abs=0.005)


def test_a_point_mass_without_delta_about_g_predicts_the_calibrated_swings_too_late(predictions):
    for scenario in (SWING, SWING_HARDER):
        plan = predictions[scenario]
        assert plan.point_mass_infeasible_s > plan.infeasible_s + WITHIN_S


def test_every_edge_of_the_sole_is_met_by_some_swing(predictions):
    assert {plan.limit for plan in predictions.values()} == {"outer", "inner", "toe", "heel"}


def test_a_swing_that_stays_inside_is_predicted_feasible():
    plan = predict(load_scenario("ablation_swing_slow"))
    assert plan.infeasible_s is None
    assert plan.limit is None
    assert plan.margin.min() > 0.0


def test_without_a_swing_nothing_is_predicted():
    with pytest.raises(ValueError, match="swing"):
        predict(load_scenario("stand_left"))
