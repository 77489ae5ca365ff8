"""Difference plots: how far apart two robots are, and how near each is to its limit."""

from dataclasses import dataclass

import numpy as np
import viser
from viser import uplot

from surefoot.dashboard.messages.signals import TWIN_COLUMNS, column_of
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette

_DASHED = (4.0, 4.0)
_HEIGHT_PX = 96  # of each chart


@dataclass(frozen=True)
class Line:
    """One line.

    Attributes:
        column: key of a signal of ``TWIN_SIGNALS``.
        colour: out of the palette.
        dash: pixels on and off; none for a full line.

    Raises:
        ValueError: there is no such signal.
    """

    column: str
    colour: palette.Rgb
    dash: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Refuse a signal that does not exist."""
        column_of(self.column, TWIN_COLUMNS)


@dataclass(frozen=True)
class Chart:
    """One chart.

    Attributes:
        title: HTML.
        lines: over time.
        most: values beyond are cut off, so that a fall does not flatten what led to it.
    """

    title: str
    lines: tuple[Line, ...]
    most: float


def _name(text: str, colour: palette.Rgb, dashed: bool = False) -> str:
    return f'<span style="color:{palette.css(colour)}">{"┅" if dashed else "━"} {text}</span>'


CHARTS = (
    Chart(
        f"CoM, twin − first [mm]: {_name('x front', palette.FORCE)} {_name('y left', palette.COM)}",
        (Line("com_x_mm", palette.FORCE), Line("com_y_mm", palette.COM)),
        150.0,
    ),
    Chart(
        f"ZMP margin [mm]: {_name('first', palette.FIRST)} {_name('twin', palette.TWIN)}",
        (Line("margin_first_mm", palette.FIRST), Line("margin_twin_mm", palette.TWIN)),
        100.0,
    ),
    Chart(
        f"δ_P [N·m]: {_name('first', palette.FIRST)} {_name('twin', palette.TWIN)}, dashed sagittal",
        (
            Line("frontal_first_nm", palette.FIRST),
            Line("frontal_twin_nm", palette.TWIN),
            Line("sagittal_first_nm", palette.FIRST, _DASHED),
            Line("sagittal_twin_nm", palette.TWIN, _DASHED),
        ),
        300.0,
    ),
)


class TwinPlotsPanel(Panel):
    """The charts.

    Args:
        context: of the page.
    """

    every_frames = 4

    def __init__(self, context: PageContext) -> None:
        gui = context.gui
        grid: uplot.Axis_Grid = {"stroke": "rgba(128,128,128,0.25)", "width": 1}
        axis: uplot.Axis = {"stroke": "#888", "grid": grid, "ticks": {**grid, "size": 4}, "font": "10px sans-serif"}
        empty = np.zeros((2, len(TWIN_COLUMNS)))
        self._shown = empty
        self._charts: list[tuple[Chart, viser.GuiUplotHandle]] = []
        for chart in CHARTS:
            gui.add_html(f'<div style="font-size:12px;font-weight:600;padding:2px 10px 0">{chart.title}</div>')
            series: list[uplot.Series] = [{"label": "t [s]"}]
            for line in chart.lines:
                drawn: uplot.Series = {
                    "label": line.column,
                    "stroke": palette.css(line.colour),
                    "width": 1.6,
                    "points": {"show": False},
                }
                if line.dash:
                    drawn["dash"] = line.dash
                series.append(drawn)
            handle = gui.add_uplot(
                _data(chart, empty),
                tuple(series),
                height=_HEIGHT_PX,
                scales={"x": {"time": False}},
                axes=({**axis, "size": 24}, {**axis, "size": 40, "space": 22}),
                legend={"show": False},
                padding=(8, 10, 0, 0),
                cursor={"drag": {"x": False, "y": False}},
            )
            self._charts.append((chart, handle))

    def show(self, snapshot: Snapshot) -> None:
        """Draw the differences of the last seconds."""
        table = self._shown if snapshot.twin is None else snapshot.twin.table
        if table is self._shown or len(table) < 2:
            return
        self._shown = table
        for chart, handle in self._charts:
            handle.data = _data(chart, table)


def _data(chart: Chart, table: np.ndarray) -> tuple[np.ndarray, ...]:
    columns = (table[:, column_of(line.column, TWIN_COLUMNS)] for line in chart.lines)
    return (np.ascontiguousarray(table[:, 0]), *(np.clip(column, -chart.most, chart.most) for column in columns))
