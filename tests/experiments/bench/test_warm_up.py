"""A robot that does not know everything stands first; it has to come back to where it stood, not to where it wants."""

import dataclasses

import numpy as np
import pytest

from surefoot.experiments.bench.belief_table import beliefs_told
from surefoot.experiments.bench.beliefs import beliefs
from surefoot.experiments.bench.bench import BenchRequest, plan_bench
from surefoot.experiments.bench.cell_runner import run_cell
from surefoot.experiments.bench.criteria import COM_ERROR_M, STOOD_S, WARM_UP_S, stood_off
from surefoot.experiments.bench.families import cases
from surefoot.experiments.bench.warm_up import warmed_up
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.experiments.scenario.timing import first_onset

ESTIMATED = "two-part,two-part+motors.bandwidth_hz=40,two-part+estimator.kind=anchor,two-part+model_error.mass=0.02"


@pytest.mark.parametrize("family", ["push", "stone", "swing", "tilt", "stone-push"])
def test_all_that_happens_is_later_and_nothing_else_differs(family):
    case = cases((family,), quick=True)[0]
    level = case.levels[0]
    before, after = (scenario_from_table(one.table_at(level)) for one in (case, warmed_up(case)))
    assert first_onset(after) == pytest.approx(first_onset(before) + WARM_UP_S)
    assert after.duration_s == pytest.approx(before.duration_s + WARM_UP_S)
    back = {"duration_s": before.duration_s, "pushes": before.pushes, "stones": before.stones, "ground": before.ground}
    assert dataclasses.replace(after, **back, reference=before.reference) == before
    for mine, theirs in zip(after.pushes, before.pushes, strict=True):
        assert mine.start_s == pytest.approx(theirs.start_s + WARM_UP_S)
        assert dataclasses.replace(mine, start_s=theirs.start_s) == theirs


@pytest.mark.parametrize("family", ["landing", "slope", "stand"])
def test_what_is_there_from_the_start_stays_as_it_is(family):
    case = cases((family,), quick=True)[0]
    assert warmed_up(case) is case and first_onset(scenario_from_table(case.table_at(case.levels[0]))) is None


def test_only_who_does_not_know_everything_stands_first():
    bench = plan_bench(BenchRequest(controllers=ESTIMATED, families=("push-double",), quick=True))
    starts = {cell.label: cell.case.table["pushes"][0]["start_s"] for cell in bench.cells}
    knows, slow, estimates, heavier = starts.values()
    assert knows == slow and estimates == heavier == pytest.approx(knows + WARM_UP_S)
    assert f"in the {STOOD_S:g} s before" in str(bench.manifest()["survived"])
    alone = plan_bench(BenchRequest(controllers="two-part", families=("push-double",), quick=True))
    assert "before the disturbance" not in str(alone.manifest()["survived"])


def test_where_it_stood_is_the_mean_before_the_disturbance():
    time_s = np.arange(4000) * 1e-3
    off = np.where((time_s < 2.0)[:, None], (0.001, -0.002, 0.008), (0.5, 0.5, 0.5))
    off[time_s < 1.4] = 9.0
    assert stood_off(time_s, off, 2.0) == pytest.approx((0.001, -0.002, 0.008))
    assert stood_off(time_s, off, None) is None and stood_off(time_s, off, 0.5 * STOOD_S) is None


def test_a_robot_that_is_lighter_than_it_knows_survives_where_it_stands():
    controllers = "two-part+model_error.mass=0.2+model_error.seed=2"
    bench = plan_bench(BenchRequest(controllers=controllers, families=("push-double",), levels=(0.3,)))
    cell = bench.cells[0]
    (row,) = run_cell(cell)
    scenario = cell.scenario_at(0.3)
    simulation = build_simulation(scenario, "two-part", rows=6000).simulation
    for _ in range(round(1e3 * first_onset(scenario))):
        simulation.tick()
    recorder = simulation.recorder
    off = np.stack([recorder.column(f"com_{a}_m") - recorder.column(f"com_ref_{a}_m") for a in "xyz"], axis=1)
    assert row["stood_off_m"] == pytest.approx(np.linalg.norm(off[-round(1e3 * STOOD_S) :].mean(axis=0)), abs=1e-5)
    assert row["stood_off_m"] > COM_ERROR_M > 3.0 * row["com_error_m"] and row["outcome"] == "stands"


def test_a_bench_tells_what_was_believed_of_those_that_survived():
    row = {"family": "stand", "case": "two feet", "controller": "c", "level": 10.0, "unit": "s", "survived": True}
    rows = [
        {**row, "dcm_error_p99_mm": 3.0 + seed, "tilt_error_p99_deg": 0.1, "com_error_m": 0.002, "seed": seed}
        for seed in range(3)
    ]
    rows[0]["stood_off_m"] = 0.004
    rows.append({**rows[0], "survived": False, "dcm_error_p99_mm": 99.0})
    (told,) = beliefs(rows)
    assert (told.survived, told.seeds) == (3, 4)
    assert (told.dcm_mm.low, told.dcm_mm.median, told.dcm_mm.high) == (3.0, 4.0, 5.0)
    assert (told.com_mm.low, told.com_mm.high) == pytest.approx((2.0, 4.0))
    text = "\n".join(beliefs_told([dataclasses.asdict(told)]))
    assert "| stand | two feet | c | 10 s | 3/4 | 4.0 (3.0 to 5.0) | 0.100 | 2.0 (2.0 to 4.0) |" in text
    assert beliefs([row | {"com_error_m": 0.0}]) == [] and beliefs_told([]) == []
