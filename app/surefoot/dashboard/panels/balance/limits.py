"""How far away each limit is, which one is nearest, and the last push against the capture bound."""

import math

from surefoot.dashboard.messages.limits import Gauge, LimitMargins, PushBound, StepBound
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.number_text import figure

_NAMES = {
    "zmp": ("ZMP to edge", "measured ZMP to the nearest edge of the sole"),
    "dcm": ("DCM to edge", "capture point to the nearest edge of the soles: negative means that no ZMP can hold it"),
    "torque": ("Torque", "what the most loaded motor has left"),
    "joint": ("Joint range", "angle left to the end of the range of the joint that is nearest to it"),
    "friction": ("Friction", "tangential force over what the true friction would bear"),
}
_DIRECTIONS = {
    0: "forward",
    45: "forward left",
    90: "left",
    135: "backward left",
    180: "backward",
    -180: "backward",
    -135: "backward right",
    -90: "right",
    -45: "forward right",
}

_ETA_HELP = "the last push over the capture bound J_cap: above 1 no controller stands it without a step"
_ETA_1_HELP = "the last push over the one-step bound J_cap1: above 1 one step of that reach and time does not catch it"


class HeadroomPanel(Panel):
    """A bar for each limit, and a line about the last push.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        first = context.newest()
        self._html = context.gui.add_html(headroom_html(first.headroom, first.settings.com_damping))

    def show(self, snapshot: Snapshot) -> None:
        """Say how it is now."""
        set_changed(self._html, content=headroom_html(snapshot.headroom, snapshot.settings.com_damping))


def headroom_html(headroom: LimitMargins, com_damping: float) -> str:
    """Bars and push.

    Args:
        headroom: what to show.
        com_damping: K_D of the CoM [1/s], for J_lin.
    """
    nearest = headroom.nearest
    title = f"nearest: {_NAMES[nearest.name][0]}, {nearest.label}" if nearest else "not known yet"
    bars = "".join(_bar(gauge, gauge is nearest) for gauge in headroom.gauges)
    return (
        '<div style="padding:4px 10px;color:inherit;font-size:12px">'
        '<div style="display:flex;gap:8px"><b>Limits</b>'
        f'<span data-nearest style="margin-left:auto">{title}</span></div>'
        f"{bars}{_push(headroom.push, com_damping)}</div>"
    )


def value_text(gauge: Gauge) -> str:
    """What is left, with its unit."""
    if not math.isfinite(gauge.value):
        return "–"
    return f"{figure(gauge.value) if gauge.name == 'torque' else f'{gauge.value:.0f}'} {gauge.unit}"


def push_text(push: PushBound, com_damping: float) -> str:
    """The last push in a line."""
    angle = (push.direction_deg + 180.0) % 360.0 - 180.0
    direction = _DIRECTIONS.get(round(angle), f"{angle:.0f}°")
    where = "" if push.link == "com" else f" at {push.link.replace('_', ' ')} (the bound is for the CoM)"
    return (
        f"J {figure(push.impulse_ns)} N·s {direction} in {1e3 * push.duration_s:.0f} ms{where} · "
        f"J_lin {figure(push.linear_ns(com_damping))} · J_cap {figure(push.bound_ns)} N·s"
    )


def step_text(step: StepBound) -> str:
    """What a step could have caught, and which step."""
    ahead, back, aside = (f"{100.0 * way:.0f}" for way in (step.ahead_m, step.back_m, step.aside_m))
    return (
        f"J_cap1 {figure(step.bound_ns)} N·s: with one step, up to {ahead} cm ahead, {back} back and {aside} aside, "
        f"landing {1e3 * step.landing_s:.0f} ms after the push began"
    )


def _bar(gauge: Gauge, nearest: bool) -> str:
    name, help = _NAMES[gauge.name]
    known = math.isfinite(gauge.used)
    width = 100.0 * min(max(gauge.used, 0.02), 1.0) if known else 0.0
    return (
        f'<div title="{help}" style="display:grid;grid-template-columns:74px 1fr 62px 106px;align-items:center;gap:6px;'
        f'font-weight:{600 if nearest else 400};white-space:nowrap"><span>{name}</span>'
        f'<span style="height:7px;border-radius:4px;background:#8883;overflow:hidden"><span style="display:block;'
        f'height:7px;width:{width:.0f}%;background:{palette.used_colour(gauge.used)}"></span></span>'
        f'<span style="text-align:right;font-variant-numeric:tabular-nums">{value_text(gauge)}</span>'
        f'<span style="opacity:0.75;overflow:hidden;text-overflow:ellipsis" title="{gauge.label}">{gauge.label}</span>'
        "</div>"
    )


def _push(push: PushBound | None, com_damping: float) -> str:
    if push is None:
        return (
            '<div style="opacity:0.7;margin-top:3px">No push yet: η compares the next one with the capture bound.</div>'
        )
    style = "display:flex;gap:8px;align-items:center;margin-top:4px;padding-top:3px;border-top:1px solid #8884"
    without = _share("η", "eta", push.eta, _ETA_HELP)
    told = f'<div style="{style}">{without}<span style="line-height:1.25">{push_text(push, com_damping)}</span></div>'
    if push.step is None or push.eta_1 is None:
        return told
    caught = _share("η<sub>1</sub>", "eta-1", push.eta_1, _ETA_1_HELP)
    return f'{told}<div style="{style}">{caught}<span style="line-height:1.25">{step_text(push.step)}</span></div>'


def _share(name: str, key: str, value: float, help: str) -> str:
    shown = f"{value:.2f}" if math.isfinite(value) else "∞"
    colour = palette.used_colour(value)
    figure = f'<b data-{key} style="font-size:17px;color:{colour}">{shown}</b>'
    return f'<span title="{help}" style="white-space:nowrap">{name} {figure}</span>'
