"""The capture point and what no controller without a step or a hip swing can beat."""

import math

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon


def natural_frequency(com_height: float, gravity: float = 9.81) -> float:
    """omega = sqrt(g / h_G) [rad/s]; h_G is G's height [m] above the support, taken as at least 0.1 m."""
    return math.sqrt(gravity / max(com_height, 0.1))


def capture_point(position_com: np.ndarray, velocity_com: np.ndarray, omega: float) -> np.ndarray:
    """DCM projected on the ground: xi = G + G' / omega, horizontal part (2,) [m]."""
    return position_com[:2] + velocity_com[:2] / omega


def linear_impulse(impulse_ns: float, omega: float, com_damping: float) -> float:
    """J_lin = J_cap omega / K_D [N s]: where a PD law on the CoM has used up the sole; infinite without damping.

    Args:
        impulse_ns: J_cap [N s].
        omega: natural frequency [rad/s].
        com_damping: K_D of the CoM [1/s].
    """
    return impulse_ns * omega / com_damping if com_damping > 0.0 else float("inf")


def capture_impulse(
    mass: float, omega: float, support: ConvexPolygon, com: np.ndarray, direction: np.ndarray, duration_s: float
) -> float:
    """J_cap(T): the greatest impulse [N s] of a constant force through G of duration T that can be survived.

    A force F moves the capture point by xi' = omega (xi - c) + F / (m omega). With the ZMP c held at the edge that is
    hit, it just fails to leave when F_max = m omega^2 d e^(omega T) / (e^(omega T) - 1); J_cap = T F_max; for T -> 0
    it is m omega d.

    Args:
        mass: m [kg].
        omega: natural frequency [rad/s].
        support: true support polygon.
        com: G's ground projection (2,) [m], polygon's frame.
        direction: unit vector of the push (2,).
        duration_s: T [s], 0 for an instantaneous impulse.
    """
    d = support.distance_to_edge(com, direction)
    if duration_s <= 0.0:
        return mass * omega * d
    return duration_s * mass * omega**2 * d / -math.expm1(-omega * duration_s)
