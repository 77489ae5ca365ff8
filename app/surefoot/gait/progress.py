"""How far a walk has come."""

from dataclasses import dataclass
from enum import StrEnum

from surefoot.gait.footsteps import Pace


class Phase(StrEnum):
    """What a walk is doing."""

    WAITING = "waiting"
    DOUBLE = "double support"
    SINGLE = "single support"
    STANDING = "standing"


PHASE_HELP = {
    Phase.WAITING: "on two feet, before its start",
    Phase.DOUBLE: "on two feet: the weight shifts",
    Phase.SINGLE: "one foot stands, the other swings",
    Phase.STANDING: "on two feet, after its last step",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Progress:
    """How far a walk has come.

    Attributes:
        phase: what it is doing.
        alone: the foot that stands alone: 0 left, 1 right; None where both do.
        made: steps that have landed.
        planned: steps in all.
        left_s: until the phase should end [s], negative where it should have ended; None where nobody knows.
        pace: of the steps to come, where they can be steered.
    """

    phase: Phase
    alone: int | None
    made: int
    planned: int
    left_s: float | None = None
    pace: Pace | None = None
