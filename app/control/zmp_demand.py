"""The ZMP that the tracking law asks for, by whichever delta_P the settings choose."""

import numpy as np

from app.control.contact_wrench import ContactWrench
from app.control.settings import ControllerSettings
from app.control.support import SupportGeometry
from app.dynamics.links import evaluate_links
from app.dynamics.terms import DynamicsTerms
from app.momentum.delta import MomentumRate
from app.momentum.link_sum import delta_from_links
from app.momentum.zmp import zmp_components
from app.robot.description import RobotDescription

_NO_DELTA = np.zeros(3)


def demanded_zmp(
    robot: RobotDescription, terms: DynamicsTerms, settings: ControllerSettings, acceleration: np.ndarray,
    rate: MomentumRate, wrench: ContactWrench, support: SupportGeometry,
) -> np.ndarray:  # fmt: skip
    """C (2,) in the support frame [m], by (14)-(16) with the delta_P and the reference delta of the settings.

    ``commanded`` and ``qp``: delta_P of the q'' handed in. ``gravity``: delta_P regulated to zero, which is gravity
    compensation and no feedback at all. The planar forms (6), (7) sum over links at the same q''.
    """
    reference = np.array((settings.delta_ref_frontal_nm, settings.delta_ref_sagittal_nm))
    gravity_only = settings.delta_source == "gravity"
    if settings.delta_form == "full" and not gravity_only:  # (14), (15) with (5): the wrench's own ZMP
        if not reference.any():
            return wrench.zmp
        bias = np.array((reference[1], -reference[0])) / float(wrench.force[2])
        return wrench.zmp + bias
    weight = terms.mass_kg * terms.gravity
    lever = terms.position_com_in_world - support.origin
    if gravity_only:
        zeta = zmp_components(lever, _NO_DELTA, _in_world(reference, support), weight, weight)
    else:
        delta = delta_from_links(support.origin, evaluate_links(robot, terms.state, acceleration), settings.delta_form)
        zeta = zmp_components(lever, delta, _in_world(reference, support), weight, rate.normal_force)
    return zeta.dot(support.axes)


def _in_world(reference: np.ndarray, support: SupportGeometry) -> np.ndarray:
    return support.axes.dot(reference)
