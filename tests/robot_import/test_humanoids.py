"""Six humanoids of others, from the extra ``robots``: what a person of the field knows of them is what is reported."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.experiments.bench.criteria import judge
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.bounds import push_bound
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.robot.feet import Support
from surefoot.robot_import.inspection import inspect_robot
from surefoot.robot_import.report import report
from surefoot.simulation.external_forces import Push
from surefoot.simulation.stones import Stone
from tests.support.humanoids import path_of

pytestmark = pytest.mark.robots


def reported(name: str) -> dict:
    return report(inspect_robot(path_of(name)))


def outcome(scenario: Scenario) -> str:
    """As the bench judges it: ``stands`` is at rest in the last second, the other foot never loaded."""
    result = run(scenario, "two-part")
    table = dict(zip(result.recorder.columns, result.recorder.table().T, strict=True))
    error = [table[f"com_{axis}_m"] - table[f"com_ref_{axis}_m"] for axis in "xyz"]
    speed = [table[f"com_velocity_{axis}_mps"] for axis in "xyz"]
    return judge(
        fell=result.summary["fell"],
        time_s=table["time_s"],
        com_error_m=np.linalg.norm(error, axis=0),
        com_speed_mps=np.linalg.norm(speed, axis=0),
        swing_force_n=0.0 * table["time_s"] if scenario.support is Support.DOUBLE else table["force_right_n"],
    ).outcome


def scenario_of(name: str, support: Support, seconds: float, **more) -> Scenario:
    return Scenario(robot=str(path_of(name)), support=support, duration_s=seconds, **more)


@pytest.mark.parametrize(
    # joints, kg, upper joints, sole length and width mm, axes' gap mm, order, ankle pitch limit N m
    ("name", "joints", "mass", "upper", "length", "width", "gap", "order", "ankle"),
    [
        ("g1", 29, 33.3, 17, 170, 60, 17.6, "pitch, roll", 50),
        ("t1", 23, 31.6, 11, 223, 100, 12.0, "pitch, roll", 20),
        ("apollo", 32, 80.9, 20, 204, 94, 0.0, "roll, pitch", 150),
        ("berkeley", 12, 16.1, 0, 160, 55, 0.0, "pitch, roll", 20),
        ("op3", 20, 3.1, 8, 127, 78, 0.0, "pitch, roll", 5),
    ],
)
def test_a_humanoid_is_found_as_it_is(name, joints, mass, upper, length, width, gap, order, ankle):
    table = reported(name)
    assert (table["joint_count"], len(table["upper_joints"])) == (joints, upper)
    assert table["mass_kg"] == pytest.approx(mass, abs=0.06)
    assert table["agreement"]["mass_matrix_difference"] < 1e-9
    assert table["agreement"]["com_difference_m"] < 1e-12
    limits = {joint["name"]: joint["torque_limit_nm"] for joint in table["joints"]}
    for foot in table["feet"].values():
        assert 1e3 * foot["sole"]["length_m"] == pytest.approx(length, abs=1.0)
        assert 1e3 * foot["sole"]["width_m"] == pytest.approx(width, abs=1.0)
        assert 1e3 * foot["ankle"]["axes_gap_m"] == pytest.approx(gap, abs=0.05)
        assert foot["ankle"]["order"] == order
        assert limits[foot["ankle"]["pitch"]] == ankle


@pytest.mark.parametrize("name", ["g1", "apollo", "berkeley", "op3"])
def test_it_is_fit(name):
    table = reported(name)
    assert table["fit"], table["problems"]
    assert all(statics["torque"]["percent"] < 60.0 for statics in table["statics"])


def test_h1_has_five_joint_legs():
    table = reported("h1")
    assert not table["fit"]
    assert [problem["topic"] for problem in table["problems"]] == ["legs"]
    assert "five-joint legs" in table["problems"][0]["reason"]


def test_t1_has_hips_too_weak_for_one_foot_by_rule_and_a_posture_is_found():
    """On two feet nothing asks more than 10 %."""
    table = reported("t1")
    assert table["fit"], table["problems"]
    both, left, right = table["statics"]
    assert both["posture"] == "by rule" and both["torque"]["percent"] < 10.0
    for statics, name in ((left, "Left_Hip_Roll"), (right, "Right_Hip_Roll")):
        assert statics["posture"] == "found"
        assert statics["by_rule"] == f"by rule {name} needs 110 %"
        assert (statics["torque"]["joint"], statics["torque"]["percent"]) == (name, pytest.approx(90.0, abs=0.1))


@pytest.mark.parametrize("support", [Support.LEFT, Support.DOUBLE])
@pytest.mark.parametrize("name", ["g1", "apollo", "berkeley", "op3", "t1"])
def test_it_stands(name, support):
    assert outcome(scenario_of(name, support, 2.0)) == "stands"


@pytest.mark.parametrize("direction", [0.0, 90.0, 180.0, 270.0])
def test_g1_on_one_foot_settles_nine_tenths_of_the_push_that_the_capture_bound_allows(direction):
    push = Push(link="com", direction_deg=direction, impulse_ns=1.0, start_s=0.5, duration_s=0.1)
    pushed = scenario_of("g1", Support.LEFT, 5.0, pushes=(push,))
    strong = replace(push, impulse_ns=0.9 * push_bound(pushed).impulse_ns)
    assert outcome(replace(pushed, pushes=(strong,))) == "stands"


@pytest.mark.parametrize(("x_m", "y_m", "height_m"), [(0.035, 0.0225, 0.005), (0.11, 0.0, 0.01)])
def test_g1_settles_over_a_stone_at_the_outer_edge_and_at_the_toe(x_m, y_m, height_m):
    stone = Stone(x_m=x_m, y_m=y_m, height_m=height_m, size_m=(0.04, 0.02), rise_start_s=0.5, rise_duration_s=0.3)
    assert outcome(scenario_of("g1", Support.LEFT, 5.0, stones=(stone,))) == "stands"


@pytest.mark.parametrize("controller", ["two-part", "soft-qp"])
def test_g1_walks_with_the_steps_of_a_scenario_that_was_written_for_bip(controller):
    changes = {"robot": str(path_of("g1")), "reference.steps": 4, "duration_s": 6.0}
    summary = run(load_scenario("walk_flat", changes, robot_files=True), controller).summary
    assert not summary["fell"], summary
    assert summary["steps_made"] == 4
