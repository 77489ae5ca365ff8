"""The log, and what turns ticks into its events."""

from collections import deque
from collections.abc import Callable
from typing import Any, NamedTuple

from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.gait.footsteps import Footstep
from surefoot.gait.interface import Gait
from surefoot.simulation.event_texts import fall_text, limit_text, step_text
from surefoot.simulation.falls import LIMITS
from surefoot.simulation.loop import Simulation, TickResult

LOG_LENGTH = 60
_QUIET_S = 0.1  # infeasible ticks closer than this belong to one stretch


class LogLine(NamedTuple):
    """What a command has to say; it takes the place of the newest line of the same topic."""

    kind: EventKind
    text: str
    topic: str = ""


class EventLog:
    """The last events, newest first.

    Attributes:
        listener: called with every new event.
    """

    def __init__(self) -> None:
        self.listener: Callable[[Event], None] | None = None
        self._events: deque[Event] = deque(maxlen=LOG_LENGTH)
        self._frozen: tuple[Event, ...] = ()
        self._topic = ""

    def add(self, time_s: float, kind: EventKind, text: str, *, topic: str = "") -> None:
        """Write one line; it takes the place of the newest one if that has the same topic (a slider being dragged)."""
        if topic and topic == self._topic:
            self._events.popleft()
        self._topic = topic
        event = Event(time_s, kind, text)
        self._events.appendleft(event)
        self._frozen = tuple(self._events)
        if self.listener is not None:
            self.listener(event)

    @property
    def events(self) -> tuple[Event, ...]:
        """All lines, newest first."""
        return self._frozen

    def save_state(self) -> tuple[tuple[Event, ...], str]:
        """The lines as they are now, for ``restore_state``."""
        return self._frozen, self._topic

    def restore_state(self, kept: tuple[tuple[Event, ...], str]) -> None:
        """Restore the saved lines."""
        self._frozen, self._topic = kept
        self._events = deque(self._frozen, maxlen=LOG_LENGTH)


class TickMonitor:
    """Notices what a tick brought: limits, steps, stretches without a QP solution, the fall.

    Args:
        log: where to write.
    """

    def __init__(self, log: EventLog) -> None:
        self._log = log
        self._since: float | None = None
        self._latest = 0.0
        self._fallen = False
        self._error: str | None = None
        self._next: tuple[int, Footstep] | None = None  # steps made before it, and the next one

    def observe(self, simulation: Simulation, result: TickResult) -> None:
        """Take one tick in."""
        now = simulation.time_s
        for limit in result.limits:
            if limit.name != "qp_infeasible":
                self._log.add(limit.time_s, EventKind.LIMIT, limit_text(limit.name))
        if result.output is not None:
            self._infeasible(now, result.output.infeasible)
        if simulation.gait is not None:
            self._step(now, simulation.gait)
        if simulation.fallen and not self._fallen:
            self._log.add(simulation.fall_time_s or now, EventKind.FALL, fall_text(simulation))
        elif simulation.error and not self._error:  # it lay on the ground already
            self._log.add(now, EventKind.ERROR, simulation.error)
        self._fallen, self._error = simulation.fallen is not None, simulation.error

    def save_state(self) -> dict[str, Any]:
        """What it has noticed so far, for ``restore_state``."""
        return dict(vars(self))

    def restore_state(self, kept: dict[str, Any]) -> None:
        """Restore what it had noticed."""
        vars(self).update(kept)

    def _step(self, now: float, gait: Gait) -> None:
        progress, ahead = gait.progress, gait.steps_ahead
        if self._next is not None and progress.made > self._next[0]:
            self._log.add(now, EventKind.STEP, step_text(self._next[1], progress.made, progress.planned))
        self._next = (progress.made, ahead[0]) if ahead else None

    def _infeasible(self, now: float, infeasible: bool) -> None:
        if infeasible:
            if self._since is None:
                self._since = now
                self._log.add(now, EventKind.INFEASIBLE, f"qp_infeasible from {now:.3f} s: {LIMITS['qp_infeasible']}")
            self._latest = now
        elif self._since is not None and now - self._latest > _QUIET_S:
            self._log.add(now, EventKind.INFEASIBLE, f"qp_infeasible from {self._since:.3f} to {self._latest:.3f} s")
            self._since = None
