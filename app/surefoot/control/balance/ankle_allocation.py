"""Which torque each loaded ankle gets: the ankle law (28) in the reading that the settings choose."""

import numpy as np

from surefoot.control.balance.ankle_law import (
    torques_point_at_ankle,
    torques_point_on_ground,
    whole_load_on,
    with_zmp_shift,
    without_tangential_bracket,
)
from surefoot.control.balance.contact_wrench import ContactWrench, FootShare
from surefoot.control.balance.support import SupportGeometry
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.robot.description import RobotDescription


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
        acceleration: q'' (21,) that the torques belong to.
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
            pair = torques_point_on_ground(foot, part, tangential_term=settings.tangential_term)
            pair = _towards_free(foot.sagittal, foot.frontal, pair, support.loads[share.foot], terms, acceleration)
        else:
            if settings.p_point == "offset" and not settings.tangential_term:
                part = without_tangential_bracket(part, _offset_in_world(settings, support))
            pair = torques_point_at_ankle(foot, terms, part, acceleration)
        torques[foot.sagittal], torques[foot.frontal] = pair
    return torques


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
