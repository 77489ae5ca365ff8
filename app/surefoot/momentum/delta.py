"""The total rate of angular momentum delta_P by two roads: the centroidal one, and the paper's sums over links."""

import numpy as np

from surefoot.dynamics.links import LinkMotions
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.rotations import cross
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


FORMS = ("full", "diagonal", "printed")


def delta_from_links(point: np.ndarray, links: LinkMotions, form: str = "full") -> np.ndarray:
    """delta_P (3,) [N m] in world, summed over links.

    * ``full``: (5), sum of R_i [I_i w_i' - (I_i w_i) x w_i] + PG_i x m_i gamma_Gi.
    * ``diagonal``: (6), (7) with the rotation terms put back where they belong: I_xx w_x' under delta_x, I_yy w_y'
      under delta_y, in link axes. Still wrong for tilted links and without gyroscopic terms.
    * ``printed``: (6), (7) as they stand, the rotation terms swapped. With the paper's z = our -y this puts
      -I_yy w_y' under delta_x and -I_xx w_x' under delta_y.

    The vertical component, which the paper does not print, is that of (5) in every form.

    Equation: (5), (6), (7)

    Args:
        point: P (3,) in world [m].
        links: motion of every link.
        form: ``full``, ``diagonal`` or ``printed``.
    """
    moments = np.cross(links.position_com - point, links.mass_kg[:, None] * links.acceleration_com).sum(axis=0)
    spin = np.einsum("nij,nj->ni", links.inertia_at_com, links.omega)
    rotation = np.einsum("nij,nj->ni", links.inertia_at_com, links.omega_dot) - np.cross(spin, links.omega)
    rotation = np.einsum("nij,nj->i", links.rotation_link_to_world, rotation)
    if form != "full":
        sum_x = float((links.inertia_at_com[:, 0, 0] * links.omega_dot[:, 0]).sum())
        sum_y = float((links.inertia_at_com[:, 1, 1] * links.omega_dot[:, 1]).sum())
        rotation[:2] = (sum_x, sum_y) if form == "diagonal" else (-sum_y, -sum_x)
    return moments + rotation


def contact_moment_from_links(point: np.ndarray, links: LinkMotions, chosen: list[int], gravity: float) -> np.ndarray:
    """M_below (3,) [N m]: sum over some links of delta_A,i + AG_i x m_i g z_up, the share of (28) they take.

    Args:
        point: A (3,) in world [m].
        links: motion of every link.
        chosen: indices of the links that lie below the joint.
        gravity: g [m/s2].
    """
    total = np.zeros(3)
    for i in chosen:
        R, inertia, w = links.rotation_link_to_world[i], links.inertia_at_com[i], links.omega[i]
        force = links.mass_kg[i] * (links.acceleration_com[i] + np.array((0.0, 0.0, gravity)))
        total += R @ (inertia @ links.omega_dot[i] - np.cross(inertia @ w, w))
        total += np.cross(links.position_com[i] - point, force)
    return total
