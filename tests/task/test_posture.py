"""Postures: joint angles that realise a wanted kappa, inside the joint ranges, or a refusal."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.errors import PostureError
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.task.posture import solve_posture, standing_reference
from surefoot.task.reference import task_error

ANKLE_HEIGHT_M = 0.083


def evaluate(dynamics, posture):
    return dynamics.evaluate(RobotState(posture.q, np.zeros(21)))


@pytest.mark.parametrize("support", Support)
@pytest.mark.parametrize("com_height", [None, 0.97, 0.98, 0.985])
def test_standing_posture_realises_its_reference_within_the_joint_ranges(dynamics, robot, support, com_height):
    reference = standing_reference(robot, support, com_height)
    posture = solve_posture(dynamics, reference)
    assert_allclose(task_error(evaluate(dynamics, posture), reference), 0.0, rtol=0, atol=1e-10)
    assert posture.out_of_range == ()
    joints = posture.q[7:]
    assert (joints > robot.joint_lower).all()
    assert (joints < robot.joint_upper).all()


def test_left_stance_is_the_posture_found_in_the_first_study(dynamics, robot):
    """Left hip frontal -0.105, knee 0.651, ankle frontal 0.155 and sagittal -0.354 rad."""
    posture = solve_posture(dynamics, standing_reference(robot, Support.LEFT))
    found = {j.name: round(float(posture.q[j.dof + 1]), 3) for j in robot.joints}
    expected = {
        "left_hip_frontal": -0.105, "left_knee": 0.651, "left_ankle_frontal": 0.155, "left_ankle_sagittal": -0.354,
    }  # fmt: skip
    assert {name: found[name] for name in expected} == expected


@pytest.mark.parametrize("support", Support)
def test_standing_soles_are_level_on_the_ground_and_the_swing_foot_is_lifted(dynamics, robot, support):
    terms = evaluate(dynamics, solve_posture(dynamics, standing_reference(robot, support)))
    for i, foot in enumerate(terms.feet):
        lift = 0.0 if i in support.stance else 0.04
        assert foot.position_ankle_in_world[2] == pytest.approx(ANKLE_HEIGHT_M + lift, abs=1e-9)
        assert_allclose(foot.rotation_foot_to_world, np.eye(3), rtol=0, atol=1e-9)
    assert terms.position_com_in_world[0] == pytest.approx(0.02, abs=1e-9)
    over = np.mean([terms.feet[i].position_ankle_in_world[1] for i in support.stance])
    assert terms.position_com_in_world[1] == pytest.approx(over, abs=1e-9)


def test_right_stance_is_the_mirror_image_of_the_left_one(robot):
    left, right = (standing_reference(robot, support) for support in (Support.LEFT, Support.RIGHT))
    assert_allclose(right.position_com, left.position_com * (1, -1, 1), rtol=0, atol=1e-15)
    for one, other in ((0, 1), (1, 0)):
        assert_allclose(right.position_ankles[other], left.position_ankles[one] * (1, -1, 1), rtol=0, atol=1e-15)
    flip = np.diag((1.0, -1.0, 1.0))
    assert_allclose(right.rotation_pelvis_to_world, flip @ left.rotation_pelvis_to_world @ flip, rtol=0, atol=1e-15)


@pytest.mark.parametrize("com_height", [1.1, 1.2])
@pytest.mark.parametrize("support", Support)
def test_a_posture_out_of_reach_is_refused_with_the_remaining_error(dynamics, robot, support, com_height):
    with pytest.raises(PostureError, match="no solution") as refusal:
        solve_posture(dynamics, standing_reference(robot, support, com_height))
    assert refusal.value.residual > 1e-3


def test_joints_out_of_range_are_named_with_their_angle_and_range(dynamics, robot):
    """An outward displacement of 45 mm in single support bends the ankle too far."""
    reference = standing_reference(robot, Support.LEFT)
    outward = replace(reference, position_com=reference.position_com + [0.0, 0.045, 0.0])
    lines = solve_posture(dynamics, outward).out_of_range
    assert lines
    assert all("rad, range" in line for line in lines)


def test_knees_bend_forward(dynamics, robot):
    for support in Support:
        posture = solve_posture(dynamics, standing_reference(robot, support))
        assert min(posture.q[robot.joint_named(f"{side}_knee").dof + 1] for side in ("left", "right")) > 0.11
