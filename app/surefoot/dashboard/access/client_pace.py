"""How much one page is sent, from what it says about its frames: plots give way first, then the scene."""

from dataclasses import dataclass

from surefoot.dashboard.access.frame_report import FrameReport

# Time between frames [s] from which a page counts as slow, up to which as fast: a graphics card takes 0.017 s, software
# on two shared cores 0.2 to 0.8 s (static/help/performance.md)
LATE_S, IN_TIME_S = 0.1, 0.04
_LEAST_BETWEEN_S = 0.2  # reports that come faster do not change the level


@dataclass(frozen=True)
class Level:
    """What a page is sent.

    Attributes:
        plots_s: least time between two updates of a plot [s].
        rest_s: pause after each thing sent [s]; what changes meanwhile is sent once.
    """

    plots_s: float
    rest_s: float


LEVELS = (Level(0.0, 0.0), Level(0.25, 0.0), Level(0.5, 0.0), Level(1.0, 0.05), Level(2.0, 0.15))
_HIDDEN_REST_S = 1.0


class ClientPace:
    """One page's pace. A page that says nothing is sent everything."""

    def __init__(self) -> None:
        self._level, self._changed_s = 0, -_LEAST_BETWEEN_S
        self._last: FrameReport | None = None

    def take(self, report: FrameReport, now_s: float) -> None:
        """Take a report: a late page goes down one level, one in time comes back up by one."""
        self._last = report
        if report.hidden or now_s - self._changed_s < _LEAST_BETWEEN_S:
            return
        step = (report.frame_s > LATE_S) - (report.frame_s < IN_TIME_S)
        self._level = min(max(self._level + step, 0), len(LEVELS) - 1)
        self._changed_s = now_s

    @property
    def rest_s(self) -> float:
        """Pause after each thing sent [s]."""
        return _HIDDEN_REST_S if self._last is not None and self._last.hidden else LEVELS[self._level].rest_s

    @property
    def plots_s(self) -> float:
        """Least time between two updates of a plot [s]."""
        return LEVELS[self._level].plots_s

    def sees(self, tab: str) -> bool:
        """Whether what is in that tab is seen; of a page that names no tab at all, it may be."""
        last = self._last
        return last is None or (not last.hidden and (not last.open_tabs or tab in last.open_tabs))
