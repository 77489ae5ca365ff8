"""The soft QP keeps to torque limits and joint ranges, on both sides, and gives up the motion for them."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.control.controllers.soft_qp import SoftQP
from surefoot.control.qp.solver import solve_qp
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import acceleration_response
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support

SLACK = {"torque": 1e-4, "acceleration": 1e-6}  # N m, rad/s2: the solver's 1e-9 body weights of 1e3 N, with a margin
HORIZON_S = 0.05


@pytest.fixture
def solve(on_its_feet):
    """Robot and terms in left stance -> torques (15,) and q'' (21,) of the soft QP that is asked to stay at rest."""

    def answer(robot, terms):
        controller = SoftQP(robot, ControllerSettings(guard=False))
        response = acceleration_response(terms, np.zeros(21))
        problem = controller.problem(terms, response, on_its_feet(terms, Support.LEFT)[0])
        solution = solve_qp(problem, "daqp")
        assert solution.x is not None
        return problem.interpret(solution.x)[:2]

    return answer


def weakened(robot, name: str, limit_nm: float):
    """The robot with one weak motor."""
    joints = tuple(replace(j, torque_limit_nm=limit_nm) if j.name == name else j for j in robot.joints)
    return replace(robot, joints=joints)


@pytest.mark.parametrize("name", ["left_knee", "left_hip_frontal", "left_hip_sagittal", "right_hip_frontal"])
def test_a_weak_motor_gives_what_it_has_and_no_more(robot, standing, solve, name):
    terms, joint = standing(Support.LEFT), robot.joint_named(name)
    needed = solve(robot, terms)[0][joint.dof - 6]
    assert abs(needed) > 5.0
    limit = 0.8 * abs(needed)
    given = solve(weakened(robot, name, limit), terms)[0][joint.dof - 6]
    assert given == pytest.approx(np.sign(needed) * limit, abs=SLACK["torque"])


def test_weak_motors_are_tried_on_both_sides(robot, standing, solve):
    """The test above is about upper and lower limits only if these torques have both signs."""
    torques = solve(robot, standing(Support.LEFT))[0]
    signs = {np.sign(torques[robot.joint_named(name).dof - 6]) for name in ("left_knee", "left_hip_frontal")}
    assert signs == {-1.0, 1.0}


@pytest.mark.parametrize("side", ["upper", "lower"])
@pytest.mark.parametrize("name", ["trunk_yaw", "right_hip_sagittal", "right_knee"])
def test_a_joint_that_runs_into_its_stop_is_braked(robot, dynamics, standing, solve, name, side):
    """2 mrad before the stop at 0.5 rad/s: q + q' T + q'' T^2/2 stays in range over T = 50 ms."""
    joint = robot.joint_named(name)
    stop, sign = (joint.upper_rad, 1.0) if side == "upper" else (joint.lower_rad, -1.0)
    at_rest = standing(Support.LEFT)
    q, v = at_rest.state.q.copy(), np.zeros(21)
    q[joint.dof + 1], v[joint.dof] = stop - sign * 0.002, sign * 0.5
    acceleration = solve(robot, dynamics.evaluate(RobotState(q, v)))[1][joint.dof]
    ahead = q[joint.dof + 1] + v[joint.dof] * HORIZON_S + 0.5 * acceleration * HORIZON_S**2
    assert sign * (ahead - stop) <= SLACK["acceleration"]
    assert sign * acceleration < -10.0


def test_a_joint_in_the_middle_of_its_range_is_left_alone(robot, dynamics, standing, solve):
    """No row for it: at rest the wanted q'' is zero, and zero it is."""
    terms = standing(Support.LEFT)
    _, acceleration = solve(robot, terms)
    assert np.abs(acceleration).max() < 0.01
