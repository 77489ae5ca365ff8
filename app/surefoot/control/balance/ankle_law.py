"""The paper's ankle law (28): torques of a foot's two ankle joints from the total rate of angular momentum.

First the law in each of its readings, then which of them the settings choose and what each loaded ankle gets.
"""

import numpy as np

from surefoot.control.balance.contact_wrench import ContactWrench, FootShare
from surefoot.control.balance.support import SupportGeometry
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.rotations import cross
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.feet import Foot
from surefoot.robot.weight_reach import weight_reach


def torques_point_at_ankle(
    foot: Foot, terms: DynamicsTerms, share: FootShare, acceleration: np.ndarray
) -> tuple[float, float]:
    """Sagittal and frontal ankle torque [N m] with P at the ankle centre A, where the law is exact.

    For each of the two joints, with a its real, tilted axis in world and r from a point of the axis to A:

        tau = -(delta_A + AG x m g z_up - delta_ref - M_below) . a - (a x r) . F + I_rotor q''_joint

    delta_A + AG x m g z_up is the moment of the ground about A (``share.moment_about_ankle``, delta_ref and the ZMP
    limit included). M_below . a + I_rotor q''_joint, what the links below the joint and its rotor take, is the joint's
    row of M q'' + bias, because nothing else hangs below that joint. (a x r, a) is the joint's column of the foot's
    Jacobian: any order and any sign of the axes is right. Where both axes meet in A, as Bip's do, the ground's force F
    has no lever and drops out.

    Equation: (28)
    """
    M, bias, jacobian = terms.mass_matrix, terms.bias, terms.feet[share.foot].jacobian
    sagittal, frontal = (
        float(M[dof].dot(acceleration))
        + float(bias[dof])
        - float(share.moment_about_ankle.dot(jacobian[3:, dof]))
        - float(share.force.dot(jacobian[:3, dof]))
        for dof in (foot.sagittal, foot.frontal)
    )
    return sagittal, frontal


def torques_point_on_ground(
    foot: Foot, terms: DynamicsTerms, share: FootShare, *, tangential_term: bool
) -> tuple[float, float]:
    """Sagittal and frontal ankle torque [N m] as the paper has it, P on the sole below the ankle.

    Sagittal tau = F_N zeta_x [+ h F_x] about an axis that points to the left, frontal tau = -(F_N zeta_y [+ h F_y])
    about one that points forward; the opposite sign about an axis that points the other way, as Bip's right frontal one
    does. The bracket is what the paper ignores, "the tangential contact force".

    Equation: (28)
    """
    normal = float(share.force[2])
    lever = foot.ankle_height_m if tangential_term else 0.0
    sagittal = normal * float(share.zmp_from_point[0]) + lever * float(share.force[0])
    frontal = normal * float(share.zmp_from_point[1]) + lever * float(share.force[1])
    now = terms.feet[share.foot]
    forward, left = now.rotation_foot_to_world[:, 0], now.rotation_foot_to_world[:, 1]
    to_left = float(now.jacobian[3:, foot.sagittal].dot(left)) > 0.0
    to_front = float(now.jacobian[3:, foot.frontal].dot(forward)) > 0.0
    return sagittal if to_left else -sagittal, -frontal if to_front else frontal


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


def ankle_torques(
    robot: RobotDescription,
    settings: ControllerSettings,
    terms: DynamicsTerms,
    acceleration: np.ndarray,
    wrench: ContactWrench,
    shares: tuple[FootShare, ...],
    support: SupportGeometry,
    shift: np.ndarray,
) -> dict[int, float]:
    """Velocity index -> torque [N m] of the loaded feet's ankles.

    Args:
        robot: the robot.
        settings: ``p_point``, ``p_offset_*``, ``tangential_term`` and ``double_support_split`` are used.
        terms: dynamics at the state.
        acceleration: q'' (n,) that the torques belong to.
        wrench: total ground wrench of that q''.
        shares: how the feet share it.
        support: the support frame.
        shift: what clipping or a delta_ref bias still moves the ZMP by (2,) in world [m].
    """
    torques = {}
    split = settings.double_support_split or len(shares) == 1
    shifted = bool(shift[0] or shift[1])
    for share in shares:
        foot = robot.feet[share.foot]
        part = share if split else whole_load_on(share, wrench, support, terms)
        if shifted:
            part = with_zmp_shift(part, shift)
        if settings.p_point == "ground":
            pair = torques_point_on_ground(foot, terms, part, tangential_term=settings.tangential_term)
            pair = _towards_free(foot.sagittal, foot.frontal, pair, support.loads[share.foot], terms, acceleration)
        else:
            if settings.p_point == "offset" and not settings.tangential_term:
                part = without_tangential_bracket(part, _offset_in_world(settings, support))
            pair = torques_point_at_ankle(foot, terms, part, acceleration)
        torques[foot.sagittal], torques[foot.frontal] = pair
    return torques


def ankles_hold_sole(robot: RobotDescription) -> bool:
    """Whether each ankle's motors hold the robot's whole weight at every edge of its sole, in statics.

    Where they do not, the law's ZMP is inside the sole and beyond what the motors can bring about.
    """
    weight = robot.mass_kg * robot.gravity
    limits = robot.torque_limits.tolist()
    return all(
        reach.holds_sole
        for foot in robot.feet
        for reach in weight_reach(
            (limits[foot.sagittal - BASE_DOFS], limits[foot.frontal - BASE_DOFS]), weight, foot.sole.vertices
        )
    )


def beyond_limits(robot: RobotDescription, ankles: dict[int, float]) -> bool:
    """Whether any of these joints (velocity index -> torque [N m]) is asked for more than its motor gives."""
    limits = robot.torque_limits
    return any(abs(torque) > limits[dof - BASE_DOFS] for dof, torque in ankles.items())


def _offset_in_world(settings: ControllerSettings, support: SupportGeometry) -> np.ndarray:
    horizontal = support.axes.dot(np.array((settings.p_offset_x_m, settings.p_offset_y_m)))
    return np.array((horizontal[0], horizontal[1], settings.p_offset_z_m))


def _towards_free(
    sagittal: int, frontal: int, pair: tuple[float, float], load: float, terms: DynamicsTerms, acceleration: np.ndarray
) -> tuple[float, float]:
    """A foot that loses its load goes back to task-space torques smoothly; a loaded one keeps the law's."""
    if load == 1.0:
        return pair
    free = terms.mass_matrix[[sagittal, frontal]].dot(acceleration) + terms.bias[[sagittal, frontal]]
    return load * pair[0] + (1.0 - load) * float(free[0]), load * pair[1] + (1.0 - load) * float(free[1])
