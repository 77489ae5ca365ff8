"""``optimization``: the paper's baseline, hard tracking with a contact-force QP and nothing to fall back on."""

import numpy as np

from surefoot.control.balance.contact_wrench import required_wrench
from surefoot.control.balance.support import support_geometry
from surefoot.control.interface import ControlOutput, Status
from surefoot.control.qp.contact_qp import contact_model, force_qp
from surefoot.control.qp.solver import solve_qp
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import GainTable, acceleration_response, commanded_output_acceleration
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.momentum.delta import delta_about, momentum_rate
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class Optimization:
    """kappa'' must equal v + kappa_d''; contact forces are sought that carry it (17).

    When there are none (the ZMP asked for leaves the sole, or the force the cone) the last torques are held. With
    ``latched`` they are held for ever after, as the paper's Figure 8 shows; else every tick tries again.

    Args:
        robot: the robot.
        settings: gains, ``latched``, ``assumed_friction``, ``solver`` are used.
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        self._robot, self._settings, self._gains = robot, settings, GainTable(robot, settings)
        self.reset()

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """Forget an infeasibility; hold ``last_torques`` (15,) if the very first tick should be infeasible."""
        self._held = last_torques
        self._failed = False

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Torques of one tick."""
        robot, settings = self._robot, self._settings
        support = support_geometry(robot, terms, reference.support, sensing)
        command = commanded_output_acceleration(terms, reference, self._gains, support)
        acceleration = acceleration_response(terms, command).acceleration
        rate = momentum_rate(terms, acceleration)
        wrench = required_wrench(terms, rate, support)

        forces, method = None, ""
        if not (self._failed and settings.latched):
            contacts = contact_model(robot, terms, support, corner_scale=1.0, friction=settings.assumed_friction)
            solution = solve_qp(force_qp(terms, acceleration, contacts), settings.solver)
            if solution.x is not None:
                forces, method = solution.x, solution.method
        infeasible = forces is None
        self._failed = self._failed or infeasible
        if forces is not None:
            generalized = terms.mass_matrix.dot(acceleration) + terms.bias
            self._held = (generalized - contacts.transposed_jacobian.dot(forces))[BASE_DOFS:]
        elif self._held is None:
            self._held = np.zeros(len(robot.joints))
        zmp = support.to_world(wrench.zmp)
        return ControlOutput(
            torques=self._held,
            status=Status.HOLDING if infeasible else Status.SOLVED,
            zmp_wanted_in_world=zmp,
            zmp_commanded_in_world=zmp,
            delta_commanded=delta_about(support.origin, terms.position_com_in_world, rate),
            infeasible=infeasible,
            qp_method=method,
        )
