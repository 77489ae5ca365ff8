"""The plots: which are shown, how far back they reach, pause, clear, and what they show as CSV or PNG."""

import csv
import io
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import viser
from viser import uplot

from surefoot.dashboard.messages.signals import TRACE_COLUMNS
from surefoot.dashboard.messages.snapshot import PlotLimits, Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.decimate import decimate
from surefoot.dashboard.ui.plot_kinds import AT_FIRST, MOST_SHOWN, PLOTS, PlotKind, Span
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_slider

MOST_POINTS = 300  # a chart is some 270 pixels wide
_SHORTEST_S, _LONGEST_S, _WINDOW_S = 2.0, 30.0, 8.0
_HEIGHT_PX = 122  # of each chart


class Plot:
    """One chart. Hidden, it is not brought up to date.

    Args:
        gui: where to add it.
        kind: what it shows.
        limits: what the lines are held against.
        visible: at first.
    """

    def __init__(self, gui: viser.GuiApi, kind: PlotKind, limits: PlotLimits, visible: bool) -> None:
        self.kind = kind
        self._traces = kind.traces(limits)
        self._title = gui.add_html(self._heading(), visible=visible)
        grid: uplot.Axis_Grid = {"stroke": "rgba(128,128,128,0.25)", "width": 1}
        ticks: uplot.Axis_Ticks = {"stroke": "rgba(128,128,128,0.25)", "width": 1, "size": 4}
        axis: uplot.Axis = {"stroke": "#888", "grid": grid, "ticks": ticks, "font": "10px sans-serif"}
        empty = np.zeros(2)
        self._chart = gui.add_uplot(
            (empty, *(empty for _ in self._traces)),
            self._series(),
            height=_HEIGHT_PX,
            scales=_scales(kind.span(limits)),
            axes=({**axis, "size": 24}, {**axis, "size": 42, "space": 22}),
            legend={"show": False},
            padding=(8, 10, 0, 0),
            cursor={"drag": {"x": False, "y": False}},
            visible=visible,
        )

    @property
    def visible(self) -> bool:
        """Whether it is shown."""
        return self._chart.visible

    def set_visible(self, visible: bool) -> None:
        """Show or hide it."""
        self._title.visible = self._chart.visible = visible

    def set_limits(self, limits: PlotLimits) -> None:
        """Hold the lines against other limits, in place: what an update is under way for must not be removed."""
        self._traces = self.kind.traces(limits)
        self._title.content = self._heading()
        self._chart.series, self._chart.scales = self._series(), _scales(self.kind.span(limits))

    def show(self, table: np.ndarray) -> None:
        """Draw rows of ``TRACE_COLUMNS``."""
        columns = (table[:, 0], *(trace.values(table) for trace in self._traces))
        halved: Any = tuple(column.astype(np.float32) for column in columns)  # sent as they are: half the bytes
        self._chart.data = halved

    def _series(self) -> tuple[uplot.Series, ...]:
        series: list[uplot.Series] = [{"label": "t [s]"}]
        for trace in self._traces:
            line: uplot.Series = {
                "label": trace.label or "limit",
                "stroke": palette.css(trace.colour),
                "width": trace.width,
                "points": {"show": False},
            }
            if trace.dash:
                line["dash"] = trace.dash
            series.append(line)
        return tuple(series)

    def _heading(self) -> str:
        named = " ".join(
            f'<span style="white-space:nowrap"><span style="color:{palette.css(trace.colour)}">'
            f"{'╍' if trace.dash else '━'}</span> {trace.label}</span>"
            for trace in self._traces
            if trace.label
        )
        return (
            f'<div style="font-size:12px;padding:3px 10px 0;line-height:1.35"><b>{self.kind.title}</b><br>{named}</div>'
        )


