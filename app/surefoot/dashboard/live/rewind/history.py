"""The last 30 s of a run: go back to any tick of it, see it again as it was, or fork it.

Every tenth of a second a checkpoint is kept, and every command that changed the world or the controller is written
into a journal with its tick. Going to an instant means: put back the checkpoint before it and tick on, obeying the
journal at its ticks. Ticks and commands being the same, so is everything that follows, to the bit. The state "at" an
instant is the one after all that was asked for at that instant.

A command given before the newest instant is a fork: what was done to the controller later is forgotten, disturbances
that came later come again (unless that is switched off), and the future is a new one.
"""

import math
from bisect import bisect_left, bisect_right
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from surefoot.dashboard.live.observation.event_log import EventLog
from surefoot.dashboard.messages.command_base import ControlCommand, WorldCommand
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import TimelineView
from surefoot.errors import InvalidInput
from surefoot.simulation.physics import TIMESTEP_S

MOST_ENTRIES = 50_000  # some hours of a restless hand; a journal without end would fill the memory


@dataclass(frozen=True)
class Entry:
    """A command, and after which tick of the run it was obeyed.

    Attributes:
        tick: ticks before it.
        command: as it was given.
        led_to: of a control command, the controller and the changed settings that it led to: undoing says nothing
            to somebody who does not know what was done.
    """

    tick: int
    command: Any
    led_to: tuple[str, Mapping[str, Any]] | None = None

    @property
    def disturbs(self) -> bool:
        """Whether it changes the world, not the controller."""
        return isinstance(self.command, WorldCommand)


@dataclass(frozen=True)
class Note:
    """A line of the log that belongs to an instant, so that it is read again when that instant comes again."""

    kind: EventKind
    text: str


class Journal:
    """What was done and when: enough, with a checkpoint or the start, to run the same future again.

    Entries by tick, those of one tick in the order in which they were given.

    Attributes:
        entries: all of them.
        whole: nothing has been forgotten: from the start on they tell the whole run.
    """

    def __init__(self) -> None:
        self.entries: list[Entry] = []
        self.whole = True

    def write(self, tick: int, command: Any, led_to: tuple[str, Mapping[str, Any]] | None = None) -> None:
        """Add a command after all that were obeyed up to this tick."""
        self.entries.insert(bisect_right(self.entries, tick, key=_tick), Entry(tick, command, led_to))

    def due(self, tick: int) -> list[Entry]:
        """The entries of one tick."""
        start = bisect_left(self.entries, tick, key=_tick)
        return self.entries[start : bisect_right(self.entries, tick, key=_tick, lo=start)]

    def after(self, tick: int) -> list[Entry]:
        """The entries after a tick."""
        return self.entries[bisect_right(self.entries, tick, key=_tick) :]

    def fork(self, tick: int, *, repeat: bool) -> None:
        """Forget what comes after a tick; the disturbances stay when they are to be repeated."""
        kept = [entry for entry in self.after(tick) if repeat and entry.disturbs]
        self.entries = [*self.entries[: bisect_right(self.entries, tick, key=_tick)], *kept]

    def drop(self, entry: Entry) -> None:
        """Forget one entry."""
        self.entries = [other for other in self.entries if other is not entry]

    def forget_before(self, tick: int) -> None:
        """Forget what was obeyed before a tick, when there is too much of it."""
        if len(self.entries) > MOST_ENTRIES:
            self.entries, self.whole = self.entries[bisect_left(self.entries, tick, key=_tick) :], False


def _tick(entry: Entry) -> int:
    return entry.tick


EVERY_TICKS = 100  # between two checkpoints: a seek ticks on by less than this
HISTORY_TICKS = 30_000
_SLACK_S = 0.5 * TIMESTEP_S


@dataclass(frozen=True)
class Replayable:
    """What a history needs of the one whose past it keeps.

    Attributes:
        save_state: a picture of everything that decides the future; InvalidInput when there can be none.
        restore_state: takes such a picture.
        advance: one tick.
        obey: a command, not to be written down again; its failure is told, not raised.
    """

    save_state: Callable[[], Any]
    restore_state: Callable[[Any], None]
    advance: Callable[[], object]
    obey: Callable[[Any], object]


