"""The paper's ankle law (28): torques of the two ankle joints of a foot from the total rate of angular momentum."""

import numpy as np

from surefoot.control.balance.contact_wrench import ContactWrench, FootShare
from surefoot.control.balance.support import SupportGeometry
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.vectors import cross
from surefoot.robot.feet import Foot, Side


def torques_point_at_ankle(
    foot: Foot, terms: DynamicsTerms, share: FootShare, acceleration: np.ndarray
) -> tuple[float, float]:
    """Sagittal and frontal ankle torque [N m] with P at the ankle centre A, where the law is exact.

    For each of the two joints, with a its real, tilted axis in world:

        tau = -(delta_A + AG x m g z_up - delta_ref - M_below) . a + I_rotor q''_joint

    delta_A + AG x m g z_up is the moment of the ground about A (``share.moment_about_ankle``, delta_ref and the ZMP
    limit included). M_below . a + I_rotor q''_joint, what the links below the joint and its rotor take, is the joint's
    row of M q'' + bias, because nothing else hangs below that joint. The tangential force drops out.

    Equation: (28)
    """
    M, bias, angular = terms.mass_matrix, terms.bias, terms.feet[share.foot].jacobian[3:]
    sagittal, frontal = (
        float(M[dof].dot(acceleration)) + float(bias[dof]) - float(share.moment_about_ankle.dot(angular[:, dof]))
        for dof in (foot.sagittal, foot.frontal)
    )
    return sagittal, frontal


def torques_point_on_ground(foot: Foot, share: FootShare, *, tangential_term: bool) -> tuple[float, float]:
    """Sagittal and frontal ankle torque [N m] as the paper has it, P on the sole below the ankle.

    Sagittal (axis +y, both feet) tau = F_N zeta_x [+ h F_x]; frontal tau = -(F_N zeta_y [+ h F_y]) for the left foot
    (axis +x) and the opposite sign for the right one (axis -x). The bracket is what the paper ignores, "the tangential
    contact force".

    Equation: (28)
    """
    normal = float(share.force[2])
    lever = foot.ankle_height_m if tangential_term else 0.0
    sagittal = normal * float(share.zmp_from_point[0]) + lever * float(share.force[0])
    frontal = normal * float(share.zmp_from_point[1]) + lever * float(share.force[1])
    return sagittal, -frontal if foot.side is Side.LEFT else frontal


def without_tangential_bracket(share: FootShare, offset: np.ndarray) -> FootShare:
    """The share as a law with P off the ankle sees it when it ignores the tangential contact force.

    With P = A + offset the ground's moment about A is that about P plus offset x F; "the tangential contact force is
    ignored" drops what F_x and F_y add there. An offset of zero drops nothing, P on the ground what the paper drops.

    Equation: (28)

    Args:
        share: the foot's exact share.
        offset: P - A (3,) in world [m].
    """
    tangential = np.array((float(share.force[0]), float(share.force[1]), 0.0))
    moment = share.moment_about_ankle - cross(offset, tangential)
    return FootShare(share.foot, share.share, share.force, moment, share.zmp_from_point)


def with_zmp_shift(share: FootShare, shift: np.ndarray) -> FootShare:
    """The share with its ZMP moved by (2,) [m] in world: what clipping or a delta_ref bias does to an ankle.

    A part of the total force moves with it: moment + (shift, 0) x force, of which only the normal force counts.
    """
    normal = np.array((0.0, 0.0, float(share.force[2])))
    moment = share.moment_about_ankle + cross(np.array((float(shift[0]), float(shift[1]), 0.0)), normal)
    return FootShare(share.foot, share.share, share.force, moment, share.zmp_from_point + shift)


def whole_load_on(share: FootShare, wrench: ContactWrench, support: SupportGeometry, terms: DynamicsTerms) -> FootShare:
    """The ablation without the split: this foot is told to carry everything, as (28) printed says for each ankle."""
    ankle = terms.feet[share.foot].position_ankle_in_world
    moment = wrench.moment + cross(support.origin - ankle, wrench.force)
    zeta = support.to_world(wrench.zmp) - support.points[share.foot][:2]
    return FootShare(share.foot, 1.0, wrench.force, moment, zeta)
