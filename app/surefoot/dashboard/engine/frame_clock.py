"""When the page's next frame is due, and how long its frames take."""

import time
from dataclasses import dataclass

_WINDOW_S = 1.0


@dataclass(frozen=True)
class PageStatistics:
    """How often the page is brought up to date.

    Attributes:
        frames: scene updates since the start.
        frames_per_second: over the last second or so.
        frame_ms: mean time an update took.
    """

    frames: int
    frames_per_second: float
    frame_ms: float


class FrameClock:
    """Spaces frames evenly; what could not be kept up with is left out, not caught up.

    Attributes:
        statistics: of the frames so far.
    """

    def __init__(self) -> None:
        self.statistics = PageStatistics(0, 0.0, 0.0)
        self._frames = self._window_frames = 0
        self._busy_s = 0.0
        self._window_start = self._due = time.perf_counter()

    def drawn(self, started: float, frame_s: float) -> float:
        """A frame is done; returns how long to wait for the next [s].

        Args:
            started: when it was begun [s], by ``time.perf_counter``.
            frame_s: from one frame to the next.
        """
        now = time.perf_counter()
        self._frames, self._window_frames = self._frames + 1, self._window_frames + 1
        self._busy_s += now - started
        if (span := now - self._window_start) >= _WINDOW_S:
            per_second, mean_ms = self._window_frames / span, 1e3 * self._busy_s / self._window_frames
            self.statistics = PageStatistics(self._frames, per_second, mean_ms)
            self._window_start, self._window_frames, self._busy_s = now, 0, 0.0
        self._due = max(self._due + frame_s, now)
        return self._due - now
