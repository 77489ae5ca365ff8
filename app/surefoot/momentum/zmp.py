"""The ZMP, the point C of the sole plane about which the horizontal moment vanishes, and the capture point."""

import math

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon
from surefoot.geometry.rotations import cross

UP = np.array((0.0, 0.0, 1.0))


def moment_about(point_to_com: np.ndarray, delta: np.ndarray, weight: float) -> np.ndarray:
    """Moment of inertial and gravitational forces about P: M_P = -delta_P + PG x (-m g z_up).

    Equation: (8)

    Args:
        point_to_com: PG (3,) [m].
        delta: delta_P (3,) [N m].
        weight: m g [N].

    Returns:
        M_P (3,) in world [N m].
    """
    return -delta - cross(point_to_com, weight * UP)


def moment_about_zmp(
    point_to_com: np.ndarray, point_to_zmp: np.ndarray, delta: np.ndarray, weight: float, linear_rate: np.ndarray
) -> np.ndarray:
    """M_C = M_P + PC x (m g z_up + m a_G). Only its horizontal part vanishes at the ZMP; P and C at one height.

    Equation: (9)

    Args:
        point_to_com: PG (3,) [m].
        point_to_zmp: PC (3,) [m].
        delta: delta_P (3,) [N m].
        weight: m g [N].
        linear_rate: m a_G (3,) [N].
    """
    return moment_about(point_to_com, delta, weight) + cross(point_to_zmp, weight * UP + linear_rate)


def zmp_vector(point_to_com: np.ndarray, delta: np.ndarray, weight: float, normal_force: float) -> np.ndarray:
    """PC = z_up x (delta_P + PG x m g z_up) / F_N. Given deviations from a reference it yields PC's deviation.

    With C_ref = P and PG_ref vertical the deviation form (11)-(13) is this same formula with delta_P - delta_ref in
    place of delta_P, so a reference delta is a torque bias.

    Equation: (10), (11)-(13)

    Args:
        point_to_com: PG (3,) [m], or its deviation (12).
        delta: delta_P (3,) [N m], or its deviation (16).
        weight: m g [N].
        normal_force: F_N = m (g + z_G'') [N].

    Returns:
        PC (3,) [m], its third component 0.
    """
    return cross(UP, delta + cross(point_to_com, weight * UP)) / normal_force


def zmp_components(
    com_from_point: np.ndarray, delta: np.ndarray, delta_reference: np.ndarray, weight: float, normal_force: float
) -> np.ndarray:
    """zeta = C - P from the deviation of delta_P.

    zeta_x = [m g (x_G - x_P) - (delta_y - delta_ref_y)] / F_N and
    zeta_y = [m g (y_G - y_P) + (delta_x - delta_ref_x)] / F_N in our axes (the paper's z is our -y).

    Equation: (14), (15), (16)

    Args:
        com_from_point: PG, at least its horizontal part [m].
        delta: delta_P, at least its horizontal part [N m].
        delta_reference: delta_P^ref, horizontal part (2,) [N m].
        weight: m g [N].
        normal_force: F_N [N].

    Returns:
        zeta (2,) in world [m].
    """
    return np.array(
        (
            (weight * float(com_from_point[0]) - (float(delta[1]) - float(delta_reference[1]))) / normal_force,
            (weight * float(com_from_point[1]) + (float(delta[0]) - float(delta_reference[0]))) / normal_force,
        )
    )


def centre_of_pressure(force: np.ndarray, moment: np.ndarray) -> np.ndarray:
    """Horizontal offset (2,) [m] from the moment's point to where a wrench's horizontal moment vanishes.

    NaN where there is no normal force: a QP that lets go of the ground altogether.
    """
    normal = float(force[2])
    if normal == 0.0:
        return np.full(2, np.nan)
    return np.array((-float(moment[1]) / normal, float(moment[0]) / normal))


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
