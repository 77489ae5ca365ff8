"""``two-part``: the ankles by the total rate of angular momentum (28), every other joint by the contact QP (17)."""

from dataclasses import replace

import numpy as np

from surefoot.control.balance.ankle_law import ankle_torques, ankles_hold_sole, beyond_limits
from surefoot.control.balance.capture_guard import LimitedZMP, limit_zmp
from surefoot.control.balance.contact_wrench import FootShare, joint_torques, required_wrench, share_between_feet
from surefoot.control.balance.support import SupportGeometry, support_geometry
from surefoot.control.balance.zmp_demand import demanded_zmp, move_zmp, with_planned_zmp
from surefoot.control.controllers.soft_qp import SoftQP
from surefoot.control.interface import ControlOutput, Status
from surefoot.control.qp.contact_qp import contact_model, motion_qp
from surefoot.control.qp.solver import solve_qp
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import (
    AccelerationResponse,
    GainTable,
    acceleration_response,
    commanded_output_acceleration,
)
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.rotations import roll_about_forward_axis
from surefoot.momentum.delta import delta_about, momentum_rate
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference

GATE_ROLL_RAD = 0.035  # 2 degrees: a stance sole rolled by more stands on a stone
GATE_CORNER_SCALE = 1.6  # of the sole, while the gate is on: virtual corners outside it


class TwoPart:
    """The paper's controller; which reading of it, the settings say.

    A tick: wanted q'' -> its ZMP by delta_P -> limits (gate, margin, guard) -> q'' whose ZMP is the limited one ->
    ankle torques by (28) -> the other joints by the QP, which takes those torques as given. Where an ankle's motor
    cannot give its torque, the QP may decide the ankles of that tick as well (``ankle_limits``): it shares the load
    between the feet as the motors can bear it, where the lever rule knows soles only.

    Args:
        robot: the robot.
        settings: all fields but ``latched`` are used.
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        self._robot, self._settings, self._gains = robot, settings, GainTable(robot, settings)
        self._held_back = False
        self._qp_may_take_ankles = settings.ankle_limits == "qp" or (
            settings.ankle_limits == "auto" and not ankles_hold_sole(robot)
        )
        self._soft = SoftQP(robot, replace(settings, guard=False, zmp_margin=1.0))

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """Forget whether the last QP was held back, which decides how the next is solved, never what it answers."""
        self._held_back = False

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Torques of one tick."""
        s, robot = self._settings, self._robot
        support = support_geometry(robot, terms, reference.support, sensing)
        command = commanded_output_acceleration(terms, reference, self._gains, support)
        response = acceleration_response(terms, command)
        refused = False
        if s.delta_source == "qp":
            allowed = self._allowed_by_qp(terms, response, support)
            refused, response = allowed is None, allowed or response
        rate = momentum_rate(terms, response.acceleration)
        wrench = required_wrench(terms, rate, support)

        wanted = demanded_zmp(robot, terms, s, response.acceleration, rate, wrench, support)
        if s.feedforward == "planned":
            wanted = with_planned_zmp(wanted, reference, terms, rate.normal_force, support)
        gate = s.roll_gate and self._stands_on_stone(terms, reference)
        limited = self._limit(wanted, terms, support, gate, stays=reference.com_acceleration is None)
        shift = limited.point - wrench.zmp
        if s.composition == "consistent" and s.saturation != "clip" and (shift[0] or shift[1]):
            response = move_zmp(terms, response, wrench, support, limited.point)
            rate = momentum_rate(terms, response.acceleration)
            wrench = required_wrench(terms, rate, support)
            shift = limited.point - wrench.zmp

        shares = share_between_feet(wrench, terms, support)
        ankles = ankle_torques(robot, s, terms, response.acceleration, wrench, shares, support, support.axes.dot(shift))
        torques, failed, method = self._other_joints(terms, response, shares, ankles, support, gate)
        return ControlOutput(
            torques=torques,
            status=Status.FALLBACK if failed else Status.SOLVED,
            zmp_wanted_in_world=support.to_world(wanted),
            zmp_commanded_in_world=support.to_world(limited.point),
            delta_commanded=delta_about(support.origin, terms.position_com_in_world, rate),
            guard_active=limited.active,
            guard_relaxed=limited.relaxed,
            gate_active=gate,
            infeasible=failed or refused,
            qp_method=method,
        )

    def _allowed_by_qp(
        self, terms: DynamicsTerms, response: AccelerationResponse, support: SupportGeometry
    ) -> AccelerationResponse | None:
        problem = self._soft.problem(terms, response, support)
        x = solve_qp(problem, self._settings.solver).x
        return None if x is None else response.with_acceleration(problem.interpret(x)[1])

    def _stands_on_stone(self, terms: DynamicsTerms, reference: TaskReference) -> bool:
        """Whether the stance sole has rolled away from where the reference has it (level, or on a known slope)."""
        if reference.support is Support.DOUBLE:
            return False
        i = reference.support.reference_foot
        away = reference.rotation_feet_to_world[i].T.dot(terms.feet[i].rotation_foot_to_world)
        return abs(roll_about_forward_axis(away)) > GATE_ROLL_RAD

    def _limit(
        self, wanted: np.ndarray, terms: DynamicsTerms, support: SupportGeometry, gate: bool, *, stays: bool
    ) -> LimitedZMP:
        s = self._settings
        if gate or s.saturation == "none":
            return LimitedZMP(wanted, False, False)
        omega = natural_frequency(float(terms.position_com_in_world[2] - support.origin[2]), terms.gravity)
        xi = support.from_world(capture_point(terms.position_com_in_world, terms.velocity_com_in_world, omega))
        return limit_zmp(wanted, xi, support.polygon, s.zmp_margin, guard=s.guard and stays)

    def _other_joints(
        self,
        terms: DynamicsTerms,
        response: AccelerationResponse,
        shares: tuple[FootShare, ...],
        ankles: dict[int, float],
        support: SupportGeometry,
        gate: bool,
    ) -> tuple[np.ndarray, bool, str]:
        """Torques (15,) [N m] of all joints, whether the QP failed, and how it was solved."""
        s, robot = self._settings, self._robot
        failed, torques, method = False, None, ""
        if s.other_joints == "qp":
            scale = GATE_CORNER_SCALE if gate else 1.0
            contacts = contact_model(robot, terms, support, corner_scale=scale, friction=s.assumed_friction)
            given = ankles if s.composition == "consistent" else None
            if given and self._qp_may_take_ankles and beyond_limits(robot, ankles):
                given, ankles = None, {}
            problem = motion_qp(
                robot,
                terms,
                response,
                self._gains.weights,
                support,
                contacts,
                ankle_torques=given,
                joint_ranges=s.joint_ranges,
                expect_active=self._held_back,
            )
            solution = solve_qp(problem, s.solver)
            self._held_back, failed = solution.held_back, solution.x is None
            if solution.x is not None:
                torques, method = problem.interpret(solution.x)[0], solution.method
        if torques is None:
            torques = joint_torques(terms, response.acceleration, shares)
        for dof, torque in ankles.items():
            torques[dof - BASE_DOFS] = torque
        if failed:
            torques = np.clip(torques, -robot.torque_limits, robot.torque_limits)
        return torques, failed, method
