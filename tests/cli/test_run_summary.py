"""What ``surefoot run`` says of another robot: the sizes that were scaled for it, and figures with its own digits."""

import json
import re

import pytest

import surefoot
from surefoot.cli.main import main
from surefoot.experiments.scenario.changes import sizes_in_proportion
from surefoot.experiments.scenario.scenario import load_scenario
from tests.support.small_biped import write_small_robot

SHORT = ("--set", "duration_s=0.02")


@pytest.fixture
def small(tmp_path):
    write_small_robot(tmp_path)
    return str(tmp_path / "small" / "robot.toml")


def test_the_sizes_in_proportion_are_those_that_run(small):
    """Set in the scenario as it was written, with that robot, they change nothing."""
    for name in ("push_left", "stone_outer_edge", "swing_inward", "walk_tiles", "step_onto_stone"):
        changes = {"robot": small, "reference.start_s": 0.3}
        scenario = load_scenario(name, changes, robot_files=True)
        sizes = sizes_in_proportion(scenario, name, changes)
        assert sizes and not set(sizes) & set(changes)
        assert load_scenario(name, {**sizes, **changes}, robot_files=True) == scenario


def test_the_summary_says_them(small, capsys):
    main(["run", "push_left", "--robot", small, "--json", *SHORT])
    sizes = json.loads(capsys.readouterr().out)["in_proportion"]
    impulse = load_scenario("push_left", {"robot": small}, robot_files=True).pushes[0].impulse_ns
    assert sizes == {"pushes.0.impulse_ns": impulse}
    main(["run", "push_left", "--robot", small, *SHORT])
    said = " ".join(capsys.readouterr().out.split())
    assert f"in proportion to small: pushes.0.impulse_ns = {impulse}" in said
    peaks = re.findall(r"left_knee: ([\d.]+) \(\d+ %\)", said)
    assert len(peaks) == 1 and re.fullmatch(r"\d+\.\d", peaks[0])


def test_of_a_fall_the_figures_before_the_first_limit_come_first(capsys):
    changes = {"pushes.0.impulse_ns": 33.0, "pushes.0.start_s": 0.1, "duration_s": 3.0}
    main(["run", "push_left", *(text for path, value in changes.items() for text in ("--set", f"{path}={value}"))])
    said = " ".join(capsys.readouterr().out.split())
    assert re.search(r"least ZMP margin \d\.\d mm before the first limit, -?\d\.\d mm until the fall", said)
    assert re.search(r"CoM error at most \d\.\d mm before the first limit, \d{3}\.\d mm until the fall", said)
    main(["run", "stand_left", *SHORT])
    said = " ".join(capsys.readouterr().out.split())
    assert "least ZMP margin 74.1 mm CoM error" in said and "mm at most, " in said


def test_what_is_set_is_not_in_proportion(small):
    result = surefoot.run("push_left", robot=small, changes={"duration_s": 0.02, "pushes.0.impulse_ns": 1.0})
    assert "in_proportion" not in result.summary


def test_of_the_robot_that_it_was_written_for_nothing_is_said(capsys):
    main(["run", "push_left", "--robot", "bip", *SHORT])
    said = capsys.readouterr().out
    assert "in proportion" not in said
    peaks = re.search(r"peak torques (.*) N m \(of the limit\), and 10 more", " ".join(said.split()))
    assert peaks and re.fullmatch(r"(\d+: \d+ \(\d+ %\)(, )?){5}", peaks[1])


def test_of_the_peak_torques_those_nearest_to_their_limits_are_told(capsys):
    main(["run", "stand_left", "--json", *SHORT])
    all_peaks = json.loads(capsys.readouterr().out)["torque_peak_nm"]
    main(["run", "stand_left", *SHORT])
    said = " ".join(capsys.readouterr().out.split())
    limits = {joint.key: joint.torque_limit_nm for joint in load_scenario("stand_left").robot_description().joints}
    shares = {name: peak / limits[name] for name, peak in all_peaks.items()}
    worst = sorted(shares, key=lambda name: shares[name], reverse=True)[:5]
    assert len(all_peaks) == 15
    assert re.findall(r"(\d+): \d+ \((\d+) %\)", said) == [(name, f"{100 * shares[name]:.0f}") for name in worst]
