"""The wrench the ground must exert, and which foot takes how much of it."""

import numpy as np

from surefoot.control.balance.support import SupportGeometry
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.rotations import cross
from surefoot.momentum.delta import MomentumRate
from surefoot.momentum.zmp import centre_of_pressure
from surefoot.record import record


@record
class ContactWrench:
    """Total ground wrench of one q''.

    Attributes:
        force: m (a_G + g z_up) (3,) in world [N].
        moment: about the support frame's origin (3,) in world [N m].
        zmp: C in the support frame (2,) [m].
    """

    force: np.ndarray
    moment: np.ndarray
    zmp: np.ndarray


def required_wrench(terms: DynamicsTerms, rate: MomentumRate, support: SupportGeometry) -> ContactWrench:
    """The wrench that makes a momentum rate come true, and its ZMP (10) in the support frame."""
    weight = terms.mass_kg * terms.gravity
    force = rate.linear.copy()
    force[2] += weight
    moment = rate.angular_about_com + cross(terms.position_com_in_world - support.origin, force)
    return ContactWrench(force, moment, centre_of_pressure(force, moment).dot(support.axes))


@record
class FootShare:
    """One stance foot's part.

    Attributes:
        foot: 0 left, 1 right.
        share: part of the total force, 0 to 1.
        force: (3,) in world [N].
        moment_about_ankle: (3,) in world [N m].
        zmp_from_point: zeta (2,) of this foot relative to its own P, world axes [m].
    """

    foot: int
    share: float
    force: np.ndarray
    moment_about_ankle: np.ndarray
    zmp_from_point: np.ndarray


def share_between_feet(wrench: ContactWrench, terms: DynamicsTerms, support: SupportGeometry) -> tuple[FootShare, ...]:
    """Split the total wrench by the lever rule.

    alpha = ((C - P_L).(P_R - P_L)) / |P_R - P_L|^2, clipped to 0..1, is the right foot's share; what the point on the
    line between the feet leaves over is given to both in proportion, the yaw moment too. A foot that loses its load
    hands its share to the other as smoothly as it loses it, down to none. The shares add up to the total exactly, at
    any heights of the feet.
    """
    if len(support.stance) == 1:
        shares = ((support.stance[0], 1.0),)
        pivot = support.origin
    else:
        left, right = support.points
        across = (right - left)[:2]
        lever = support.to_world(wrench.zmp) - left[:2]
        alpha = min(max(float(lever.dot(across)) / float(across.dot(across)), 0.0), 1.0)
        l_left, l_right = support.loads
        a_left = (1.0 - alpha) * l_left + alpha * (1.0 - l_right) * l_left  # its own part, and what the other refuses
        a_right = alpha * l_right + (1.0 - alpha) * (1.0 - l_left) * l_right
        total = a_left + a_right
        shares = ((0, a_left / total), (1, a_right / total))
        pivot = (a_left * left + a_right * right) / total
    moment = wrench.moment + cross(support.origin - pivot, wrench.force)
    zeta = centre_of_pressure(wrench.force, moment)
    parts = []
    for foot, share in shares:
        lever = support.points[foot] - terms.feet[foot].position_ankle_in_world
        about_ankle = moment + cross(lever, wrench.force)
        parts.append(FootShare(foot, share, share * wrench.force, share * about_ankle, zeta))
    return tuple(parts)


def joint_torques(terms: DynamicsTerms, acceleration: np.ndarray, shares: tuple[FootShare, ...]) -> np.ndarray:
    """Inverse dynamics (22): the 15 joint rows of M q'' + bias - sum J_i^T W_i [N m].

    Equation: (22)
    """
    generalized = terms.mass_matrix.dot(acceleration) + terms.bias
    for part in shares:
        wrench = np.concatenate((part.force, part.moment_about_ankle))
        generalized -= wrench.dot(terms.feet[part.foot].jacobian)
    return generalized[6:]
