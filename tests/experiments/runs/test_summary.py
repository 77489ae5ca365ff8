"""The contract of ``surefoot run --json``: exactly the promised keys, the same figures each time, files to read."""

import csv
import json
import math

import numpy as np
import pytest

from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.simulation.falls import FALL_CAUSES, LIMITS

PROMISED = {
    "scenario", "controller", "fell", "fall_time_s", "fall_cause", "error", "first_limit", "first_limit_time_s",
    "duration_s", "zmp_margin_min_m", "com_error_max_m", "com_error_final_m", "qp_infeasible_ticks",
    "qp_infeasible_first_s", "fallback_ticks", "torque_peak_nm", "warnings", "tick_us_median", "tick_us_p99",
    "real_time_factor", "git_commit", "versions",
}  # fmt: skip
TIMING = {"tick_us_median", "tick_us_p99", "real_time_factor"}
SHORT = ("--set", "duration_s=0.4", "--set", "stones.0.rise_start_s=0.05")


@pytest.fixture(scope="module")
def printed(surefoot) -> list[dict]:
    """The JSON objects of two runs of one command."""
    objects = []
    for _ in range(2):
        done = surefoot("run", "stone_outer_edge", "--controller", "optimization", "--json", *SHORT)
        assert done.returncode == 0
        assert done.stderr == ""
        objects.append(json.loads(done.stdout))
    return objects


def test_json_has_exactly_the_promised_keys(printed):
    assert set(printed[0]) == PROMISED


def test_values_are_of_the_promised_kinds(printed):
    summary = printed[0]
    assert summary["scenario"] == "stone_outer_edge"
    assert summary["controller"] == "optimization"
    assert summary["fell"] is False
    assert summary["fall_time_s"] is None
    assert summary["fall_cause"] is None
    assert summary["error"] is None
    assert summary["duration_s"] == 0.4
    assert list(summary["torque_peak_nm"]) == [str(number) for number in range(1, 16)]
    assert all(isinstance(peak, float) and peak >= 0.0 for peak in summary["torque_peak_nm"].values())
    for key in ("zmp_margin_min_m", "com_error_max_m", "com_error_final_m", *TIMING):
        assert isinstance(summary[key], float)
        assert math.isfinite(summary[key])
    for key in ("qp_infeasible_ticks", "fallback_ticks"):
        assert isinstance(summary[key], int)
    assert summary["warnings"] == []
    assert summary["git_commit"] is None or len(summary["git_commit"].removesuffix("+dirty")) == 40
    assert {"python", "surefoot", "mujoco", "pin", "numpy"} <= set(summary["versions"])


def test_a_repeated_run_gives_the_same_figures_but_for_the_timing(printed):
    first, second = ({key: value for key, value in one.items() if key not in TIMING} for one in printed)
    assert first == second


def test_the_figures_of_a_fall_are_consistent():
    summary = run(load_scenario("swing_inward"), "optimization").summary
    assert summary["fell"] is True
    assert summary["fall_cause"] in FALL_CAUSES
    assert summary["first_limit"] in LIMITS
    assert 0.2 < summary["first_limit_time_s"] <= summary["fall_time_s"] <= summary["duration_s"] < 5.0
    assert summary["duration_s"] - summary["fall_time_s"] < 0.002  # the run ends with the fall
    assert summary["qp_infeasible_ticks"] > 0
    assert 0.2 < summary["qp_infeasible_first_s"] <= summary["fall_time_s"]
    assert summary["com_error_max_m"] >= summary["com_error_final_m"] > 0.005
    assert summary["zmp_margin_min_m"] < 0.005
    assert summary["tick_us_median"] is None  # no clock was handed in


@pytest.mark.parametrize(
    ("name", "changes", "began"),
    [
        ("push_left", {"pushes.0.impulse_ns": 33.0, "pushes.0.start_s": 0.1}, "first_limit_time_s"),
        ("walk_flat", {"pushes.0.impulse_ns": 150.0, "pushes.0.start_s": 1.0}, "fall_first_cause_time_s"),
    ],
)
def test_of_a_fall_the_figures_before_it_began_are_told_too(name, changes, began):
    result = run(load_scenario(name, {"duration_s": 4.0, **changes}), "two-part")
    record, summary = result.recorder, result.summary
    assert summary["fell"] and 0.1 < summary[began] < summary["fall_time_s"]
    before = record.column("time_s") < summary[began] - 5e-4
    error = [record.column(f"com_{a}_m") - record.column(f"com_ref_{a}_m") for a in "xyz"]
    distance = np.linalg.norm(error, axis=0)[before]
    assert summary["zmp_margin_min_before_limit_m"] == record.column("zmp_margin_m")[before].min()
    assert summary["com_error_max_before_limit_m"] == pytest.approx(distance.max(), abs=1e-12)
    assert summary["com_error_max_before_limit_m"] < 0.5 * summary["com_error_max_m"]


