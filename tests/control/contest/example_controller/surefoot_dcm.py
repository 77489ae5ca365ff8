"""``dcm``: the ZMP leads the capture point back, inverse dynamics does the rest. No QP, no state, one page.

A worked example of a controller from outside: this file and its pyproject.toml are the whole package.
"""

import numpy as np

from surefoot import (
    ControllerEntry,
    ControllerSettings,
    ControlOutput,
    DynamicsTerms,
    FootSensing,
    GainTable,
    RobotDescription,
    Status,
    TaskReference,
    acceleration_response,
    capture_point,
    commanded_output_acceleration,
    delta_about,
    joint_torques,
    momentum_rate,
    move_zmp,
    natural_frequency,
    project_onto_halfplanes,
    required_wrench,
    share_between_feet,
    support_geometry,
)

LEAD = 2.0  # the ZMP goes this many times as far from the reference as the capture point: above 1 or it never returns


class DCM:
    """c = xi_ref + LEAD (xi - xi_ref), held inside the sole; the CoM accelerates so that c is the ZMP.

    Args:
        robot: the robot.
        settings: gains of everything but the CoM's horizontal motion, and ``zmp_margin``.
    """

    def __init__(self, robot: RobotDescription, settings: ControllerSettings):
        self._robot, self._settings, self._gains = robot, settings, GainTable(robot, settings)

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """Nothing is remembered."""

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Torques of one tick."""
        support = support_geometry(self._robot, terms, reference.support, sensing)
        com = terms.position_com_in_world
        omega = natural_frequency(float(com[2] - support.origin[2]), terms.gravity)

        # 1. where the ZMP should be: beyond the capture point, but inside the sole
        xi = capture_point(com, terms.velocity_com_in_world, omega)
        xi_ref = capture_point(reference.position_com, reference.velocity[:3], omega)
        wanted = support.from_world(xi_ref + LEAD * (xi - xi_ref) - reference.acceleration[:2] / omega**2)
        sole = support.polygon.scaled(self._settings.zmp_margin)
        allowed = project_onto_halfplanes(wanted, sole.normals, sole.offsets)
        zmp = sole.centroid if allowed is None else allowed

        # 2. the motion that has this ZMP: the tracking law for all other rows of kappa
        command = commanded_output_acceleration(terms, reference, self._gains, support)
        response = acceleration_response(terms, command)
        wrench = required_wrench(terms, momentum_rate(terms, response.acceleration), support)
        response = move_zmp(terms, response, wrench, support, zmp)
        rate = momentum_rate(terms, response.acceleration)
        wrench = required_wrench(terms, rate, support)

        # 3. inverse dynamics
        torques = joint_torques(terms, response.acceleration, share_between_feet(wrench, terms, support))
        limits = self._robot.torque_limits
        return ControlOutput(
            torques=np.clip(torques, -limits, limits),
            status=Status.SOLVED,
            zmp_wanted_in_world=support.to_world(wanted),
            zmp_commanded_in_world=support.to_world(zmp),
            delta_commanded=delta_about(support.origin, com, rate),
            guard_active=bool((zmp != wanted).any()),
        )


entry = ControllerEntry(
    name="dcm", help="the ZMP leads the capture point back, inverse dynamics does the rest", build=DCM
)
