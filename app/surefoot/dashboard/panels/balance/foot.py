"""The close-up of the feet, and the numbers beside its signs."""

import math

import numpy as np

from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.balance.foot_believed import LEGEND
from surefoot.dashboard.panels.balance.foot_plan import foot_plan
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.symbols import POINTS, PointSymbol, sign
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.number_text import fixed


class FootPanel(Panel):
    """The soles seen from above, live.

    Args:
        context: of the page.
    """

    every_frames = 5

    def __init__(self, context: PageContext) -> None:
        self._html = context.gui.add_html(foot_html(context.newest()))

    def show(self, snapshot: Snapshot) -> None:
        """Draw how it is now; what has not changed is not sent."""
        set_changed(self._html, content=foot_html(snapshot))


def foot_html(snapshot: Snapshot) -> str:
    """Picture, margin and numbers."""
    geometry, margin = snapshot.geometry, snapshot.balance.zmp_margin_m
    rows = "".join(_row(point, point.place(geometry) - geometry.support_origin[:2]) for point in POINTS)
    shown = f"{fixed(1e3 * margin, 0)} mm" if math.isfinite(margin) else "no load"
    legend = LEGEND if geometry.believed is not None else ""
    picture = foot_plan(geometry, snapshot.support, snapshot.robot, margin, snapshot.terrain)
    return (
        '<div style="padding:4px 10px 2px;color:inherit;font-size:12px">'
        '<div style="display:flex;align-items:baseline;gap:8px"><b>Feet from above</b>'
        '<span style="margin-left:auto" title="from the measured ZMP to the nearest edge of the support polygon">'
        f'margin <b data-margin style="color:{palette.margin_colour(margin)};font-size:15px">{shown}</b></span></div>'
        f'<div style="border:1px solid #8884;border-radius:6px;overflow:hidden;margin:3px 0">{picture}</div>'
        f'<div style="display:grid;grid-template-columns:1fr 1fr;gap:1px 10px">{rows}</div>{legend}</div>'
    )


def _mm(metres: float) -> str:
    whole = round(1e3 * float(metres))
    return f"{whole:+d}" if whole else "0"


def _row(point: PointSymbol, away: np.ndarray) -> str:
    known = bool(np.isfinite(away).all())
    numbers = f"{_mm(away[0])}, {_mm(away[1])}" if known else "–"
    return (
        f'<div title="{point.help}; forward, left of P [mm]" style="display:flex;align-items:center;gap:4px;'
        f'white-space:nowrap">{sign(point)}{point.name}<span style="margin-left:auto;opacity:0.75;'
        f'font-variant-numeric:tabular-nums">{numbers}</span></div>'
    )