class PlotsPanel(Panel):
    """All charts and what goes with them.

    Args:
        context: of the page.
    """

    every_frames = 4

    def __init__(self, context: PageContext) -> None:
        gui, limits = context.gui, context.newest().limits
        self._limits, self._shown, self._since = limits, np.empty((0, 1)), -math.inf
        self._stale = False
        self._chosen = list(AT_FIRST)
        self._window = add_slider(
            gui, "Window [s]", _SHORTEST_S, _LONGEST_S, 1.0, _WINDOW_S, hint="how far back the plots reach"
        )
        self._hold = gui.add_checkbox("Hold the plots", False, hint="stop the plots, not the simulation")
        with gui.add_folder("Choose plots, keep data", expand_by_default=False):
            self._estimating = context.newest().sensing.estimating
            self._boxes = {
                kind.key: gui.add_checkbox(
                    kind.name, kind.key in AT_FIRST, visible=self._estimating or not kind.believed
                )
                for kind in PLOTS
            }
            clear = gui.add_button_group(
                "Data",
                ("clear", "save CSV", "save PNG"),
                hint="clear: start anew from now; save: what the plots show, every 10 ms as CSV or drawn as PNG",
            )
        self._plots = {kind.key: Plot(gui, kind, limits, kind.key in AT_FIRST) for kind in PLOTS}
        for key, box in self._boxes.items():
            box.on_update(self._chooser(key))
        self._window.on_update(lambda _: self._refresh())

        @clear.on_click
        def _(event: viser.GuiEvent) -> None:
            if event.target.value == "clear":
                self._since = float(self._shown[-1, 0]) if len(self._shown) else -math.inf
                self._refresh()
            elif event.client is not None:
                send = send_csv if event.target.value == "save CSV" else send_png
                send(event.client, [PLOT_BY_KEY[key] for key in self._chosen], self._limits, self.rows())

    @property
    def chosen(self) -> tuple[str, ...]:
        """Keys of the plots that are shown."""
        return tuple(self._chosen)

    def show(self, snapshot: Snapshot) -> None:
        """Draw the last seconds."""
        if snapshot.sensing.estimating != self._estimating:
            self._offer_believed(snapshot.sensing.estimating)
        if snapshot.limits != self._limits:
            self._limits = snapshot.limits
            for plot in self._plots.values():
                plot.set_limits(snapshot.limits)
        if not self._hold.value and snapshot.traces is not self._shown:
            self._shown, self._stale = snapshot.traces, True
        if not self._stale or len(self._shown) < 2:
            return
        self._stale = False
        rows = self.rows()
        if len(rows) < 2:
            return
        thinned = decimate(rows, MOST_POINTS)
        for key in tuple(self._chosen):
            self._plots[key].show(thinned)

    def rows(self) -> np.ndarray:
        """What the plots show, every row of it."""
        if not len(self._shown):
            return self._shown
        newest = float(self._shown[-1, 0])
        if newest < self._since:  # another run
            self._since = -math.inf
        return self._shown[self._shown[:, 0] >= max(newest - self._window.value, self._since)]

    def _refresh(self) -> None:
        self._stale = True

    def _offer_believed(self, estimating: bool) -> None:
        """Plots of an estimator's errors can be chosen where there is one, and are gone where there is none."""
        self._estimating = estimating
        for key in (kind.key for kind in PLOTS if kind.believed):
            self._boxes[key].visible = estimating
            if not estimating and key in self._chosen:
                self._boxes[key].value = False
                self._plots[key].set_visible(False)
        if not estimating:
            self._chosen = [key for key in self._chosen if not PLOT_BY_KEY[key].believed]

    def _chooser(self, key: str) -> Any:
        def chosen(event: viser.GuiEvent) -> None:
            if not from_browser(event):
                return
            self._chosen = [other for other in self._chosen if other != key] + [key] * bool(event.target.value)
            for spare in self._chosen[:-MOST_SHOWN]:  # the one chosen longest ago makes room
                self._boxes[spare].value = False
            self._chosen = self._chosen[-MOST_SHOWN:]
            for name, plot in self._plots.items():
                plot.set_visible(name in self._chosen)
            self._refresh()

        return chosen


PLOT_BY_KEY = {kind.key: kind for kind in PLOTS}


def _scales(span: Span) -> dict[str, uplot.Scale]:
    vertical: uplot.Scale = {"auto": True} if span is None else {"auto": False, "range": span}
    return {"x": {"time": False}, "y": vertical}


def send_csv(client: viser.ClientHandle, kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> None:
    """Give a browser the columns of some plots."""
    client.send_file_download("surefoot-plots.csv", traces_csv(kinds, limits, rows), save_immediately=True)


def send_png(client: viser.ClientHandle, kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> None:
    """Give a browser a picture of some plots."""
    client.send_file_download("surefoot-plots.png", traces_png(kinds, limits, rows), save_immediately=True)


def traces_csv(kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> bytes:
    """Time and every column that one of the plots shows, all rows, with a line of names."""
    used = {trace.source for kind in kinds for trace in kind.traces(limits)}
    columns = [i for i, name in enumerate(TRACE_COLUMNS) if i == 0 or name in used]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([TRACE_COLUMNS[i] for i in columns])
    writer.writerows([[f"{value:.6g}" for value in row] for row in rows[:, columns]])
    return text.getvalue().encode()


def traces_png(kinds: Sequence[PlotKind], limits: PlotLimits, rows: np.ndarray) -> bytes:
    """The plots below each other, drawn for print."""
    from surefoot.experiments.plots.live import Curve, Panel, draw_live  # Matplotlib takes a while to load

    panels = [
        Panel(
            title=kind.title,
            span=kind.span(limits),
            curves=tuple(
                Curve(trace.label, trace.values(rows), trace.colour, trace.width, bool(trace.dash))
                for trace in kind.traces(limits)
            ),
        )
        for kind in kinds
    ]
    return draw_live(rows[:, 0], panels)
