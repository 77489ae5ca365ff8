"""How far a walk has come."""

from dataclasses import dataclass
from enum import StrEnum


class Phase(StrEnum):
    """What a walk is doing."""

    WAITING = "waiting"  # on two feet, before its start
    DOUBLE = "double support"  # the weight shifts
    SINGLE = "single support"  # one foot stands, the other swings
    STANDING = "standing"  # on two feet, after its last step


@dataclass(frozen=True, slots=True, kw_only=True)
class Progress:
    """How far a walk has come.

    Attributes:
        phase: what it is doing.
        alone: the foot that stands alone: 0 left, 1 right; None where both do.
        made: steps that have landed.
        planned: steps in all.
    """

    phase: Phase
    alone: int | None
    made: int
    planned: int
