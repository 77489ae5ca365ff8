"""What the log tells: one event a line, of one of these kinds."""

from dataclasses import dataclass
from enum import StrEnum


class EventKind(StrEnum):
    """What an event is about. Colours and heights stand in ``ui.palette``."""

    RUN = "run"
    CONTROLLER = "controller"
    STONE = "stone"
    PUSH = "push"
    STEP = "step"
    LIMIT = "limit"
    INFEASIBLE = "infeasible"
    FALL = "fall"
    FORK = "fork"
    DIVERGENCE = "divergence"
    ERROR = "error"

    @property
    def marked(self) -> bool:
        """Whether the timeline has a mark for it."""
        return self not in (EventKind.RUN, EventKind.ERROR)

    @property
    def disturbs(self) -> bool:
        """Whether two robots may go apart because of it."""
        return self in (EventKind.STONE, EventKind.PUSH, EventKind.CONTROLLER)

    @property
    def logged_of_twin(self) -> bool:
        """Whether the first robot's log has it of the twin too."""
        return self in (
            EventKind.FALL,
            EventKind.LIMIT,
            EventKind.INFEASIBLE,
            EventKind.ERROR,
            EventKind.CONTROLLER,
        )


@dataclass(frozen=True)
class Event:
    """One line of the log.

    Attributes:
        time_s: simulated time.
        kind: what it is about.
        text: what happened.
    """

    time_s: float
    kind: EventKind
    text: str
