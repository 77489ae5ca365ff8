"""How the ZMP answers the CoM's horizontal acceleration, and the q'' that puts it where it should be."""

import numpy as np

from surefoot.control.balance.contact_wrench import ContactWrench
from surefoot.control.balance.support import SupportGeometry
from surefoot.control.task_acceleration import AccelerationResponse
from surefoot.dynamics.terms import DynamicsTerms


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
