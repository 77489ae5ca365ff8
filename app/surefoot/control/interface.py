"""What every controller takes and gives: sensing in, one output out."""

from enum import StrEnum
from typing import Protocol

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.record import record
from surefoot.robot.sensing import FootSensing
from surefoot.task.reference import TaskReference


class Status(StrEnum):
    """How a tick's torques came about."""

    SOLVED = "solved"
    HOLDING = "holding"  # infeasible: the last torques are held (the paper's baseline)
    FALLBACK = "fallback"  # the QP failed: inverse dynamics clipped to the torque limits


STATUS_HELP = {
    Status.SOLVED: "every equation of the tick was solved",
    Status.HOLDING: "no contact forces realise the motion asked for: the last torques are held; lower the gains or "
    "the swing, or use two-part",
    Status.FALLBACK: "the QP found no torques: inverse dynamics clipped to the torque limits was used for this tick",
}


@record(kw_only=True)
class ControlOutput:
    """What a tick decided.

    Attributes:
        torques: (15,) joint torques [N m], joint order.
        status: how they came about.
        zmp_wanted_in_world: (2,) ZMP that the tracking law asks for [m].
        zmp_commanded_in_world: (2,) ZMP after guard and margin [m].
        delta_commanded: (3,) delta_P of the commanded q'' about the point P below the stance ankle [N m].
        guard_active: the ZMP was changed by guard or margin.
        guard_relaxed: guard and margin could not both be kept.
        gate_active: the stance sole is rolled, the ZMP is not confined.
        infeasible: a QP of this tick had no solution.
        qp_method: how the QP that gave the torques was solved: ``closed-form`` (no inequality was active), the name of
            a solver, or empty where none was.
    """

    torques: np.ndarray
    status: Status
    zmp_wanted_in_world: np.ndarray
    zmp_commanded_in_world: np.ndarray
    delta_commanded: np.ndarray
    guard_active: bool = False
    guard_relaxed: bool = False
    gate_active: bool = False
    infeasible: bool = False
    qp_method: str = ""


class Controller(Protocol):
    """Anything that turns a state into torques; nothing else in the program knows which one is running."""

    def tick(self, terms: DynamicsTerms, reference: TaskReference, sensing: FootSensing) -> ControlOutput:
        """Decide the torques of one tick."""
        ...

    def reset(self, last_torques: np.ndarray | None = None) -> None:
        """Forget the past; ``last_torques`` (15,) [N m] are those the motors hold now, if any."""
        ...
