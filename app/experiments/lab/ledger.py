"""Why eta may exceed 1: the impulse a push was survived with, entry by entry.

With xi = x_G + x_G'/omega (omega that of the CoM at rest) and the point c = x_G - F/(m omega^2) that the ground force F
acts as if it came from, xi' = omega (xi - c) + F_push/(m omega) holds exactly, whatever height and angular momentum do.
Multiplied by e^(-omega t), integrated from the push's start and projected on the normal n (offset b) of the edge that
bounds the push's direction u, it reads

    J = J_cap + (m omega / (kappa n.u)) [ integral of omega (n.c - b) e^(-omega t) dt + what is left at both ends ]

with kappa = (1 - e^(-omega T)) / (omega T). The CMP, where the line of F through G meets the ground, is off the ZMP by
the moment M about G: CMP - ZMP = (M_y, -M_x) / F_z. With s = F_z / (m omega^2 z_G), 1 while G keeps its height,

    c - b = s (ZMP - b) + s (CMP - ZMP) + (1 - s) (x_G - b)

are the sole that was not used to its edge (and, where the foot has slipped or rolled, how far it took that edge along:
no momentum, so no excuse), the angular momentum about G (s (CMP - ZMP) = (M_y, -M_x) / (m omega^2 z_G):
no division by F_z, so chattering contacts average out), and the vertical motion.
"""

from dataclasses import dataclass

import numpy as np

from app.experiments.lab.bounds import CaptureBound
from app.experiments.lab.episode import GroundHistory
from app.simulation.physics import TIMESTEP_S

TOLERANCE = 0.02  # of J_cap


@dataclass(frozen=True)
class Ledger:
    """Entries [N s]; their sum with J_cap is the impulse.

    Attributes:
        impulse_ns: J of the push.
        bound_ns: J_cap.
        sole_ns: the ZMP against the edge where the foot is now: never positive; the part of the sole not used.
        foot_moved_ns: how far that edge moved with the foot.
        angular_momentum_ns: the moment about G.
        vertical_ns: vertical acceleration and change of height.
        ends_ns: the state before the push and after the episode.
    """

    impulse_ns: float
    bound_ns: float
    sole_ns: float
    foot_moved_ns: float
    angular_momentum_ns: float
    vertical_ns: float
    ends_ns: float

    @property
    def excess_ns(self) -> float:
        """What lies above J_cap."""
        return self.impulse_ns - self.bound_ns

    @property
    def unexplained_ns(self) -> float:
        """The part of the excess that the angular momentum about G does not explain."""
        return max(0.0, self.excess_ns - max(0.0, self.angular_momentum_ns))

    @property
    def explained(self) -> bool:
        """Whether that is within 2 % of J_cap."""
        return self.unexplained_ns <= TOLERANCE * self.bound_ns

    @property
    def gap_ns(self) -> float:
        """What the entries miss of J: rounding of the integration, a check of the accounting itself."""
        entries = (self.sole_ns, self.foot_moved_ns, self.angular_momentum_ns, self.vertical_ns, self.ends_ns)
        return self.impulse_ns - self.bound_ns - sum(entries)


def momentum_ledger(history: GroundHistory, bound: CaptureBound, start_s: float, impulse_ns: float) -> Ledger:
    """Integrate the ground's history from the start of a push on, on level ground.

    Args:
        history: every tick.
        bound: of this push.
        start_s: when the push starts [s].
        impulse_ns: its J [N s].
    """
    omega, mass, normal = bound.omega, bound.mass_kg, bound.normal
    after = history.time_s >= start_s - 5e-7
    t = history.time_s[after] - start_s
    com, force, moment = history.com[after], history.force[after], history.moment_about_com[after]
    offset = com[:, :2] @ normal - bound.offset  # n.x_G - b
    effective = offset - force[:, :2] @ normal / (mass * omega**2)  # n.c - b
    share = force[:, 2] / (mass * omega**2 * com[:, 2])  # s
    turning = np.column_stack((moment[:, 1], -moment[:, 0])) @ normal / (mass * omega**2 * com[:, 2])
    vertical = (1.0 - share) * offset
    moved = share * ((history.sole_corners[after] @ normal).max(axis=1) - bound.offset)

    slant = float(normal @ bound.direction)
    kappa = -np.expm1(-omega * bound.duration_s) / (omega * bound.duration_s)
    to_impulse = mass * omega / (kappa * slant)
    weight = np.exp(-omega * t) * -np.expm1(-omega * TIMESTEP_S)  # the exact integral over each tick
    xi = com[:, :2] + history.com_velocity[after][:, :2] / omega
    ends = (normal @ (bound.com - xi[0])) + np.exp(-omega * t[-1]) * (normal @ xi[-1] - bound.offset)
    return Ledger(
        impulse_ns, bound.impulse_ns,
        float(to_impulse * (weight @ (effective - turning - vertical - moved))),
        float(to_impulse * (weight @ moved)),
        float(to_impulse * (weight @ turning)),
        float(to_impulse * (weight @ vertical)),
        float(to_impulse * ends),
    )  # fmt: skip
