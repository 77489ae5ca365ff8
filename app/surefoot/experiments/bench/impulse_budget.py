"""Why eta may exceed 1: the impulse a push was survived with, entry by entry.

With xi = x_G + x_G'/omega (omega that of the CoM at rest) and the point c = x_G - F/(m omega^2) that the ground force F
acts as if it came from, xi' = omega (xi - c) + F_push/(m omega) holds exactly, whatever height and angular momentum do.
Multiplied by e^(-omega t), integrated from the push's start and projected on the normal n (offset b) of the edge that
bounds the push's direction u, it reads

    J = J_cap + (m omega / (kappa n.u)) [ integral of omega (n.c - b) e^(-omega t) dt + what is left at both ends ]

with kappa = (1 - e^(-omega T)) / (omega T). The CMP, where the line of F through G meets the ground, is off the ZMP by
the moment M about G: CMP - ZMP = (M_y, -M_x) / F_z. With s = F_z / (m omega^2 z_G), 1 while G keeps its height,

    c - b = s (ZMP - b) + s (CMP - ZMP) + (1 - s) (x_G - b)

are the sole that was not used to its edge (and, where the foot has slid or rolled, how far it took that edge along),
the angular momentum about G (s (CMP - ZMP) = (M_y, -M_x) / (m omega^2 z_G): no division by F_z, so chattering contacts
average out), and the vertical motion.

No entry is a remainder: the sole is measured by the ZMP of the feet's wrenches, the angular momentum by the moment
about G, the ends by the CoM's state; J is what the scenario asks for. That they add up to J is a finding, not a
definition: a force that was missed or a moment about the wrong point leaves a gap. A foot that is not where it is said
to be leaves none, but then the sole's entry, which is never positive because the ZMP cannot lie beyond the edge, may
be. An eta above 1 whose entries add up is no mistake: the positive ones are its causes.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from surefoot.experiments.bench.episode import GroundHistory
from surefoot.experiments.scenario.bounds import CaptureBound
from surefoot.simulation.physics import TIMESTEP_S

TOLERANCE = 0.005  # of J_cap; integration in ticks of 1 ms leaves gaps below 0.01 %
ENTRIES = ("sole_ns", "foot_moved_ns", "angular_momentum_ns", "vertical_ns", "ends_ns")


@dataclass(frozen=True)
class Ledger:
    """Entries [N s]; their sum with J_cap is the impulse.

    Attributes:
        impulse_ns: J of the push.
        bound_ns: J_cap.
        sole_ns: the ZMP against the edge where the foot is now: never positive; the part of the sole not used.
        foot_moved_ns: how far that edge moved with the foot, which slid or rolled.
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
    def gap_ns(self) -> float:
        """What the entries miss of J."""
        return self.excess_ns - sum(getattr(self, name) for name in ENTRIES)

    @property
    def unexplained_ns(self) -> float:
        """What is wrong with the sum: the gap, or a ZMP beyond the sole if that is more; NaN if anything is."""
        return float(np.maximum(abs(self.gap_ns), self.sole_ns))

    @property
    def adds_up(self) -> bool:
        """Whether that is within 0.5 % of J_cap; NaN never is."""
        return self.unexplained_ns <= TOLERANCE * self.bound_ns

    @property
    def causes(self) -> dict[str, float]:
        """Name of an entry -> N s: those that lift J above J_cap, greatest first.

        Entries within the tolerance are left out, except the greatest.
        """
        found = sorted(((getattr(self, name), name) for name in ENTRIES[1:]), reverse=True)
        least = TOLERANCE * self.bound_ns
        return {name: value for i, (value, name) in enumerate(found) if value > (least if i else 0.0)}


def ledger_of(row: Mapping[str, Any]) -> Ledger:
    """The ledger that a row of a bench table holds: from the entries, so that tables of any age are judged alike."""
    return Ledger(row["bound_ns"] + row["excess_ns"], row["bound_ns"], *(row[name] for name in ENTRIES))


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
    t = history.time_s[after] - history.time_s[after][0]  # a push begins with the first tick at or after its start
    com, force, moment = history.com[after], history.force[after], history.moment_about_com[after]
    offset = com[:, :2] @ normal - bound.offset  # n.x_G - b
    share = force[:, 2] / (mass * omega**2 * com[:, 2])  # s
    turning = np.column_stack((moment[:, 1], -moment[:, 0])) @ normal / (mass * omega**2 * com[:, 2])
    vertical = (1.0 - share) * offset
    edge = (history.sole_corners[after] @ normal).max(axis=1)
    moved = share * (edge - bound.offset)
    sole = history.zmp_load[after] @ normal / (mass * omega**2 * com[:, 2]) - share * edge

    slant = float(normal @ bound.direction)
    kappa = -np.expm1(-omega * bound.duration_s) / (omega * bound.duration_s)
    to_impulse = mass * omega / (kappa * slant)
    weight = np.exp(-omega * t) * -np.expm1(-omega * TIMESTEP_S)  # the exact integral over each tick
    xi = com[:, :2] + history.com_velocity[after][:, :2] / omega
    ends = (normal @ (bound.com - xi[0])) + np.exp(-omega * t[-1]) * (normal @ xi[-1] - bound.offset)
    return Ledger(
        impulse_ns,
        bound.impulse_ns,
        float(to_impulse * (weight @ sole)),
        float(to_impulse * (weight @ moved)),
        float(to_impulse * (weight @ turning)),
        float(to_impulse * (weight @ vertical)),
        float(to_impulse * ends),
    )
