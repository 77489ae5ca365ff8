"""``soft-qp``: the modern baseline, weighted least squares on kappa'' under contact, friction and torque limits."""

import numpy as np

from surefoot.control.balance.capture_guard import guard_bounds
from surefoot.control.balance.contact_wrench import joint_torques, required_wrench, share_between_feet
from surefoot.control.balance.support import SupportGeometry, grasp_map, support_geometry
from surefoot.control.interface import ControlOutput, Status
from surefoot.control.qp.contact_qp import MotionQP, contact_model, motion_qp
from surefoot.control.qp.solver import solve_qp
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import (
    AccelerationResponse,
    GainTable,
    acceleration_response,
    commanded_output_acceleration,
)
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.momentum.delta import delta_about, momentum_rate
from surefoot.momentum.zmp import capture_point, natural_frequency
from surefoot.robot.description import RobotDescription
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class SoftQP:
    """The nearest motion to v + kappa_d'' that contact forces, motors and joint ranges allow.

    Corners are scaled by ``zmp_margin``; with ``guard`` the capture guard enters as rows on the corner forces. If the
    QP fails it is tried without guard; if it fails again, inverse dynamics clipped to the torque limits.

    Args:
        robot: the robot.
        settings: gains, weights, ``zmp_margin``, ``guard``, ``assumed_friction``, ``solver`` are used.
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        self._robot, self._settings, self._gains = robot, settings, GainTable(robot, settings)
        self._held_back = False

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """Forget whether the last QP was held back, which decides how the next is solved, never what it answers."""
        self._held_back = False

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Torques of one tick."""
        robot, settings = self._robot, self._settings
        support = support_geometry(robot, terms, reference.support, sensing)
        command = commanded_output_acceleration(terms, reference, self._gains, support)
        wanted = acceleration_response(terms, command)
        wanted_wrench = required_wrench(terms, momentum_rate(terms, wanted.acceleration), support)

        guard = settings.guard and reference.com_acceleration is None
        rows = guard_rows(robot, terms, support, settings.zmp_margin) if guard else None
        solved = self._solve(terms, wanted, support, rows)
        relaxed = solved is None and guard
        if relaxed:
            solved = self._solve(terms, wanted, support, None)
        if solved is None:
            torques = joint_torques(terms, wanted.acceleration, share_between_feet(wanted_wrench, terms, support))
            torques = np.clip(torques, -robot.torque_limits, robot.torque_limits)
            acceleration, method = wanted.acceleration, ""
        else:
            torques, acceleration, method = solved
        rate = momentum_rate(terms, acceleration)
        commanded = required_wrench(terms, rate, support).zmp
        return ControlOutput(
            torques=torques,
            status=Status.FALLBACK if solved is None else Status.SOLVED,
            zmp_wanted_in_world=support.to_world(wanted_wrench.zmp),
            zmp_commanded_in_world=support.to_world(commanded),
            delta_commanded=delta_about(support.origin, terms.position_com_in_world, rate),
            guard_active=bool(np.abs(commanded - wanted_wrench.zmp).max() > 1e-6),
            guard_relaxed=relaxed,
            infeasible=solved is None,
            qp_method=method,
        )

    def _solve(
        self, terms: DynamicsTerms, wanted: AccelerationResponse, support: SupportGeometry, rows: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray, str] | None:
        """Torques (15,) [N m], q'' (21,), and how they were found."""
        problem = self.problem(terms, wanted, support, rows)
        solution = solve_qp(problem, self._settings.solver)
        self._held_back = solution.held_back
        if solution.x is None:
            return None
        torques, acceleration, _ = problem.interpret(solution.x)
        return torques, acceleration, solution.method

    def problem(
        self,
        terms: DynamicsTerms,
        wanted: AccelerationResponse,
        support: SupportGeometry,
        rows: np.ndarray | None = None,
    ) -> MotionQP:
        """The QP of a tick, for looking at."""
        contacts = contact_model(
            self._robot,
            terms,
            support,
            corner_scale=self._settings.zmp_margin,
            friction=self._settings.assumed_friction,
        )
        return motion_qp(
            self._robot,
            terms,
            wanted,
            self._gains.weights,
            support,
            contacts,
            force_rows=rows,
            joint_ranges=self._settings.joint_ranges,
            expect_active=self._held_back,
        )


def guard_rows(robot: RobotDescription, terms: DynamicsTerms, support: SupportGeometry, margin: float) -> np.ndarray:
    """The capture guard as rows on the corner forces: sum_j (n.p_j - beta) l_zj >= 0 for every edge."""
    height = float(terms.position_com_in_world[2] - support.origin[2])
    xi = capture_point(
        terms.position_com_in_world, terms.velocity_com_in_world, natural_frequency(height, terms.gravity)
    )
    polygon = support.polygon
    least = guard_bounds(polygon, support.from_world(xi), margin)
    blocks = []
    for i in support.stance:
        foot = terms.feet[i]
        G = grasp_map(robot, i, margin)
        in_foot = np.vstack((-G[4, 2::3], G[3, 2::3], np.full(G.shape[1] // 3, -robot.feet[i].ankle_height_m)))
        corners = (foot.position_ankle_in_world[:, None] + foot.rotation_foot_to_world.dot(in_foot))[:2]
        local = support.axes.T.dot(corners - support.origin[:2, None])
        block = np.zeros((len(least), G.shape[1]))
        block[:, 2::3] = least[:, None] - polygon.normals.dot(local)
        blocks.append(block)
    return np.hstack(blocks)
