"""Colours of what is drawn, one each for scene, plots and legend (Okabe and Ito: told apart by colour-blind eyes).

And how each kind of event looks, in the log, on the timeline and on the twin's strip alike.
"""

from typing import NamedTuple

from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.ui import palette

Rgb = tuple[int, int, int]

ZMP_MEASURED: Rgb = (213, 94, 0)
ZMP_COMMANDED: Rgb = (230, 159, 0)
COM: Rgb = (204, 121, 167)
CAPTURE: Rgb = (0, 158, 115)
REGION_EDGE: Rgb = (0, 84, 61)  # of K_0, in the regions' green
FORCE: Rgb = (0, 114, 178)
POLYGON: Rgb = (86, 180, 233)
SOLE: Rgb = (80, 110, 200)
LEFT_FOOT: Rgb = (0, 128, 128)  # teal and wine: one is clearly darker too
RIGHT_FOOT: Rgb = (136, 34, 85)
LIMIT: Rgb = (130, 130, 130)
STONE: Rgb = (120, 96, 72)
FIRST: Rgb = (217, 119, 6)  # the first robot and its twin, where the two are compared
TWIN: Rgb = (124, 58, 237)
BELIEVED: Rgb = (0, 172, 193)  # the robot as an estimator has it
PREVIEW: Rgb = (230, 159, 0)

GOOD, WARN, BAD, IDLE = "#009e73", "#e69f00", "#d55e00", "#888888"
FORK, DIVERGENCE = "#7048e8", "#c2255c"

MARGIN_GOOD_M, MARGIN_BAD_M = 0.020, 0.005


def margin_colour(margin_m: float) -> str:
    """Green, amber or red for a distance [m] to an edge; grey where it is not known."""
    if margin_m != margin_m:
        return IDLE
    return GOOD if margin_m >= MARGIN_GOOD_M else WARN if margin_m >= MARGIN_BAD_M else BAD


def used_colour(used: float) -> str:
    """Green, amber or red for the share of a limit that is used; grey where it is not known."""
    if used != used:
        return IDLE
    return GOOD if used < 0.7 else WARN if used < 0.9 else BAD


def css(colour: Rgb) -> str:
    """As CSS writes it."""
    return f"rgb({colour[0]}, {colour[1]}, {colour[2]})"


class EventStyle(NamedTuple):
    """CSS colour, and whether its mark on the timeline is a tall one."""

    colour: str
    tall: bool = False


EVENT_STYLES = {
    EventKind.RUN: EventStyle(palette.IDLE),
    EventKind.CONTROLLER: EventStyle(palette.GOOD),
    EventKind.STONE: EventStyle(palette.css(palette.STONE)),
    EventKind.PUSH: EventStyle(palette.css(palette.FORCE)),
    EventKind.STEP: EventStyle(palette.css(palette.LIMIT)),
    EventKind.LIMIT: EventStyle(palette.css(palette.COM)),
    EventKind.INFEASIBLE: EventStyle(palette.WARN),
    EventKind.FALL: EventStyle(palette.BAD, tall=True),
    EventKind.FORK: EventStyle(palette.FORK, tall=True),
    EventKind.DIVERGENCE: EventStyle(palette.DIVERGENCE, tall=True),
    EventKind.ERROR: EventStyle(palette.BAD),
}
