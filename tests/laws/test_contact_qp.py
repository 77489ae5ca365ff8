"""Law of (17): solutions of the contact QPs are optimal, keep to the cones, and do not depend on the solver."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.controllers.soft_qp import SoftQP
from surefoot.control.qp.contact_qp import contact_model, force_qp
from surefoot.control.qp.solver import solve_qp
from surefoot.control.registry import controller_named
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import acceleration_response
from surefoot.dynamics.terms import FOOT_ROWS
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.task.posture import standing_reference

FRICTION = 0.6
SOLVER = {"daqp": 1e-7, "clarabel": 1e-6}  # what each promises for residuals, times the objective's largest weight
CASES = [(support, seed) for support in Support for seed in range(4)]


@pytest.fixture(params=CASES, ids=lambda case: f"{case[0]}-{case[1]}")
def disturbed(request, dynamics, standing, on_its_feet):
    """Terms near a standing posture, moving, the support, and q'' of a random command that no foot obeys fully."""
    support, seed = request.param
    rng = np.random.default_rng(4000 + seed)
    q = dynamics.integrate(standing(support).state.q, 0.02 * rng.normal(size=21))
    terms = dynamics.evaluate(RobotState(q, 0.3 * rng.normal(size=21)))
    response = acceleration_response(terms, 3.0 * rng.normal(size=21))
    return terms, on_its_feet(terms, support)[0], response


@pytest.fixture
def soft_problem(robot, disturbed):
    terms, support, response = disturbed
    controller = SoftQP(robot, ControllerSettings(guard=False, assumed_friction=FRICTION))
    return controller.problem(terms, response, support)


def own_residuals(qp, solution):
    """Stationarity, feasibility and complementarity of the KKT conditions, from the problem and the multipliers."""
    x, z, y = solution.x, solution.raw.z, solution.raw.y
    stationarity = qp.P @ x + qp.q + qp.G.T @ z + qp.A.T @ y
    infeasibility = np.r_[np.maximum(qp.G @ x - qp.h, 0.0), np.abs(qp.A @ x - qp.b)]
    complementarity = np.r_[z * (qp.G @ x - qp.h), np.minimum(z, 0.0)]
    return [np.abs(part).max() for part in (stationarity, infeasibility, complementarity)]


@pytest.mark.parametrize("solver", SOLVER)
def test_soft_solution_satisfies_the_optimality_conditions(soft_problem, solver):
    solution = solve_qp(soft_problem.qp, solver)
    assert solution.x is not None
    primal, *dual_and_gap = solution.residuals()
    stationarity, infeasibility, complementarity = own_residuals(soft_problem.qp, solution)
    for residual in (primal, infeasibility):  # of the rows, which no weight scales
        assert residual <= SOLVER[solver]
    for residual in (*dual_and_gap, stationarity, complementarity):
        assert residual <= SOLVER[solver] * soft_problem.qp.P.max()


@pytest.mark.parametrize("solver", SOLVER)
def test_hard_solution_satisfies_the_optimality_conditions(robot, standing, on_its_feet, solver):
    for support in Support:
        terms = standing(support)
        command = np.r_[0.3, 0.2, 0.1, np.zeros(18)]
        contacts = contact_model(robot, terms, on_its_feet(terms, support)[0], corner_scale=1.0, friction=FRICTION)
        qp = force_qp(terms, acceleration_response(terms, command).acceleration, contacts)
        solution = solve_qp(qp, solver)
        assert solution.x is not None
        for residual in (*solution.residuals(), *own_residuals(qp, solution)):
            assert residual <= SOLVER[solver]


def test_forces_never_pull_and_stay_in_the_friction_pyramid(soft_problem, disturbed):
    x = solve_qp(soft_problem.qp, "daqp").x
    forces = x[soft_problem.response.shape[1] :].reshape(-1, 3)  # one row a corner, foot axes, body weights
    assert len(forces) == 4 * len(disturbed[1].stance)
    assert forces[:, 2].min() >= -1e-9
    assert (np.abs(forces[:, :2]) - FRICTION * forces[:, 2:]).max() <= 1e-9
    assert (np.abs(forces[:, :2]) - 0.99 * FRICTION * forces[:, 2:]).max() > 0.0  # some corner is at its limit


def test_solution_obeys_the_equation_of_motion_and_the_limits(robot, soft_problem, disturbed):
    terms, support, response = disturbed
    torques, acceleration, contact = soft_problem.interpret(solve_qp(soft_problem, "daqp").x)
    residual = terms.mass_matrix @ acceleration + terms.bias - contact - np.r_[np.zeros(6), torques]
    assert_allclose(residual, 0.0, rtol=0, atol=1e-5)  # equalities hold to 1e-9 body weights of 1e3 N
    assert (np.abs(torques) - robot.torque_limits).max() <= 1e-5
    # the stance feet do what the command asked of them: the contact rows are no variables
    wanted = terms.output_jacobian @ response.acceleration
    for i in support.stance:
        assert_allclose((terms.output_jacobian @ acceleration)[FOOT_ROWS[i]], wanted[FOOT_ROWS[i]], rtol=0, atol=1e-8)


def test_both_solvers_find_the_same_motion(soft_problem, disturbed):
    """Clarabel ranges at a relative gap of 1e-8: 1/2 dx'P dx is at most that, ten times it with its infeasibility.

    Accelerations are then known to sqrt(2 gap), some 1e-3 m/s2, and torques to that times inertias of 100 kg m.
    """
    exact, interior = (solve_qp(soft_problem.qp, solver) for solver in ("daqp", "clarabel"))
    P, dx = soft_problem.qp.P, exact.x - interior.x
    objective = 0.5 * exact.x @ P @ exact.x
    assert 0.5 * dx @ P @ dx <= 1e-7 * (1.0 + objective)
    torques = [soft_problem.interpret(solution.x)[0] for solution in (exact, interior)]
    assert_allclose(*torques, rtol=0, atol=0.1)


def test_problem_without_conflict_returns_the_motion_wanted(robot, standing, on_its_feet):
    """Nothing to give up: y = 0, up to the tiny price of forces (1e-4) against motion (1)."""
    terms = standing(Support.LEFT)
    response = acceleration_response(terms, np.zeros(21))
    controller = SoftQP(robot, ControllerSettings(guard=False))
    problem = controller.problem(terms, response, on_its_feet(terms, Support.LEFT)[0])
    _, acceleration, contact = problem.interpret(solve_qp(problem, "daqp").x)
    assert_allclose(terms.output_jacobian @ acceleration, 0.0, rtol=0, atol=1e-3)
    assert contact[:3] @ terms.rotation_pelvis_to_world[2] == pytest.approx(terms.mass_kg * terms.gravity, rel=1e-3)


def test_both_ways_find_the_same_motion(robot, standing, on_its_feet):
    """In closed form, read off the motion, and written out for DAQP: torques, q'' and forces are one answer."""
    rng = np.random.default_rng(17)
    ways = []
    for support in (Support.LEFT, Support.RIGHT, Support.DOUBLE):
        terms = standing(support)
        geometry = on_its_feet(terms, support)[0]
        for size in (0.0, 0.05, 0.3, 3.0):
            response = acceleration_response(terms, size * rng.normal(size=21))
            problem = SoftQP(robot, ControllerSettings(guard=False)).problem(terms, response, geometry)
            found, written_out = solve_qp(problem, "daqp"), solve_qp(problem.qp, "daqp")
            ways.append(found.method)
            assert found.method == written_out.method
            for ours, theirs in zip(problem.interpret(found.x), problem.interpret(written_out.x), strict=True):
                assert_allclose(ours, theirs, rtol=0, atol=1e-6)
            for residual in (*found.residuals(), *own_residuals(problem.qp, found)):
                assert residual <= 1e-6
    assert {"closed-form", "daqp"} == set(ways)


def test_the_memory_decides_the_way_and_not_the_answer(robot, standing, on_its_feet):
    """A controller that has just met an active inequality asks DAQP, and is told the same."""
    terms = standing(Support.LEFT)
    support = on_its_feet(terms, Support.LEFT)[0]
    response = acceleration_response(terms, np.zeros(21))
    controller = SoftQP(robot, ControllerSettings(guard=False))
    free = solve_qp(controller.problem(terms, response, support), "daqp")
    controller._held_back = True
    problem = controller.problem(terms, response, support)
    asked = solve_qp(problem, "daqp")
    assert (free.method, asked.method) == ("closed-form", "daqp")
    assert not asked.held_back
    assert_allclose(asked.x, free.x, rtol=0, atol=1e-9)
    controller.reset()
    assert solve_qp(controller.problem(terms, response, support), "daqp").method == "closed-form"


@pytest.mark.parametrize("controller", ["two-part", "soft-qp"])
def test_without_ranges_a_stance_ankle_at_its_stop_does_not_hold_the_leg(robot, standing, on_its_feet, controller):
    """The answer is then that of an ankle whose range has no end; with its range it is another one."""
    ankle = robot.feet[0].frontal
    velocity = np.zeros(21)
    velocity[ankle] = 1.0
    terms = standing(Support.LEFT, velocity)
    sensing = on_its_feet(terms, Support.LEFT)[1]
    reference = standing_reference(robot, Support.LEFT)
    there = float(terms.state.q[ankle + 1])

    def torques(upper, ranges):
        entry = controller_named(controller)
        settings = entry.settings({"joint_ranges": ranges})
        joints = tuple(replace(joint, upper_rad=upper) if joint.dof == ankle else joint for joint in robot.joints)
        return entry.make(replace(robot, joints=joints), settings).tick(terms, reference, sensing).torques

    assert_allclose(torques(there, False), torques(10.0, True), rtol=0.0, atol=1e-6)
    assert np.abs(torques(there, True) - torques(10.0, True)).max() > 1.0
