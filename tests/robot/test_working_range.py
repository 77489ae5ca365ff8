"""The controllers keep joints in their ranges and knees bent; a robot whose ranges do that already keeps its own."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.control.balance.support import support_geometry
from surefoot.control.controllers.soft_qp import SoftQP
from surefoot.control.qp.solver import solve_qp
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import acceleration_response
from surefoot.dynamics.model import DynamicsModel
from surefoot.robot.description import RobotState, load_robot
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FULLY_LOADED
from surefoot.robot.working_range import working_range
from surefoot.task.posture import solve_posture, standing_reference

HORIZON_S = 0.05  # of the QP's rows
LEFT, RIGHT = "left_knee", "right_knee"  # the right one's axis points the other way


@pytest.fixture(scope="module")
def robot():
    return load_robot("offset")


def ends_of(robot) -> dict[str, tuple[float, float]]:
    lower, upper = working_range(robot)
    return {joint.name: (lower[i], upper[i]) for i, joint in enumerate(robot.joints)}


def test_bips_are_its_joint_ranges_to_the_bit():
    bip = load_robot("bip")
    lower, upper = working_range(bip)
    assert lower.tobytes() == bip.joint_lower.tobytes()
    assert upper.tobytes() == bip.joint_upper.tobytes()


def test_only_knees_lose_the_last_of_their_range_by_any_sign(robot):
    own = {joint.name: (joint.lower_rad, joint.upper_rad) for joint in robot.joints}
    assert (own[LEFT], own[RIGHT]) == ((0.05, 2.0), (-2.0, -0.05))
    assert ends_of(robot) == own | {LEFT: (0.1, 2.0), RIGHT: (-2.0, -0.1)}


def test_who_stands_nearly_straight_keeps_half_of_the_bend(robot):
    straight = replace(robot, posture_rad={LEFT: 0.14, RIGHT: -0.18})
    assert ends_of(straight)[LEFT] == (0.07, 2.0)
    assert ends_of(straight)[RIGHT] == (-2.0, -0.09)


def test_a_bent_hip_is_no_knee(robot):
    hips = [joint.name for joint in robot.joints if joint.dof in (foot.leg[2] for foot in robot.feet)]
    bowing = replace(robot, posture_rad={hip: 0.4 for hip in hips})
    assert ends_of(bowing) == {joint.name: (joint.lower_rad, joint.upper_rad) for joint in robot.joints}


def test_before_a_leg_is_straight_the_com_sinks(robot):
    """G goes forward and up on two feet at knees of 0.25 rad: the QP keeps their bend, and lets G's height give way."""
    dynamics = DynamicsModel(robot)
    knees = [dof for dof, _ in robot.knees]
    signs = np.array([sign for _, sign in robot.knees])
    reference = standing_reference(robot, Support.DOUBLE)
    heights = reference.position_com[2] + np.arange(0.0, 0.1, 0.004)
    postures = (solve_posture(dynamics, standing_reference(robot, Support.DOUBLE, z)).q for z in heights.tolist())
    q = next(q for q in postures if (signs * q[[dof + 1 for dof in knees]]).max() < 0.27)
    still = dynamics.evaluate(RobotState(q, np.zeros(robot.dofs)))
    rate = np.zeros(robot.dofs)
    rate[[0, 2]] = 0.1, 0.1  # G's velocity [m/s]
    terms = dynamics.evaluate(RobotState(q, np.linalg.solve(still.output_jacobian, rate)))
    support = support_geometry(robot, terms, Support.DOUBLE, FULLY_LOADED)
    response = acceleration_response(terms, np.zeros(robot.dofs))
    bends, vertical = [], []
    for ranges in (True, False):
        problem = SoftQP(robot, ControllerSettings(guard=False, joint_ranges=ranges)).problem(terms, response, support)
        acceleration = problem.interpret(solve_qp(problem, "daqp").x)[1]
        ahead = [q[dof + 1] + HORIZON_S * terms.state.v[dof] + 0.5 * HORIZON_S**2 * acceleration[dof] for dof in knees]
        bends.append(signs * np.array(ahead))
        momentum_rate = terms.centroidal_map[2] @ acceleration + terms.centroidal_drift[2]
        vertical.append(float(momentum_rate) / terms.mass_kg)
    kept, free = bends
    assert free.max() < 0.1
    assert kept == pytest.approx(0.1, abs=1e-6)
    assert vertical[0] < -0.1
    assert vertical[1] == pytest.approx(0.0, abs=1e-3)
