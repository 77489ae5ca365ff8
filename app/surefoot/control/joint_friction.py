"""Feed-forward against the joints' own friction: what a motor must give on top of what the rigid bodies need.

With d and f of a joint (``Joint.damping``, ``Joint.friction_nm``) and a rate w,

    tau_f = d w + f tanh(w / ``SMOOTH``)

w is the measured rate where the joint moves. Where it sticks that says nothing, and there it is the rate that the
task asks for: of v_r = kappa_d' - (K_P / K_D) e, at which the tracking law (23) is at rest, H^-1 v_r. So a small error
e of a robot that sticks turns the torque towards where it should go, and vanishes with it.
"""

from dataclasses import replace

import numpy as np

from surefoot.control.interface import Controller, ControlOutput
from surefoot.control.output_check import output_fault
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import FOOT_ROWS, DynamicsTerms
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference, task_error

# With a fifth of SMOOTH a robot of 20 kg whose legs rub with 0.8 N m never comes to rest (G moves by 1 mm); with four
# times as much G is off by five times as much after 1.4 s.
SMOOTH = 0.05  # rad/s: the rate at which three quarters of the dry friction are given
STICKS = 0.05  # rad/s: below about this a joint counts as sticking


class FrictionCompensated:
    """Any controller, with what the joints' friction takes on top of its torques, as far as their limits let it.

    Args:
        controller: decides the torques without friction.
        robot: whose joints they are.
        settings: K_P and K_D.
    """

    def __init__(self, controller: Controller, robot: RobotDescription, settings: ControllerSettings) -> None:
        self._controller, self._limits = controller, robot.torque_limits
        self._damping = np.array([joint.damping for joint in robot.joints])
        self._friction = np.array([joint.friction_nm for joint in robot.joints])
        stiffness, damping = settings.stiffness(robot.dofs), settings.damping(robot.dofs)
        self._rate_per_error = np.divide(stiffness, damping, out=np.zeros(robot.dofs), where=damping > 0.0)

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Decide the torques of one tick."""
        output = self._controller.tick(terms, reference, sensing)
        if output_fault(output, len(self._limits)) is not None:
            return output
        own = output.torques
        wanted = own + self.torques(terms, reference)
        torques = np.clip(wanted, np.minimum(own, -self._limits), np.maximum(own, self._limits))
        return replace(output, torques=torques)

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """As of the controller."""
        self._controller.reset(last_torques)

    def torques(self, terms: DynamicsTerms, reference: TaskReference) -> np.ndarray:
        """tau_f (joints,) [N m]."""
        measured = terms.state.v[BASE_DOFS:]
        sticks = np.exp(-((measured / STICKS) ** 2))
        rate = measured + sticks * (self._asked_rate(terms, reference) - measured)
        return self._damping * rate + self._friction * np.tanh(rate / SMOOTH)

    def _asked_rate(self, terms: DynamicsTerms, reference: TaskReference) -> np.ndarray:
        """H^-1 v_r of the joints (joints,) [rad/s], stance feet at rest; the measured rates where H is singular."""
        asked = reference.velocity - self._rate_per_error * task_error(terms, reference)
        for i in reference.support.stance:
            asked[FOOT_ROWS[i]] = 0.0
        try:
            return np.linalg.solve(terms.output_jacobian, asked)[BASE_DOFS:]
        except np.linalg.LinAlgError:
            return terms.state.v[BASE_DOFS:]
