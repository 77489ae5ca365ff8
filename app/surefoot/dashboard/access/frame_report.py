"""What a page says about itself: how long its frames take, whether it is seen, and which tabs are open."""

import math
from dataclasses import dataclass
from urllib.parse import parse_qs

from surefoot.errors import InvalidInput

REPORT = "/frame-lateness"
LONGEST_FRAME_MS = 10_000.0
_LONGEST_PATH, _MOST_TABS = 1000, 20


@dataclass(frozen=True)
class FrameReport:
    """One report.

    Attributes:
        key: tells which page it is.
        frame_s: median time between two frames [s], 0 or more.
        hidden: nobody sees the page.
        open_tabs: labels of the tabs that are open.
    """

    key: str
    frame_s: float
    hidden: bool = False
    open_tabs: frozenset[str] = frozenset()


def is_report(path: str) -> bool:
    """Whether a request is one."""
    return path.partition("?")[0] == REPORT


def read_report(path: str) -> FrameReport:
    """The report in a request's path.

    Raises:
        InvalidInput: it is too long, or the time is no finite number from 0 to ``LONGEST_FRAME_MS``.
    """
    if len(path) > _LONGEST_PATH:
        raise InvalidInput("report", f"{len(path)} characters", "is too long", [f"up to {_LONGEST_PATH}"])
    given = {name: values[0] for name, values in parse_qs(path.partition("?")[2]).items()}
    text = given.get("frame_ms", "")
    try:
        frame_ms = float(text)
    except ValueError:
        frame_ms = math.nan
    if not 0.0 <= frame_ms <= LONGEST_FRAME_MS:
        raise InvalidInput("frame_ms", text[:40], "must be a number", [f"0 to {LONGEST_FRAME_MS:g}"])
    tabs = frozenset(given.get("open", "").split(",")[:_MOST_TABS]) - {""}
    return FrameReport(given.get("key", ""), 1e-3 * frame_ms, given.get("hidden") == "1", tabs)