def test_figures_are_those_of_the_record():
    changes = {"duration_s": 0.5, "pushes.0.start_s": 0.1}
    result = run(load_scenario("push_left", changes), "two-part")
    record, summary = result.recorder, result.summary
    assert len(record) == 500
    error = np.stack([record.column(f"com_{a}_m") - record.column(f"com_ref_{a}_m") for a in "xyz"])
    distance = np.linalg.norm(error, axis=0)
    assert summary["com_error_max_m"] == pytest.approx(distance.max(), abs=1e-12)
    assert summary["com_error_final_m"] == pytest.approx(distance[-1], abs=1e-12)
    assert summary["zmp_margin_min_m"] == record.column("zmp_margin_m").min()
    peak = np.abs(record.column("torque_left_ankle_frontal_nm")).max()
    assert summary["torque_peak_nm"]["5"] == pytest.approx(peak, abs=1e-12)  # the paper's number 5


def test_the_tick_that_finds_the_robot_fallen_is_counted():
    """Crouched so low that it is a fall at once: that tick is the whole run, and no QP had a solution in it."""
    scenario = load_scenario("stand_double", {"com_height_m": 0.5})
    result = run(scenario, "two-part")
    record, summary = result.recorder, result.summary
    assert (summary["fell"], summary["first_limit"], len(record)) == (True, "qp_infeasible", 1)
    assert summary["qp_infeasible_ticks"] == summary["fallback_ticks"] == 1
    assert summary["qp_infeasible_first_s"] == summary["first_limit_time_s"] == 0.0
    assert summary["zmp_margin_min_m"] == record.column("zmp_margin_m")[0]
    assert summary["zmp_margin_min_before_limit_m"] is summary["com_error_max_before_limit_m"] is None
    error = [record.column(f"com_{a}_m")[0] - record.column(f"com_ref_{a}_m")[0] for a in "xyz"]
    assert summary["com_error_max_m"] == pytest.approx(np.linalg.norm(error), abs=1e-12)
    peaks = [abs(record.column(name)[0]) for name in record.columns if name.startswith("torque_")]
    assert sorted(summary["torque_peak_nm"].values()) == pytest.approx(sorted(peaks), abs=1e-12)


def test_fallback_ticks_are_counted():
    """Unlimited and in a hurry: no contact forces give the ankle torques, so that the QP fails and is reported."""
    changes = {
        "duration_s": 0.5, "reference.start_s": 0.05, "reference.amplitude_m": -0.06, "reference.duration_s": 0.3,
        "controller.saturation": "none", "controller.guard": False, "controller.roll_gate": False,
    }  # fmt: skip
    summary = run(load_scenario("swing_inward", changes), "two-part").summary
    assert summary["fallback_ticks"] > 0
    assert summary["qp_infeasible_ticks"] >= summary["fallback_ticks"]
    assert summary["first_limit"] is not None


def test_output_files_can_be_read(surefoot, tmp_path):
    paths = {kind: tmp_path / f"result.{kind}" for kind in ("json", "csv", "npz")}
    for path in paths.values():
        done = surefoot("run", "stand_left", "--set", "duration_s=0.05", "--json", "--out", path)
        assert done.returncode == 0, done.stderr
        on_screen = json.loads(done.stdout)
    assert set(json.loads(paths["json"].read_text())) == PROMISED
    with paths["csv"].open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 50
    assert float(rows[-1]["time_s"]) == pytest.approx(0.049)
    assert float(rows[0]["com_x_m"]) == pytest.approx(0.02, abs=1e-3)
    with np.load(paths["npz"]) as archive:
        columns, table = archive["columns"].tolist(), archive["table"]
        assert json.loads(str(archive["summary"]))["com_error_max_m"] == on_screen["com_error_max_m"]
    assert list(rows[0]) == columns
    assert table.shape == (50, len(columns))
    assert table[-1, columns.index("com_z_m")] == pytest.approx(float(rows[-1]["com_z_m"]), rel=1e-8)


def test_summary_for_a_person_says_whether_it_stands(surefoot):
    done = surefoot("run", "stand_double", "--set", "duration_s=0.05")
    assert done.returncode == 0
    assert "stand_double under two-part: stands after 0.050 s" in done.stdout


def test_a_fall_is_a_completed_run(surefoot):
    """Exit code 0: the run did what it was asked to do."""
    done = surefoot(
        "run", "swing_inward", "--controller", "optimization", "--set", "controller.latched=true",
        "--set", "reference.amplitude_m=-0.05", "--set", "reference.duration_s=0.35", "--set", "duration_s=2.0",
    )  # fmt: skip
    assert done.returncode == 0
    assert "under optimization: fell at" in done.stdout
