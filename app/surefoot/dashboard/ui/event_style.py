"""How events look, in the log, on the timeline and on the twin's strip alike."""

from typing import NamedTuple

from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.ui import palette


class EventStyle(NamedTuple):
    """CSS colour, and whether its mark on the timeline is a tall one."""

    colour: str
    tall: bool = False


EVENT_STYLES = {
    EventKind.RUN: EventStyle(palette.IDLE),
    EventKind.CONTROLLER: EventStyle(palette.GOOD),
    EventKind.STONE: EventStyle(palette.css(palette.STONE)),
    EventKind.PUSH: EventStyle(palette.css(palette.FORCE)),
    EventKind.LIMIT: EventStyle(palette.css(palette.COM)),
    EventKind.INFEASIBLE: EventStyle(palette.WARN),
    EventKind.FALL: EventStyle(palette.BAD, tall=True),
    EventKind.FORK: EventStyle(palette.FORK, tall=True),
    EventKind.DIVERGENCE: EventStyle(palette.DIVERGENCE, tall=True),
    EventKind.ERROR: EventStyle(palette.BAD),
}
