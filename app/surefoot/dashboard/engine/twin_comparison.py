"""Two robots under the same disturbances, tick by tick: how far apart, since when, and after what."""

from collections import deque

import numpy as np

from surefoot.dashboard.messages.events import Event
from surefoot.dashboard.messages.signals import COM, COMPARED, TIME, TWIN_COLUMNS, TWIN_SIGNALS
from surefoot.dashboard.messages.snapshot import DIVERGED_M, Divergence
from surefoot.simulation.physics import TIMESTEP_S

ROW_EVERY_TICKS = 25
_ROWS = 320  # 8 s
_MARKS = 200
_TIME = COMPARED.index(TIME)
_ROW_TIME = TWIN_COLUMNS.index("time_s")
_COM = [COMPARED.index(name) for name in COM]


class Comparison:
    """Fed with rows of ``COMPARED`` of both robots; what lies ahead is forgotten when time goes back."""

    def __init__(self) -> None:
        self.divergence: Divergence | None = None
        self._rows: deque[np.ndarray] = deque(maxlen=_ROWS)
        self._table = np.empty((0, len(TWIN_COLUMNS)))
        self._marks: deque[Event] = deque(maxlen=_MARKS)
        self._latest_s = -1.0
        self._stale = False

    @property
    def marks(self) -> tuple[Event, ...]:
        """What was done to both in this run, oldest first."""
        return tuple(self._marks)

    def table(self) -> np.ndarray:
        """(n, len(TWIN_COLUMNS)) every 25th tick of the last seconds, oldest first; the same object until it grows."""
        if self._stale:
            self._table = np.array(self._rows) if self._rows else np.empty((0, len(TWIN_COLUMNS)))
            self._stale = False
        return self._table

    def note(self, event: Event) -> None:
        """Remember what was done to both."""
        if event.kind.disturbs and event not in self._marks:  # a past that is seen again tells it again
            self._marks.append(event)

    def _go_back(self, time_s: float) -> None:
        while self._rows and self._rows[-1][_ROW_TIME] >= time_s:
            self._rows.pop()
            self._stale = True
        while self._marks and self._marks[-1].time_s > time_s:
            self._marks.pop()
        if self.divergence is not None and self.divergence.time_s >= time_s:
            self.divergence = None

    def add(self, first: np.ndarray, twin: np.ndarray) -> None:
        """The newest ticks of both; once one has been shown to its end there is nothing left to compare."""
        both = min(len(first), len(twin))
        if not both:
            return
        first, twin = first[:both], twin[:both]
        if first[0, _TIME] <= self._latest_s:
            self._go_back(float(first[0, _TIME]))
        self._latest_s = float(first[-1, _TIME])
        if self.divergence is None:
            self._look(first, twin)
        ticks = np.rint(first[:, _TIME] / TIMESTEP_S).astype(int)
        for i in np.flatnonzero(ticks % ROW_EVERY_TICKS == 0):
            self._rows.append(_row(first[i], twin[i]))
            self._stale = True

    def _look(self, first: np.ndarray, twin: np.ndarray) -> None:
        distance = np.linalg.norm(twin[:, _COM] - first[:, _COM], axis=1)
        apart = np.flatnonzero(distance > DIVERGED_M)
        if len(apart):
            i = apart[0]
            time_s = float(first[i, _TIME])
            after = next((mark for mark in reversed(self._marks) if mark.time_s <= time_s), None)
            self.divergence = Divergence(time_s=time_s, distance_mm=1e3 * float(distance[i]), after=after)


def _row(first: np.ndarray, twin: np.ndarray) -> np.ndarray:
    """A row of ``TWIN_COLUMNS`` from one of ``COMPARED`` of each."""
    ticks = dict(zip(COMPARED, first, strict=True)), dict(zip(COMPARED, twin, strict=True))
    return np.array([signal.extract(*ticks) for signal in TWIN_SIGNALS])
