"""The total rate of angular momentum delta_P by the centroidal road."""

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.vectors import cross
from surefoot.record import record


@record
class MomentumRate:
    """Rate of the robot's momentum for one q''; world axes.

    Attributes:
        linear: m a_G (3,) [N].
        angular_about_com: L_G' (3,) [N m].
        normal_force: F_N = m (g + z_G'') [N], what the ground must push with.
    """

    linear: np.ndarray
    angular_about_com: np.ndarray
    normal_force: float


def momentum_rate(terms: DynamicsTerms, acceleration: np.ndarray) -> MomentumRate:
    """Momentum rate for the acceleration q'' (21,): A_G q'' + A_G' v."""
    rate = terms.centroidal_map.dot(acceleration) + terms.centroidal_drift
    return MomentumRate(rate[:3], rate[3:], terms.mass_kg * terms.gravity + float(rate[2]))


def delta_about(point: np.ndarray, position_com: np.ndarray, rate: MomentumRate) -> np.ndarray:
    """Total rate of angular momentum about a point: delta_P = L_G' + PG x m a_G.

    The paper's sum over links (5), summed in closed form by the centroidal map; both roads are compared in the
    tests. It is the time derivative (3) of L_P (4) only for a point that stands still: never difference (4).

    Equation: (3), (5)

    Args:
        point: P (3,) in world [m].
        position_com: G (3,) in world [m].
        rate: momentum rate of the whole robot.

    Returns:
        delta_P (3,) in world [N m].
    """
    return rate.angular_about_com + cross(position_com - point, rate.linear)


def angular_momentum_about(point: np.ndarray, terms: DynamicsTerms) -> np.ndarray:
    """Angular momentum about a fixed point: L_P = L_G + PG x m v_G.

    Equation: (4)

    Args:
        point: P (3,) in world [m], at rest.
        terms: dynamics at the state.

    Returns:
        L_P (3,) in world [kg m2/s].
    """
    momentum = terms.centroidal_map.dot(terms.state.v)
    return momentum[3:] + cross(terms.position_com_in_world - point, momentum[:3])


def contact_moment_about(
    point: np.ndarray, position_com: np.ndarray, rate: MomentumRate, gravity_force: float
) -> np.ndarray:
    """Moment the ground must exert about a point so that delta_P comes true: delta_P + PG x m g z_up.

    Args:
        point: P (3,) in world [m].
        position_com: G (3,) in world [m].
        rate: momentum rate wanted.
        gravity_force: m g [N].

    Returns:
        (3,) in world [N m].
    """
    force = rate.linear + np.array((0.0, 0.0, gravity_force))
    return rate.angular_about_com + cross(position_com - point, force)
