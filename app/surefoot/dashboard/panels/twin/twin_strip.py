"""The shared timeline of a twin run: what was done to both, where they went apart, who fell when and why."""

from html import escape

from surefoot.dashboard.messages.snapshot import DIVERGED_M, Divergence, Snapshot, TwinView
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.palette import EVENT_STYLES

_WIDTH, _HEIGHT, _LEFT, _RIGHT = 300.0, 74.0, 6.0, 294.0
_LANES = (30.0, 48.0)
_SHORTEST_S, _BEFORE_S, _AFTER_S = 4.0, 1.0, 3.0  # what is shown: around what was done and the falls


def divergence_text(divergence: Divergence | None) -> str:
    """The first divergence in a line."""
    if divergence is None:
        return f"no divergence yet: the two CoMs are less than {1e3 * DIVERGED_M:g} mm apart"
    after = divergence.after
    since = f", {divergence.time_s - after.time_s:.2f} s after: {after.text}" if after else ""
    return f"first divergence (CoMs more than {1e3 * DIVERGED_M:g} mm apart) at {divergence.time_s:.3f} s{since}"


def verdict_text(robot: Snapshot) -> str:
    """Whether one robot stands, or why it fell, in a line."""
    return robot.balance.fall_text or f"stands, {robot.balance.status}"


def strip_html(first: Snapshot) -> str:
    """Timeline and texts of the twin run of a snapshot."""
    twin = first.twin
    if twin is None or twin.other is None:
        return _box("<i>the twin is being prepared …</i>" if twin else "<i>no twin run</i>")
    other = twin.other
    now = max(first.time_s, other.time_s)
    start, end = _span(twin, now, [robot.balance.fall_time_s for robot in (first, other)])

    def at(time_s: float) -> float:
        return _LEFT + (_RIGHT - _LEFT) * min(max((time_s - start) / (end - start), 0.0), 1.0)

    parts = [
        f'<rect x="{at(mark.time_s) - 1:.1f}" y="14" width="2" height="44" fill="{EVENT_STYLES[mark.kind].colour}">'
        f"<title>{mark.time_s:.2f} s: {escape(mark.text)}</title></rect>"
        for mark in twin.marks
    ]
    for robot, y, colour in ((first, _LANES[0], palette.FIRST), (other, _LANES[1], palette.TWIN)):
        fell = robot.balance.fall_time_s
        x = at(now if fell is None else fell)
        parts.append(
            f'<line x1="{_LEFT}" y1="{y}" x2="{x:.1f}" y2="{y}" stroke="{palette.css(colour)}" '
            'stroke-width="5" stroke-linecap="round"/>'
        )
        if fell is not None:
            parts.append(
                f'<path d="M{x - 5:.1f} {y - 5} l10 10 m0 -10 l-10 10" stroke="{palette.BAD}" '
                f'stroke-width="3"><title>fell at {fell:.2f} s</title></path>'
            )
    if twin.divergence is not None:
        x = at(twin.divergence.time_s)
        anchor = "start" if x < 0.6 * _WIDTH else "end"
        shift = 4 if anchor == "start" else -4
        parts.append(
            f'<line x1="{x:.1f}" y1="4" x2="{x:.1f}" y2="60" stroke="{palette.BAD}" stroke-width="1.5" '
            f'stroke-dasharray="3 2"/><text x="{x + shift:.1f}" y="12" text-anchor="{anchor}" '
            f'font-size="10" fill="currentColor">apart {twin.divergence.time_s:.2f} s</text>'
        )
    for x, anchor, time_s in ((_LEFT, "start", start), (_RIGHT, "end", end)):
        parts.append(
            f'<text x="{x}" y="71" font-size="10" text-anchor="{anchor}" fill="currentColor">{time_s:.1f} s</text>'
        )
    svg = (
        f'<svg viewBox="0 0 {_WIDTH:.0f} {_HEIGHT:.0f}" width="100%" role="img" aria-label="Timeline of the twin run">'
        f"{''.join(parts)}</svg>"
    )
    lines = "".join(
        (
            _line(palette.BAD, "", divergence_text(twin.divergence)),
            _line(palette.css(palette.FIRST), f"first · {first.controller}", verdict_text(first)),
            _line(palette.css(palette.TWIN), f"twin · {other.controller}", verdict_text(other)),
        )
    )
    return _box(svg + lines)


def _span(twin: TwinView, now: float, falls: list[float | None]) -> tuple[float, float]:
    """First and last second shown."""
    times = [mark.time_s for mark in twin.marks] + ([twin.divergence.time_s] if twin.divergence else [])
    start = max(0.0, min(times) - _BEFORE_S) if times else 0.0
    last = max((fell for fell in falls if fell is not None), default=None)
    end = now if last is None else min(now, last + _AFTER_S)
    return start, max(end, start + _SHORTEST_S)


def _box(content: str) -> str:
    return f'<div aria-label="Twin run" style="padding:2px 10px;font-size:12px;color:inherit">{content}</div>'


def _line(colour: str, who: str, text: str) -> str:
    name = f"<b>{escape(who)}</b>: " if who else ""
    return (
        f'<div style="border-left:4px solid {colour};padding-left:6px;margin:3px 0;line-height:1.35">'
        f"{name}{escape(text)}</div>"
    )