class History:
    """Checkpoints and journal of one run.

    Args:
        replayable: whose past.
        log: where forks are told, and where the marks of the timeline come from.
        repeat: whether disturbances come again after a fork.
    """

    def __init__(self, replayable: Replayable, log: EventLog, *, repeat: bool = True) -> None:
        self.tick = self.newest = 0  # where the run is, and how far it has been
        self.repeat = repeat
        self._seeks = self._sought = 0
        self.journal = Journal()
        self._replayable, self._log = replayable, log
        self._kept: deque[tuple[int, Any]] = deque()
        self._trouble = ""
        self._marks: dict[Event, None] = {}
        log.listener = self._mark
        self._save_state()

    @property
    def oldest(self) -> int:
        """First tick that can be gone to; the present one when nothing is kept."""
        return self._kept[0][0] if self._kept else self.tick

    def ticked(self) -> None:
        """To be called after every tick: keeps a checkpoint when one is due, obeys what was done at this tick."""
        self.tick += 1
        first_time = self.tick > self.newest
        self.newest = max(self.newest, self.tick)
        if self.tick % EVERY_TICKS == 0:
            self._save_state()
        self._obey_journal(first_time=first_time)

    def obeyed(self, command: Any, led_to: tuple[str, Mapping[str, Any]]) -> None:
        """To be called after every command of a user that was obeyed.

        Args:
            command: what was asked for.
            led_to: controller and changed settings that drive now.
        """
        if not isinstance(command, WorldCommand | ControlCommand):
            return
        forked = self.tick < self.newest
        if forked:
            self._fork()
        self.journal.write(self.tick, command, led_to if isinstance(command, ControlCommand) else None)
        if forked:
            coming = sum(entry.disturbs for entry in self.journal.after(self.tick))
            again = f": {coming} later disturbance{'s' * (coming != 1)} will be repeated" if coming else ""
            note = Note(EventKind.FORK, f"forked at {self.tick * TIMESTEP_S:.3f} s{again}")
            self.journal.write(self.tick, note)
            self._obey(note)

    def seek(self, tick: int) -> None:
        """Go to the instant after that many ticks. Raises InvalidInput when it is not kept."""
        if not self._kept:
            raise InvalidInput("seek.time_s", f"{tick * TIMESTEP_S:.3f}", self._trouble or "nothing is kept")
        if not self.oldest <= tick <= self.newest:
            span = f"{self.oldest * TIMESTEP_S:.3f} to {self.newest * TIMESTEP_S:.3f} s"
            raise InvalidInput("seek.time_s", f"{tick * TIMESTEP_S:.3f}", "is not kept", [span])
        start, kept = next((start, kept) for start, kept in reversed(self._kept) if start <= tick)
        if not start <= self.tick <= tick:  # else it is nearer from here
            self._replayable.restore_state(kept)
            self.tick = start
            self._obey_journal(first_time=False)
        while self.tick < tick:
            self._replayable.advance()
            self.ticked()
        self._seeks, self._sought = self._seeks + 1, tick

    def view(self) -> TimelineView:
        """What the page shows of it."""
        coming = self.journal.after(self.newest) if self.repeat else []
        return TimelineView(
            oldest_s=self.oldest * TIMESTEP_S,
            newest_s=self.newest * TIMESTEP_S,
            now_s=self.tick * TIMESTEP_S,
            marks=tuple(self._marks),
            coming_s=tuple(entry.tick * TIMESTEP_S for entry in coming),
            repeat=self.repeat,
            seeks=self._seeks,
            sought_s=self._sought * TIMESTEP_S,
        )

    def _save_state(self) -> None:
        if self._kept and self._kept[-1][0] >= self.tick:
            return
        try:
            self._kept.append((self.tick, self._replayable.save_state()))
        except InvalidInput as error:
            self._give_up(str(error))
            return
        self._trouble = ""
        forgotten = self.newest - HISTORY_TICKS
        while len(self._kept) > 1 and self._kept[1][0] <= forgotten:
            self._kept.popleft()
            self._forget_before(self.oldest)

    def _give_up(self, trouble: str) -> None:
        """Without a checkpoint now, older ones would lead to ever longer ways back."""
        if trouble != self._trouble:
            self._log.add(self.tick * TIMESTEP_S, EventKind.ERROR, f"no rewind for now: {trouble}")
        self._trouble = trouble
        self._kept.clear()
        self._forget_before(self.tick)

    def _forget_before(self, tick: int) -> None:
        self.journal.forget_before(tick)
        self._marks = {mark: None for mark in self._marks if mark.time_s >= tick * TIMESTEP_S}

    def _fork(self) -> None:
        self.journal.fork(self.tick, repeat=self.repeat)
        self.newest = self.tick
        while self._kept[-1][0] > self.tick:
            self._kept.pop()
        now = self.tick * TIMESTEP_S + _SLACK_S
        self._marks = {mark: None for mark in self._marks if mark.time_s <= now}

    def _obey_journal(self, *, first_time: bool) -> None:
        for entry in self.journal.due(self.tick):
            if first_time and entry.disturbs and not self.repeat:
                self.journal.drop(entry)
            else:
                self._obey(entry.command)

    def _obey(self, command: Any) -> None:
        if isinstance(command, Note):
            self._log.add(self.tick * TIMESTEP_S, command.kind, command.text)
        else:
            self._replayable.obey(command)

    def _mark(self, event: Event) -> None:
        if event.kind.marked:  # an event that comes again is equal to itself: one mark
            self._marks[event] = None


def tick_of(time_s: float) -> int:
    """The tick nearest to a time [s]. Raises InvalidInput for what is no number."""
    if not isinstance(time_s, int | float) or not math.isfinite(time_s):
        raise InvalidInput("seek.time_s", time_s, "is not a time", ["seconds since the start of the run"])
    return round(time_s / TIMESTEP_S)
