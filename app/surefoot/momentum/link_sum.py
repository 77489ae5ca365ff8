"""delta_P by the paper's own sums over links, in full and in its two planar readings."""

import numpy as np

from surefoot.dynamics.links import LinkMotions

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
