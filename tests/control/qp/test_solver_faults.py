"""A QP solver that raises, answers with garbage or takes its time: the robot stands on, and the ticks are counted."""

import time

import daqp
import numpy as np
import pytest

from surefoot.control.qp import solver
from surefoot.control.qp.contact_qp import MotionQP
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario

TICKS = 20


def raises(x, rest):
    raise RuntimeError("out of memory")


FAULTS = {  # what the solver does with its minimiser, and the rest of its answer
    "raises": raises,
    "nothing": lambda x, rest: None,
    "no vector": lambda x, rest: (None, *rest),
    "too short": lambda x, rest: (x[:-1], *rest),
    "a column": lambda x, rest: (x[:, None], *rest),
    "a NaN": lambda x, rest: (np.where(np.arange(len(x)) == 2, np.nan, x), *rest),
    "no forces": lambda x, rest: (np.zeros_like(x), *rest),
    "pulling at the ground": lambda x, rest: (-x, *rest),
    "no multipliers": lambda x, rest: (x, *rest[:-1], {}),
}


@pytest.fixture
def answer_with(monkeypatch):
    """Let DAQP be asked in every tick, and spoil what it answers."""
    solve = daqp.solve

    def put(spoil):
        def spoilt(*problem):
            x, *rest = solve(*problem)
            return spoil(x, rest)

        monkeypatch.setattr(MotionQP, "solve_in_closed_form", lambda self: None)
        monkeypatch.setattr(solver.daqp, "solve", spoilt)

    return put


def stand(controller="soft-qp", ticks=TICKS):
    return run(load_scenario("stand_left", {"duration_s": ticks * 1e-3}), controller)


@pytest.mark.parametrize("controller", ["soft-qp", "two-part"])
@pytest.mark.parametrize("spoil", FAULTS.values(), ids=FAULTS)
def test_the_robot_stands_on_its_fallback_and_the_ticks_are_counted(answer_with, spoil, controller):
    answer_with(spoil)
    result = stand(controller)
    assert (result.summary["fell"], result.summary["error"]) == (False, None)
    assert result.summary["fallback_ticks"] == result.summary["qp_infeasible_ticks"] == TICKS
    assert np.isfinite(result.recorder.column("torque_left_ankle_sagittal_nm")).all()
    assert result.summary["com_error_max_m"] < 1e-3


@pytest.mark.parametrize("spoil", [raises, lambda x, rest: (x[:-1], *rest)], ids=["raises", "too short"])
def test_the_baseline_holds_its_torques(answer_with, monkeypatch, spoil):
    monkeypatch.setattr(solver.QuadraticProgram, "solve_in_closed_form", lambda self: None)
    answer_with(spoil)
    summary = stand("optimization").summary
    assert (summary["error"], summary["qp_infeasible_ticks"]) == (None, TICKS)


@pytest.mark.parametrize("fault", ["raises", "garbage"])
def test_the_second_solver_is_not_trusted_either(monkeypatch, fault):
    solve = solver.clarabel_solve_problem

    def spoilt(problem):
        if fault == "raises":
            raise RuntimeError("out of memory")
        found = solve(problem)
        found.x = -found.x
        return found

    monkeypatch.setattr(solver, "clarabel_solve_problem", spoilt)
    scenario = load_scenario("stand_left", {"duration_s": 0.005, "controller.solver": "clarabel"})
    summary = run(scenario, "soft-qp").summary
    assert (summary["fell"], summary["fallback_ticks"]) == (False, 5)


def test_one_that_takes_50_ms_changes_no_bit(answer_with):
    def late(x, rest):
        time.sleep(0.05)
        return x, *rest

    answer_with(lambda x, rest: (x, *rest))
    in_time = stand(ticks=5)
    answer_with(late)
    slow = stand(ticks=5)
    assert slow.recorder.table().tobytes() == in_time.recorder.table().tobytes()
    assert slow.summary["fallback_ticks"] == 0
