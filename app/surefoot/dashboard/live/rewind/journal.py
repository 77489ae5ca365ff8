"""What the user changed and when: enough, with a checkpoint or the start, to run the same future again."""

from bisect import bisect_left, bisect_right
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from surefoot.dashboard.messages.command_base import WorldCommand
from surefoot.dashboard.messages.events import EventKind

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
    """Entries by tick, those of one tick in the order in which they were given.

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
