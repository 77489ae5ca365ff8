"""The calibrated swing: what the paper's Figures 5 to 8 show, on this robot."""

import numpy as np
import pytest

from surefoot.experiments.paper.findings import FRONTAL, SAGITTAL, torque_spread_after
from surefoot.experiments.paper.plan import LATCHED, SWING
from surefoot.experiments.runs.cases import Case, run_case


@pytest.fixture(scope="module")
def latched():
    return run_case(Case(SWING, "optimization", LATCHED), keep_ticks=True)


@pytest.fixture(scope="module")
def two_part():
    return run_case(Case(SWING, "two-part"), keep_ticks=True)


def test_latched_torques_of_the_ankle_are_constant_after_infeasibility(latched):
    since = latched.summary["qp_infeasible_first_s"]
    assert since == pytest.approx(0.92, abs=0.01)
    assert torque_spread_after(latched, since) == 0.0


def test_they_were_not_constant_before(latched):
    early = latched.column("time_s") < latched.summary["qp_infeasible_first_s"]
    for name in (FRONTAL, SAGITTAL):
        assert np.ptp(latched.column(name)[early]) > 0.5


def test_latched_baseline_falls(latched):
    assert latched.fell


def test_two_part_stands_with_its_measured_zmp_inside_the_sole(two_part):
    assert not two_part.fell
    assert two_part.summary["zmp_margin_min_m"] > 0.0
    assert two_part.summary["qp_infeasible_ticks"] == two_part.summary["fallback_ticks"] == 0
    assert two_part.summary["com_error_final_m"] < 1e-3
