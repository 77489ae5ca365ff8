"""A posture is looked for where the one by rule does not do: torques by MuJoCo's statics, places by Pinocchio."""

import re

import numpy as np
import pytest

from surefoot.dynamics.model import DynamicsModel
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.feet import Support
from surefoot.robot_import.load import load_robot_file
from surefoot.robot_import.posture_search import COM_INSIDE, LEAN_RAD, RANGE_MARGIN, TORQUE_SHARE, StanceSearch
from surefoot.robot_import.report import report
from surefoot.robot_import.robot_file_text import robot_file_text
from surefoot.robot_import.statics import stand
from surefoot.task.posture import solve_posture, standing_reference
from tests.support.small_biped import bent, biped


def weak(hip_roll_nm: float) -> str:
    """The small biped, whose hips are as strong as said in roll."""
    text = biped()
    for side in ("left", "right"):
        motor = f'joint="{side}_hip_roll" ctrlrange='
        assert f'{motor}"-60 60"' in text
        text = text.replace(f'{motor}"-60 60"', f'{motor}"-{hip_roll_nm} {hip_roll_nm}"')
    return text


@pytest.fixture
def by_rule(inspect):
    """Torque of the hip's roll by rule, on one foot."""
    return abs(next(s for s in stand(inspect(weak(60.0)).robot) if s.support == "left foot").torque.amount)


def test_what_stands_by_rule_is_left_alone(inspect, tmp_path):
    inspect(biped())
    assert load_robot_file(tmp_path / "robot.xml").stances == {}


def test_a_hip_too_weak_by_rule_is_spared_by_leaning(inspect, by_rule, tmp_path):
    """MuJoCo's statics of the posture found, by a linear program over contact forces, have the share asked for."""
    found = inspect(weak(0.93 * by_rule))
    both, left, right = stand(found.robot)
    assert not both.is_found and left.is_found and right.is_found
    assert left.by_rule.worst.share == pytest.approx(1.0 / 0.93, abs=1e-3)
    for statics in (left, right):
        assert statics.torque.percent == pytest.approx(100.0 * TORQUE_SHARE, abs=0.5)
        assert statics.by_rule.worst.joint.endswith("hip_roll")
    table = report(found)
    assert table["fit"], table["problems"]
    assert [one["posture"] for one in table["statics"]] == ["by rule", "found", "found"]


def test_the_posture_found_keeps_its_margins(inspect, by_rule, tmp_path):
    inspect(weak(0.93 * by_rule))
    robot = load_robot_file(tmp_path / "robot.xml")
    assert set(robot.stances) == {Support.LEFT, Support.RIGHT}
    for support in robot.stances:
        reference = standing_reference(robot, support)
        q = solve_posture(DynamicsModel(robot), reference).q
        share = (q[7:] - robot.joint_lower) / (robot.joint_upper - robot.joint_lower)
        assert share.min() > RANGE_MARGIN - 1e-6 and share.max() < 1.0 - RANGE_MARGIN + 1e-6
        stance = support.reference_foot
        com = reference.position_com[:2] - reference.position_ankles[stance][:2]
        half_width = 0.035
        assert robot.feet[stance].sole.signed_margin(com) >= COM_INSIDE * half_width - 1e-6
        outward = 1.0 if stance == 0 else -1.0
        assert com[1] * outward > 0.001  # it leans over its foot, which is what spares the hip
        assert np.abs(reference.rotation_pelvis_to_world[:2, 2]).max() <= np.sin(LEAN_RAD) + 1e-6


def test_what_no_posture_spares_is_told_with_the_least_that_was_found(inspect, by_rule):
    found = inspect(weak(0.3 * by_rule))
    table = report(found)
    assert not table["fit"]
    left = table["statics"][1]
    assert left["posture"] == "by rule"
    assert left["torque"]["percent"] == pytest.approx(100.0 / 0.3, rel=1e-3)
    reason = next(problem["reason"] for problem in table["problems"] if problem["reason"].startswith("left foot"))
    said = re.search(r"left_hip_roll needs .* 333 % of its limit; the search .* came to (\d+) % of ", reason)
    assert said and 100 < int(said[1]) < 333, reason


def test_joints_that_a_person_has_placed_stay(inspect, by_rule, tmp_path):
    inspect(weak(0.93 * by_rule), "[posture]\nwaist = 0.1\nshoulder = -0.2\n")
    robot = load_robot_file(tmp_path / "robot.toml")
    assert robot.stances
    for stance in robot.stances.values():
        assert stance.upper_rad == pytest.approx((0.1, -0.2), abs=1e-9)


def test_it_stands_in_the_posture_found(inspect, by_rule, tmp_path):
    inspect(weak(0.93 * by_rule))
    changes = {"robot": str(tmp_path / "robot.xml"), "duration_s": 0.3}
    summary = run(load_scenario("stand_left", changes, robot_files=True), "two-part").summary
    assert not summary["fell"] and summary["com_error_max_m"] < 0.002
    assert not summary["warnings"]


def test_two_feet_too(inspect, tmp_path):
    """For knees that cannot hold the squat that was said, straighter ones are found, and written down."""
    squat = bent("robot.xml").replace("0.6", "1.6").replace("-0.3", "-0.8").split("\n", 1)[1]
    wide = biped(joint='range="-2 2" armature="0.01"')  # the squat lies inside
    strong = inspect(wide, squat)
    knee = next(s for s in stand(strong.robot) if s.support == "two feet").torque
    assert knee.joint.endswith("knee")
    limits = f"[torque_limits]\nleft_knee = {0.9 * abs(knee.amount)}\nright_knee = {0.9 * abs(knee.amount)}\n"
    weaker = inspect(wide, squat + limits)
    both = stand(weaker.robot)[0]
    assert both.is_found and both.torque.percent <= 100.0 * TORQUE_SHARE + 0.5
    text = robot_file_text(weaker, tmp_path / "new.toml")
    assert f'"left_knee" = {round(float(both.qpos[weaker.robot.model.joint("left_knee").qposadr[0]]), 5)}' in text


def test_on_one_foot_the_shares_are_those_of_the_ground_wrench(inspect, tmp_path):
    """For the joint that needs most, as MuJoCo's statics (a linear program over contact forces) have it."""
    inspect(biped())
    robot = load_robot_file(tmp_path / "robot.xml")
    dynamics, reference = DynamicsModel(robot), standing_reference(robot, Support.LEFT)
    q = solve_posture(dynamics, reference).q
    shares = StanceSearch(dynamics, reference, q, frozenset()).shares(np.zeros(robot.dofs))
    statics = stand(inspect(biped()).robot)[1]
    worst = [joint.name for joint in robot.joints].index(statics.torque.joint)
    assert 60.0 * shares[worst] == pytest.approx(statics.torque.amount, rel=1e-6)
