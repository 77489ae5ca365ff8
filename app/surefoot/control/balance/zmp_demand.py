"""The ZMP that the tracking law asks for, by whichever delta_P the settings choose."""

import numpy as np

from surefoot.control.balance.contact_wrench import ContactWrench
from surefoot.control.balance.support import SupportGeometry
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.links import evaluate_links
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.momentum.delta import MomentumRate
from surefoot.momentum.link_sum import delta_from_links
from surefoot.momentum.zmp import zmp_components
from surefoot.robot.description import RobotDescription
from surefoot.task.reference import TaskReference

_NO_DELTA = np.zeros(3)


def demanded_zmp(
    robot: RobotDescription, terms: DynamicsTerms, settings: ControllerSettings, acceleration: np.ndarray,
    rate: MomentumRate, wrench: ContactWrench, support: SupportGeometry,
) -> np.ndarray:  # fmt: skip
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
