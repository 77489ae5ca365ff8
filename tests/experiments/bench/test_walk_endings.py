"""What ended a walk that failed, and whether an ankle was at its stop before."""

import dataclasses
import math

import numpy as np
import pytest

from surefoot.experiments.bench.ankle_stop import AnkleStopTally
from surefoot.experiments.bench.share_table import walks_ended
from surefoot.experiments.bench.shares import endings
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.simulation.falls import RANGE_SLACK_RAD


def test_an_ankle_at_its_stop_is_counted_as_the_recorded_angles_have_it():
    """A stone of 16 mm below the outer edge turns the frontal ankle into its stop."""
    stone = {"x_m": 0.05, "y_m": 0.07, "height_m": 0.016, "size_m": [0.06, 0.06]}
    scenario = scenario_from_table(
        {
            "robot": "bip",
            "support": "left",
            "duration_s": 1.2,
            "stones": [{**stone, "rise_start_s": 0.3, "rise_duration_s": 0.3}],
        }
    )
    simulation = build_simulation(scenario, "two-part", rows=scenario.ticks).simulation
    tally, robot = AnkleStopTally(simulation.robot), simulation.robot
    for _ in range(scenario.ticks):
        result = simulation.tick()
        assert result.terms is not None
        tally.add(result.terms, result.balance)
    table, columns = simulation.recorder.table(), simulation.recorder.columns
    outside = np.zeros(len(table), dtype=bool)
    for joint in ("left_ankle_sagittal", "left_ankle_frontal"):
        angle, at = table[:, columns.index(f"angle_{joint}_rad")], robot.joint_named(joint)
        outside |= (angle < at.lower_rad - RANGE_SLACK_RAD) | (angle > at.upper_rad + RANGE_SLACK_RAD)
    times = table[outside, columns.index("time_s")]
    assert 0.05 < tally.time_s == pytest.approx(1e-3 * len(times))
    assert times[0] > 0.3
    assert tally.before(times[0] + 0.05) == pytest.approx(1e-3 * np.sum(times <= times[0] + 0.05))
    assert tally.before(times[0] - 0.01) == 0.0


def test_what_ended_the_failed_runs_is_named_with_the_ankle_stop():
    row = {"family": "walk-stones", "case": "a", "controller": "c", "unit": "m", "seed": 0, "level": 0.02}
    fell = {**row, "survived": False, "outcome": "falls", "fall_cause": "pelvis_low"}
    rows = [
        {**row, "survived": True, "outcome": "stands", "fall_cause": "", "first_cause": ""},
        {**fell, "first_cause": "trip", "ankle_stop_before_s": 0.2},
        {**fell, "first_cause": "trip", "ankle_stop_before_s": 0.004},  # shorter than what counts as a limit
        {**fell, "first_cause": "", "ankle_stop_before_s": math.nan},
    ]
    (found,) = endings(rows)
    assert (found.runs, found.ended, found.ankle_stop) == (4, {"trip": 2, "pelvis_low": 1}, 1)
    text = "\n".join(walks_ended([dataclasses.asdict(found)]))
    assert "| walk-stones | c | 4 | 3 | trip 2, pelvis_low 1 | 1 of 3 |" in text
    assert endings([{**row, "family": "stone"} for row in rows]) == []
    assert walks_ended([]) == []
