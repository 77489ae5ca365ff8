"""The ZMP that the tracking law asks for, by whichever delta_P the settings choose, and the q'' that moves it."""

import numpy as np

from surefoot.control.balance.contact_wrench import ContactWrench
from surefoot.control.balance.support import SupportGeometry
from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import AccelerationResponse
from surefoot.dynamics.links import evaluate_links
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.momentum.delta import MomentumRate, delta_from_links
from surefoot.momentum.zmp import zmp_components
from surefoot.robot.description import RobotDescription
from surefoot.task.reference import TaskReference

_NO_DELTA = np.zeros(3)


def demanded_zmp(
    robot: RobotDescription,
    terms: DynamicsTerms,
    settings: ControllerSettings,
    acceleration: np.ndarray,
    rate: MomentumRate,
    wrench: ContactWrench,
    support: SupportGeometry,
) -> np.ndarray:
    """C (2,) in the support frame [m], by (14)-(16) with the delta_P and the reference delta of the settings.

    ``commanded`` and ``qp``: delta_P of the q'' handed in. ``gravity``: delta_P regulated to zero, which is gravity
    compensation and no feedback at all. The planar forms (6), (7) sum over links at the same q''.
    """
    frontal, sagittal = settings.delta_ref_frontal_nm, settings.delta_ref_sagittal_nm
    gravity_only = settings.delta_source == "gravity"
    if settings.delta_form == "full" and not gravity_only:  # (14), (15) with (5): the wrench's own ZMP
        if not (frontal or sagittal):
            return wrench.zmp
        return wrench.zmp + np.array((sagittal, -frontal)) / float(wrench.force[2])
    bias = np.array((frontal, sagittal))
    weight = terms.mass_kg * terms.gravity
    lever = terms.position_com_in_world - support.origin
    if gravity_only:
        zeta = zmp_components(lever, _NO_DELTA, support.axes.dot(bias), weight, weight)
    else:
        delta = delta_from_links(support.origin, evaluate_links(robot, terms.state, acceleration), settings.delta_form)
        zeta = zmp_components(lever, delta, support.axes.dot(bias), weight, rate.normal_force)
    return zeta.dot(support.axes)


def with_planned_zmp(
    wanted: np.ndarray, reference: TaskReference, terms: DynamicsTerms, normal_force: float, support: SupportGeometry
) -> np.ndarray:
    """The deviation form with a reference that does not cancel: zeta = zeta_ref + feedback.

    With C_ref = P and PG_ref vertical the paper's (13) forces the horizontal delta_ref to zero. Here C_ref and PG_ref
    are the planned ones: zeta = zeta_ref + [m g (PG - PG_ref) - delta_feedback] / F_N, where delta_feedback is that of
    kappa'' = v alone, so that nothing of the reference is counted twice.

    Equation: (11)-(13)

    Args:
        wanted: ZMP (2,) of kappa'' = v, support frame [m].
        reference: carries ``zmp_in_world``; without it ``wanted`` is returned.
        terms: dynamics at the state.
        normal_force: F_N [N].
        support: the support frame.
    """
    if reference.zmp_in_world is None:
        return wanted
    at_rest = (reference.position_com[:2] - support.origin[:2]) * (terms.mass_kg * terms.gravity / normal_force)
    return wanted + support.from_world(reference.zmp_in_world) - at_rest.dot(support.axes)


def zmp_per_com_acceleration(
    terms: DynamicsTerms, response: AccelerationResponse, height: float, normal_force: float
) -> np.ndarray:
    """dC / d(kappa''_x, kappa''_y) (2, 2) in world [m per m/s2].

    A change (a_x, a_y) of the CoM's acceleration, every other row of kappa'' kept, changes the moment about P by
    dM_x = d(L_G')_x - m h a_y and dM_y = d(L_G')_y + m h a_x, and C = (-M_y, M_x) / F_N, while F_N = m (g + kappa''_3)
    does not change: the ZMP is affine. For a point mass this is -h/g times the identity; Bip's legs and trunk, which
    must turn for the CoM to move, add some 13 % on the diagonal.

    Args:
        terms: dynamics at the state.
        response: q'' per CoM acceleration.
        height: h, G above the ZMP's plane [m].
        normal_force: F_N [N].
    """
    momentum = terms.centroidal_map.dot(response.per_com_acceleration)  # (6, 2)
    arm = terms.mass_kg * height
    (x_x, x_y), (y_x, y_y) = momentum[3:5].tolist()
    return np.array(((-(y_x + arm), -y_y), (x_x, x_y - arm))) / normal_force


def move_zmp(
    terms: DynamicsTerms,
    response: AccelerationResponse,
    wrench: ContactWrench,
    support: SupportGeometry,
    target: np.ndarray,
) -> AccelerationResponse:
    """The q'' whose ZMP is ``target`` (2,) in the support frame: the CoM acceleration gives way, nothing else.

    This is the paper's Figure 6 made exact, "the resulting G trajectory is displaced inside the support foot area":
    a 2 x 2 linear system.
    """
    height = float(terms.position_com_in_world[2] - support.origin[2])
    (a, b), (c, d) = zmp_per_com_acceleration(terms, response, height, float(wrench.force[2])).tolist()
    ex, ey = support.axes.dot(target - wrench.zmp).tolist()
    determinant = a * d - b * c
    change = np.array(((d * ex - b * ey) / determinant, (a * ey - c * ex) / determinant))
    return response.with_acceleration(response.acceleration + response.per_com_acceleration.dot(change))
