"""The timeline as a picture: what is kept, where the run is, and a tick for every event worth one."""

from html import escape

from surefoot.dashboard.messages.snapshot import TimelineView
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.event_style import EVENT_STYLES

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
            ticks.append(_tick(at, EVENT_STYLES[mark.kind].colour, f"{mark.time_s:.3f} s {mark.text}",
                               tall=EVENT_STYLES[mark.kind].tall, faded=mark.time_s > view.now_s))  # fmt: skip
    ticks += [_tick(place(time_s), palette.IDLE, f"{time_s:.3f} s: comes again", tall=False, faded=True)
              for time_s in view.coming_s]  # fmt: skip
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
