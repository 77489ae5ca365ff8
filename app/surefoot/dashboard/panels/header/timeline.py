"""Back through the last 30 s: scrub, step, and go on from there."""

from typing import Any

import viser

from surefoot.dashboard.messages.commands import GoLive, RepeatDisturbances, Seek, Step
from surefoot.dashboard.messages.snapshot import Snapshot, TimelineView
from surefoot.dashboard.panels.header.timeline_strip import span_of, strip_html
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import Shared, SyncedWidget
from surefoot.dashboard.ui.widget_updates import set_changed

_STEPS = {"-10 ms": -10, "-1 ms": -1, "+1 ms": 1, "+10 ms": 10}
_LIVE = "Live"
_PATIENCE = 12  # pictures that may go by before an unanswered seek is given up
_SAME_S = 6e-4
_LABEL_PX, _EDGE_PX, _BOX_PX = 42, 10, 54  # the slider's track lies between its label and its number box


class TimelinePanel(Panel):
    """A slider, below it a strip of what happened on the same scale, and steps.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._view = first.timeline
        self._asked: float | None = None
        self._waited = 0
        self._line = gui.add_html("")
        start, end = span_of(self._view)
        self._slider = gui.add_slider("t [s]", start, end, 0.001, self._view.now_s, marks=(), hint=(
            "drag to go back; Play shows it again as it was, a change made in the past forks the run"
        ))  # fmt: skip
        self._strip = gui.add_html("")  # below: the slider's tooltip opens above it
        buttons = gui.add_button_group(
            "Go", (*_STEPS, _LIVE), hint="single steps; Live: to the newest instant, and run"
        )
        self._shared = Shared(self._slider)
        self._style = _narrow_labels(self._slider, buttons)
        self._draw(first)

        @self._slider.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(Seek(self._ask(float(event.target.value))))

        @buttons.on_click
        def _(event: viser.GuiEvent) -> None:
            chosen = event.target.value
            send(GoLive() if chosen == _LIVE else Step(_STEPS[chosen]))

    def show(self, snapshot: Snapshot) -> None:
        """Take over where the run is; a slider that is being dragged is left alone until the run has followed."""
        view = self._view = snapshot.timeline
        self._draw(snapshot)
        if self._is_dragged(view):
            return
        start, end = span_of(view)
        if (self._slider.min, self._slider.max) != (start, end):  # the value must lie inside at every moment
            self._slider.min, self._slider.max = min(start, self._slider.min), max(end, self._slider.max)
            self._shared.put(view.now_s)
            self._slider.min, self._slider.max = start, end
        else:
            self._shared.put(view.now_s)

    def _ask(self, value: float) -> float:
        """Remember what a person wants, until the run has followed: a time that is kept."""
        self._waited = 0
        self._asked = wanted = min(max(value, self._view.oldest_s), self._view.newest_s)
        return wanted

    def _is_dragged(self, view: TimelineView) -> bool:
        if self._shared.changed():  # perhaps its callback still waits for a free thread
            self._ask(float(self._shared.value))
        if self._asked is None:
            return False
        self._waited += 1
        if abs(view.now_s - self._asked) < _SAME_S or self._waited > _PATIENCE:
            self._asked = None
        return self._asked is not None

    def _draw(self, snapshot: Snapshot) -> None:
        strip = strip_html(snapshot.timeline, _EDGE_PX + _LABEL_PX, _EDGE_PX + _BOX_PX)
        set_changed(self._line, content=self._style + _line(snapshot))
        set_changed(self._strip, content=strip)


class RepeatSwitch(Panel):
    """Whether disturbances come again after a fork.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._box = gui.add_checkbox("Repeat after a fork", first.timeline.repeat, hint=(
            "after a change made in the past, the stones, pushes and friction that followed come again at their times"
        ))  # fmt: skip

        self._follower = SyncedWidget(self._box)

        @self._box.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                send(RepeatDisturbances(bool(event.target.value)))

    def show(self, snapshot: Snapshot) -> None:
        """Take over what the session does."""
        self._follower.show(snapshot.timeline.repeat)


def _line(snapshot: Snapshot) -> str:
    view = snapshot.timeline
    behind = view.newest_s - view.now_s
    if behind > _SAME_S:
        what = f"<b>{behind:.3f} s back</b>: " + ("as it was" if snapshot.playing else "a change forks")
    else:
        what = "live" if snapshot.playing else "at the newest instant"
    return (
        f'<div style="padding:0 {_EDGE_PX}px;font-size:12px;display:flex;justify-content:space-between;'
        'white-space:nowrap;overflow:hidden">'
        f'<span>Timeline: {what}</span><span style="opacity:0.7">{view.oldest_s:.1f} to {view.newest_s:.1f} s</span>'
        "</div>"
    )


def _narrow_labels(*handles: Any) -> str:
    """A style that gives the room of a long label to the slider; viser has no option for it.

    Should viser change its page, the labels are as wide as all others again.
    """
    rows = ",".join(f'div:has(> p > label[for="{handle._impl.uuid}"])' for handle in handles)
    return f"<style>{rows}{{width:{_LABEL_PX}px !important;padding-right:0 !important}}</style>"
