"""Springs in joints: the plant's as the file has them, and part of the model of controllers and checks."""

import mujoco
import numpy as np
import pytest

from surefoot.dynamics.model import DynamicsModel
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import RobotState
from surefoot.robot_import.describe import describe
from surefoot.robot_import.report import report
from tests.support.several_hinges import several_hinges

SPRING = 'stiffness="12" springref="0.3"'


def test_the_bias_is_that_of_mujoco_with_the_springs(inspect):
    """N q' + G + k (q - q0) of every joint, from the file as its owner wrote it; ``ref`` moves angle and rest alike."""
    robot = inspect(several_hinges(joint=f'{SPRING} ref="0.1"')).robot
    dynamics, random = DynamicsModel(describe(robot)), np.random.default_rng(2)
    q, original = np.zeros(7 + 16), mujoco.MjData(robot.original)
    q[6], q[7:] = 1.0, random.uniform(-1.0, 1.0, 16)
    original.qpos[:3], original.qpos[3:7], original.qpos[7:] = q[:3], (1.0, 0.0, 0.0, 0.0), q[7:] + 0.1
    mujoco.mj_forward(robot.original, original)
    wanted = original.qfrc_bias - original.qfrc_passive
    bias = dynamics.evaluate(RobotState(q, np.zeros(22))).bias
    assert np.allclose(bias, wanted, rtol=0.0, atol=1e-11)
    without = DynamicsModel(describe(inspect(several_hinges()).robot)).evaluate(RobotState(q, np.zeros(22))).bias
    assert np.allclose(bias - without, np.append(np.zeros(6), 12.0 * (q[7:] + 0.1 - 0.3)), rtol=0.0, atol=1e-11)


def test_it_stands_as_still_as_without_them_and_its_motors_hold_against_them(tmp_path):
    found = []
    for name, spring in (("without", ""), ("with", SPRING)):
        (tmp_path / f"{name}.xml").write_text(several_hinges(joint=spring))
        over = {"duration_s": 0.3, "robot": str(tmp_path / f"{name}.xml")}
        found.append(run(load_scenario("stand_left", over, robot_files=True), "two-part"))
        assert not found[-1].summary["fell"]
        assert found[-1].summary["com_error_max_m"] < 0.001
    without, sprung = (result.recorder.last(1)[0] for result in found)
    columns = found[0].recorder.columns
    for joint in ("left_knee", "right_hip_y", "shoulder_1"):
        torque, angle = columns.index(f"torque_{joint}_nm"), columns.index(f"angle_{joint}_rad")
        assert sprung[torque] - without[torque] == pytest.approx(12.0 * (sprung[angle] - 0.3), abs=0.05)


def test_standing_still_counts_them(inspect):
    """A spring that pulls the waist with 80 N m asks more of its motor of 60 N m than there is."""
    table = report(inspect(several_hinges(joint='stiffness="80" springref="1"'), "[posture]\nwaist_z = 0.0\n"))
    assert not table["fit"]
    assert any("of its limit" in problem["reason"] for problem in table["problems"])


def test_the_report_says_them(inspect):
    table = report(inspect(several_hinges(joint=SPRING)))
    assert table["fit"], table["problems"]
    assert table["known"] == [
        "springs in 16 joints, up to 12 N m/rad (left_hip_x); in the posture up to 8.4 N m (left_knee)"
    ]
    knee = next(joint for joint in table["joints"] if joint["name"] == "left_knee")
    assert (knee["spring_nm_rad"], knee["spring_rest_rad"]) == (12.0, 0.3)
    assert report(inspect(several_hinges()))["known"] == []
