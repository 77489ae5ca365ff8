"""The log, newest first, and the buttons that go from event to event."""

from collections.abc import Callable
from html import escape

from surefoot.dashboard.messages.commands import Seek
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import Snapshot, TimelineView
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.palette import EVENT_STYLES

_SHOWN = 40
_HEIGHT_PX = 150  # the rest scrolls


class EventsPanel(Panel):
    """A line per event.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._events: tuple[Event, ...] = ()
        self._html = context.gui.add_html(self._text())

    def show(self, snapshot: Snapshot) -> None:
        """Take over the log."""
        if snapshot.events is not self._events:
            self._events = snapshot.events
            self._html.content = self._text()

    def _text(self) -> str:
        lines = "".join(_line(event) for event in self._events[:_SHOWN])
        return (
            f'<div role="log" aria-label="Events" style="height:{_HEIGHT_PX}px;overflow-y:auto;font-size:12px;'
            f'line-height:1.35;padding:2px 8px;color:inherit">{lines}</div>'
        )


def _line(event: Event) -> str:
    colour = EVENT_STYLES[event.kind].colour
    weight = "600" if event.kind is EventKind.FALL else "400"
    return (
        f'<div style="border-left:4px solid {colour};padding-left:6px;margin:3px 0;font-weight:{weight}">'
        f'<span style="opacity:0.7">{event.time_s:.2f} s</span> {escape(event.text)}</div>'
    )


_BEFORE, _NEXT = "◀ event before", "next event ▶"
_SAME_S = 6e-4
_TOGETHER_S = 0.2  # a dragged slider, or a foot that loses its hold bit by bit, is one stop


def add_event_steps(context: PageContext) -> None:
    """Add two buttons and two keys."""
    gui = context.gui
    hint = "go to the instant of a stone, push, limit, change or fall of the last 30 s, and stand still there"
    buttons = gui.add_button_group("Go to", (_BEFORE, _NEXT), hint=f"{hint}. Keys: J = before, K = next")
    steps = {_BEFORE: event_before, _NEXT: event_after}

    def go(where: Callable[[TimelineView], float | None]) -> None:
        if (time_s := where(context.newest().timeline)) is not None:
            context.send(Seek(time_s))

    buttons.on_click(lambda event: go(steps[event.target.value]))
    before = gui.add_command("Event before", description=hint, hotkey="J")
    following = gui.add_command("Next event", description=hint, hotkey="K")
    before.on_trigger(lambda _: go(event_before))
    following.on_trigger(lambda _: go(event_after))


def stops(view: TimelineView) -> list[float]:
    """Instants [s] of the kept events, ascending; those of one kind that follow each other closely are one."""
    found: list[float] = []
    latest: dict[str, float] = {}
    for mark in sorted(view.marks, key=lambda mark: mark.time_s):
        if not view.oldest_s <= mark.time_s <= view.newest_s:
            continue
        close = mark.time_s - latest.get(mark.kind, float("-inf")) < _TOGETHER_S
        latest[mark.kind] = mark.time_s
        if not close and not (found and mark.time_s - found[-1] < _SAME_S):
            found.append(mark.time_s)
    return found


def event_before(view: TimelineView) -> float | None:
    """The stop before now [s], if there is one."""
    return next((time_s for time_s in reversed(stops(view)) if time_s < view.now_s - _SAME_S), None)


def event_after(view: TimelineView) -> float | None:
    """The stop after now [s], if there is one."""
    return next((time_s for time_s in stops(view) if time_s > view.now_s + _SAME_S), None)
