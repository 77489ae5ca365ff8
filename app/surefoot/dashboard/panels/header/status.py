"""Lamp, flags, time, real-time factor; and what appears when the robot has fallen: why, and the way back."""

import math
from collections.abc import Callable
from html import escape

import viser

from surefoot.dashboard.messages.commands import Reset, Seek
from surefoot.dashboard.messages.snapshot import LOADED_N, Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_widgets import Send
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.gait.progress import PHASE_HELP, Progress
from surefoot.number_text import fixed
from surefoot.resources import logo

_LAMPS = {"solved": palette.GOOD, "holding": palette.BAD, "fallback": palette.WARN}
_SLOW = 0.95


class StatusPanel(Panel):
    """What a glance should tell.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._logo = logo()
        self._html = context.gui.add_html(self._text(context.newest()))

    def show(self, snapshot: Snapshot) -> None:
        """Say how it is now."""
        set_changed(self._html, content=self._text(snapshot))

    def _text(self, snapshot: Snapshot) -> str:
        balance = snapshot.balance
        word, colour = balance.status, _LAMPS.get(balance.status, palette.IDLE)
        if balance.fall_cause:
            word, colour = f"fallen: {balance.fall_cause}", palette.BAD
        flags = "".join(
            (
                _flag("guard", balance.guard_active, "the capture guard or the margin changed the commanded ZMP"),
                _flag("gate", balance.gate_active, "the stance sole is rolled: it stands on a stone"),
                _flag("QP infeasible", balance.infeasible, "a QP of this tick has no solution"),
            )
        )
        return (
            f'<div style="padding:4px 10px;font-size:13px;line-height:1.5;color:inherit">'
            f'<div style="display:flex;align-items:center;gap:8px">{self._logo}'
            f'<span style="width:12px;height:12px;border-radius:6px;background:{colour};flex:none" '
            f'title="{escape(balance.status_help)}"></span><b title="{escape(balance.status_help)}">{escape(word)}</b>'
            f'<span style="margin-left:auto" title="simulated time">{"" if snapshot.playing else "paused · "}'
            f"{snapshot.time_s:.1f} s</span></div>"
            f'<div style="display:flex;align-items:center;gap:6px">{flags}</div>'
            f"<div>{_figures(snapshot)}</div>{_walk(snapshot)}</div>"
        )


def _walk(snapshot: Snapshot) -> str:
    return walk_html(snapshot.walk, snapshot.balance.foot_forces_n, LOADED_N * snapshot.robot.weight)


def _flag(name: str, active: bool, help: str) -> str:
    look = f"background:{palette.WARN};color:#000" if active else "border:1px solid #8888;opacity:0.55"
    return f'<span title="{help}" style="{look};border-radius:4px;padding:0 5px;font-size:11px">{name}</span>'


def walk_html(walk: Progress | None, forces_n: tuple[float, float], loaded_n: float = LOADED_N) -> str:
    """What a walk does, which feet carry it and how far it has come; nothing of a robot that only stands.

    Args:
        walk: of the snapshot.
        forces_n: vertical force on the left and the right foot.
        loaded_n: a foot that feels less carries nothing.
    """
    if walk is None or walk.planned == 0:
        return ""
    side = "" if walk.alone is None else f" {('left', 'right')[walk.alone]}"
    left = "" if walk.left_s is None else f' <span title="until the phase should end">{_time_left(walk.left_s)}</span>'
    return (
        f'<div style="display:flex;align-items:center;gap:5px;white-space:nowrap">{_feet_lamp(forces_n, loaded_n)}'
        f'<span title="{PHASE_HELP[walk.phase]}"><b>{walk.phase}{side}</b></span>{left}'
        f'<span title="steps that have landed, of those planned" style="margin-left:auto">'
        f"{walk.made} of {walk.planned} steps</span></div>"
    )


def _time_left(left_s: float) -> str:
    return f"{left_s:.1f} s" if left_s >= 0.0 else f"{-left_s:.1f} s late"


def _feet_lamp(forces_n: tuple[float, float], loaded_n: float) -> str:
    """A sole for each foot, filled in its colour while it carries load."""
    soles = []
    for name, force, colour in zip(("left", "right"), forces_n, (palette.LEFT_FOOT, palette.RIGHT_FOOT), strict=True):
        carries, css = force > loaded_n, palette.css(colour)
        look = f"background:{css}" if carries else "opacity:0.55"
        help = f"{name} foot: {'carries load' if carries else 'in the air'}"
        soles.append(
            f'<span data-carries="{name if carries else ""}" title="{help}" '
            f'style="width:9px;height:16px;border-radius:3px;border:1px solid {css};flex:none;{look}"></span>'
        )
    return "".join(soles)


def _figures(snapshot: Snapshot) -> str:
    margin = snapshot.balance.zmp_margin_m
    left, right = snapshot.balance.foot_forces_n
    shown = f"{fixed(1e3 * margin, 0)} mm" if math.isfinite(margin) else "–"
    factor = snapshot.real_time_factor
    slow = snapshot.playing and factor < _SLOW * snapshot.speed
    colour = f"color:{palette.WARN}" if slow else ""
    return (
        f'<span title="simulated seconds per second, over the last second" style="{colour}">real time ×{factor:.2f}'
        f'</span> · <span title="distance of the measured ZMP from the edge of the sole">margin {shown}</span>'
        f' · <span title="vertical force on the left and the right foot">L {left:.0f}, R {right:.0f} N</span>'
    )


_BEFORE_S = 0.5
_BEFORE, _FIRST_LIMIT = "Go to 0.5 s before the fall", "Go to the first limit passed"


class FallPanel(Panel):
    """A panel over the scene, hidden while the robot stands.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._gui, self._send = context.gui, context.send
        self._snapshot: Snapshot | None = None
        self._make(context.newest().robot.title)

    def _make(self, robot: str) -> None:
        gui, send, self._robot = self._gui, self._send, robot
        self._panel = gui.add_panel(visible=False)
        with self._panel.add_tab(f"{robot} has fallen", viser.Icon.ALERT_TRIANGLE):
            self._text = gui.add_markdown("")
            before = gui.add_button(_BEFORE, hint="go back and look; a change made there forks the run")
            self._limit = gui.add_button(_FIRST_LIMIT, hint="go to where the trouble began")
            again = gui.add_button("Reset and try again", color="orange", hint="key: R")
        self._panel.float(x=15, y=-15, width=340)  # below, the tour is above
        before.on_click(lambda _: self._go(send, _fall_s, _BEFORE_S))
        self._limit.on_click(lambda _: self._go(send, _limit_s, 0.0))
        again.on_click(lambda _: send(Reset()))

    def show(self, snapshot: Snapshot) -> None:
        """Appear or disappear."""
        self._snapshot, balance = snapshot, snapshot.balance
        if snapshot.robot.title != self._robot:  # the label of a tab stays as it was made
            self._panel.remove()
            self._make(snapshot.robot.title)
        set_changed(self._limit, visible=balance.first_limit_s is not None)
        if balance.fall_text:
            set_changed(self._text, content=balance.fall_text)
        set_changed(self._panel, visible=bool(balance.fall_cause))

    def _go(self, send: Send, when: Callable[[Snapshot], float | None], before_s: float) -> None:
        """Seek, no further back than is kept."""
        snapshot = self._snapshot
        time_s = when(snapshot) if snapshot else None
        if snapshot and time_s is not None:
            send(Seek(max(time_s - before_s, snapshot.timeline.oldest_s)))


def _fall_s(snapshot: Snapshot) -> float | None:
    return snapshot.balance.fall_time_s


def _limit_s(snapshot: Snapshot) -> float | None:
    return snapshot.balance.first_limit_s
