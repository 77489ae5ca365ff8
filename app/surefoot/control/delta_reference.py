"""A constant delta_P reference: the CoM displacement it causes, and the interval in which that holds.

The paper finds its useful interval of references "very limited"; here it is computed from gains, sole and posture.
"""

from dataclasses import dataclass, replace

import numpy as np

from surefoot.control.balance.capture_guard import GUARD_SCALE, scaled_offsets
from surefoot.control.balance.support import SupportGeometry, support_geometry
from surefoot.control.balance.zmp_demand import zmp_per_com_acceleration
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import acceleration_response
from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.errors import PostureError
from surefoot.robot.description import RobotState
from surefoot.robot.sensing import FULLY_LOADED
from surefoot.task.posture import solve_posture
from surefoot.task.reference import TaskReference

_RESOLUTION_NM = 1.0


@dataclass(frozen=True, slots=True)
class Interval:
    """Admissible values of one component of delta_P^ref [N m]."""

    low_nm: float
    high_nm: float

    def contains(self, value_nm: float) -> bool:
        """Whether a value lies inside."""
        return self.low_nm <= value_nm <= self.high_nm


def com_displacement_per_delta(
    terms: DynamicsTerms, settings: ControllerSettings, support: SupportGeometry
) -> np.ndarray:
    """CoM displacement per unit of delta_P^ref (2, 2) [m per N m]: columns frontal (x), sagittal (y), world axes.

    In the consistent form the robot comes to rest where the tracking law's pull balances the bias:
    C(-K_P e) + b = G with b = (delta_ref_y, -delta_ref_x) / F_N and C affine in kappa'', hence e = Z^-1 b / K_P with
    Z = dC/dkappa''. For a point mass Z = -h/g and this is e_x = -delta_ref_y / (K_P m h),
    e_y = +delta_ref_x / (K_P m h); Bip's legs make it some 13 % less.

    Equation: (16)

    Args:
        terms: dynamics in the standing posture.
        settings: ``com_stiffness`` is K_P.
        support: the support frame.
    """
    weight = terms.mass_kg * terms.gravity
    height = float(terms.position_com_in_world[2] - support.origin[2])
    response = acceleration_response(terms, np.zeros(len(terms.bias)))
    Z = zmp_per_com_acceleration(terms, response, height, weight)
    shift = np.array(((0.0, 1.0), (-1.0, 0.0))) / weight
    return np.linalg.solve(Z, shift) / max(settings.com_stiffness, 1e-9)


def predicted_com_displacement(
    terms: DynamicsTerms, settings: ControllerSettings, support: SupportGeometry
) -> np.ndarray:
    """Displacement (2,) [m] of the CoM in world by the settings' own delta_P^ref."""
    reference = np.array((settings.delta_ref_frontal_nm, settings.delta_ref_sagittal_nm))
    return com_displacement_per_delta(terms, settings, support).dot(reference)


def admissible_intervals(
    dynamics: DynamicsModel, posture: TaskReference, settings: ControllerSettings
) -> tuple[Interval, Interval]:
    """Frontal and sagittal delta_P^ref, each alone, for which the robot comes to rest where the law is free.

    At rest the ZMP is G's projection. The capture guard leaves it alone inside the polygon scaled to 0.85, without the
    guard the margin does inside its own; beyond, the limit takes over and the CoM stays behind the prediction. Nor may
    the displaced posture put a joint outside its range.

    Args:
        dynamics: the robot's.
        posture: where it stands without a bias.
        settings: gains, guard and margin.

    Raises:
        PostureError: the posture itself cannot be reached.
    """
    terms, support = _standing(dynamics, posture)
    polygon = support.polygon
    scale = min(GUARD_SCALE, settings.zmp_margin) if settings.guard else settings.zmp_margin
    slack = scaled_offsets(polygon, scale) - polygon.normals.dot(support.from_world(terms.position_com_in_world[:2]))
    per_delta = com_displacement_per_delta(terms, settings, support)
    ends = []
    for component in range(2):
        speed = polygon.normals.dot(support.axes.T.dot(per_delta[:, component]))
        with np.errstate(divide="ignore"):
            reach = slack / speed
        for bound in (float(reach[speed < 0.0].max()), float(reach[speed > 0.0].min())):
            ends.append(_in_joint_range(dynamics, posture, per_delta[:, component], bound))
    return Interval(ends[0], ends[1]), Interval(ends[2], ends[3])


def standing_prediction(dynamics: DynamicsModel, posture: TaskReference, settings: ControllerSettings) -> np.ndarray:
    """Displacement (2,) [m] of the CoM in world by the settings' own delta_P^ref, standing in a posture."""
    terms, support = _standing(dynamics, posture)
    return predicted_com_displacement(terms, settings, support)


def _standing(dynamics: DynamicsModel, posture: TaskReference) -> tuple[DynamicsTerms, SupportGeometry]:
    q = solve_posture(dynamics, posture).q
    terms = dynamics.evaluate(RobotState(q, np.zeros(dynamics.robot.dofs)))
    return terms, support_geometry(dynamics.robot, terms, posture.support, FULLY_LOADED)


def _in_joint_range(dynamics: DynamicsModel, posture: TaskReference, per_delta: np.ndarray, bound: float) -> float:
    """The part of 0..bound [N m] whose displaced posture keeps every joint in range (bisection)."""

    def reachable(delta: float) -> bool:
        com = posture.position_com.copy()
        com[:2] += delta * per_delta
        try:
            return not solve_posture(dynamics, replace(posture, position_com=com)).out_of_range
        except PostureError:
            return False

    if reachable(bound):
        return bound
    good, bad = 0.0, bound
    while abs(bad - good) > _RESOLUTION_NM:
        middle = 0.5 * (good + bad)
        good, bad = (middle, bad) if reachable(middle) else (good, middle)
    return good
