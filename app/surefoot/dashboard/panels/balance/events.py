"""The log, newest first."""

from html import escape

from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.ui.event_style import EVENT_STYLES

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
