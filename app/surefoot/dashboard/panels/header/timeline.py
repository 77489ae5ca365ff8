"""Back through the last 30 s: scrub, step, and go on from there; with the strip that shows what is kept."""

from html import escape
from typing import Any

import viser

from surefoot.dashboard.messages.commands import GoLive, RepeatDisturbances, Seek, Step
from surefoot.dashboard.messages.snapshot import Snapshot, TimelineView
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.palette import EVENT_STYLES
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_slider
from surefoot.dashboard.ui.synced_widget import Shared, SyncedWidget, set_changed

_SHORTEST_S = 2.0  # a run that has just begun is not stretched over the whole strip


def span_of(view: TimelineView) -> tuple[float, float]:
    """First and last instant [s] that the timeline reaches over, disturbances still to come included."""
    return view.oldest_s, max(view.newest_s, view.oldest_s + _SHORTEST_S, *view.coming_s)


def strip_html(view: TimelineView, left_px: int = 10, right_px: int = 10) -> str:
    """A bar as wide as its place but for margins: kept past filled, ticks in their colours, the present as a line."""
    start, end = span_of(view)

    def place(time_s: float) -> float:
        return 100.0 * (min(max(time_s, start), end) - start) / (end - start)

    ticks, seen = [], set()
    for mark in view.marks:
        at = round(place(mark.time_s), 1)
        if (at, mark.kind) not in seen:  # a dragged slider leaves hundreds at one place
            seen.add((at, mark.kind))
            ticks.append(
                _tick(
                    at,
                    EVENT_STYLES[mark.kind].colour,
                    f"{mark.time_s:.3f} s {mark.text}",
                    tall=EVENT_STYLES[mark.kind].tall,
                    faded=mark.time_s > view.now_s,
                )
            )
    ticks += [
        _tick(place(time_s), palette.IDLE, f"{time_s:.3f} s: comes again", tall=False, faded=True)
        for time_s in view.coming_s
    ]
    now = place(view.now_s)
    return (
        '<div role="img" aria-label="Timeline" style="position:relative;height:16px;border-radius:4px;'
        f'margin:0 {right_px}px 6px {left_px}px;background:rgba(128,128,128,0.18)">'
        f'<div style="position:absolute;left:0;width:{place(view.newest_s):.1f}%;top:6px;height:4px;border-radius:2px;'
        'background:rgba(128,128,128,0.45)"></div>'
        f'<div style="position:absolute;left:0;width:{now:.1f}%;top:6px;height:4px;border-radius:2px;'
        f'background:{palette.css(palette.FORCE)}"></div>'
        f'{"".join(ticks)}<div style="position:absolute;left:calc({now:.1f}% - 1px);top:0;width:2px;height:16px;'
        'background:currentColor"></div></div>'
    )


def _tick(at: float, colour: str, title: str, *, tall: bool, faded: bool) -> str:
    top, height, width = (0, 16, 4) if tall else (3, 10, 3)
    return (
        f'<div title="{escape(title)}" style="position:absolute;left:calc({at:.1f}% - {width / 2}px);top:{top}px;'
        f'width:{width}px;height:{height}px;background:{colour};opacity:{0.55 if faded else 1}"></div>'
    )


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
        self._seeks_before = self._waited = 0
        self._line = gui.add_html("")
        start, end = span_of(self._view)
        self._slider = add_slider(
            gui,
            "t [s]",
            start,
            end,
            0.001,
            self._view.now_s,
            marks=(),
            hint=("drag to go back; Play shows it again as it was, a change made in the past forks the run"),
        )
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
        view = snapshot.timeline
        self._draw(snapshot)
        dragged = self._is_dragged(view)
        self._view = view  # not before: a change that is first seen now may already have been obeyed in this picture
        if dragged:
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
        self._waited, self._seeks_before = 0, self._view.seeks
        self._asked = wanted = min(max(value, self._view.oldest_s), self._view.newest_s)
        return wanted

    def _is_dragged(self, view: TimelineView) -> bool:
        if self._shared.changed():  # perhaps its callback still waits for a free thread
            self._ask(float(self._shared.value))
        if self._asked is None:
            return False
        self._waited += 1
        # a run that was played on at once is seen past the instant; it must not leave the widget there, for viser
        # takes the same number, typed once more, for no change
        followed = view.seeks != self._seeks_before and abs(view.sought_s - self._asked) < _SAME_S
        if followed or abs(view.now_s - self._asked) < _SAME_S or self._waited > _PATIENCE:
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
        self._box = gui.add_checkbox(
            "Repeat after a fork",
            first.timeline.repeat,
            hint=(
                "after a change made in the past, the stones, pushes and friction that followed "
                "come again at their times"
            ),
        )

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
