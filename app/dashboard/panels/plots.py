"""Two looks at the ZMP against the edges of the sole, and the two ankle torques against their limits."""

from dataclasses import dataclass

import numpy as np
import viser
from viser import uplot

from app.dashboard import palette
from app.dashboard.snapshot import TRACE_COLUMNS, PlotLimits, Snapshot

_WINDOW_S = 8.0
_BEYOND = 1.25  # how far past the limits a plot reaches


@dataclass(frozen=True)
class Trace:
    """One line: a column out of ``TRACE_COLUMNS``, or a constant."""

    label: str
    source: str | float
    colour: palette.Rgb
    width: float = 1.6
    dash: tuple[float, ...] = ()

    def values(self, table: np.ndarray) -> np.ndarray:
        """The line's values for the rows of a table."""
        if isinstance(self.source, str):
            return np.ascontiguousarray(table[:, TRACE_COLUMNS.index(self.source)])
        return np.full(len(table), self.source)


class Plot:
    """One chart: a title and lines over time.

    Args:
        gui: where to add it.
        title: HTML.
        traces: the lines.
        span: lowest and highest value shown.
        height: pixels.
    """

    def __init__(
        self, gui: viser.GuiApi, title: str, traces: list[Trace], span: tuple[float, float], height: int
    ) -> None:
        series: list[uplot.Series] = [{"label": "t [s]"}]
        for trace in traces:
            line: uplot.Series = {
                "label": trace.label, "stroke": palette.css(trace.colour), "width": trace.width,
                "points": {"show": False},
            }  # fmt: skip
            if trace.dash:
                line["dash"] = trace.dash
            series.append(line)
        grid: uplot.Axis_Grid = {"stroke": "rgba(128,128,128,0.25)", "width": 1}
        ticks: uplot.Axis_Ticks = {"stroke": "rgba(128,128,128,0.25)", "width": 1, "size": 4}
        axis: uplot.Axis = {"stroke": "#888", "grid": grid, "ticks": ticks, "font": "10px sans-serif"}
        empty = np.zeros((2, len(TRACE_COLUMNS)))
        self._traces = traces
        self._title = gui.add_html(f'<div style="font-size:12px;font-weight:600;padding:2px 10px 0">{title}</div>')
        self._chart = gui.add_uplot(
            (empty[:, 0], *(trace.values(empty) for trace in traces)), tuple(series), height=height,
            scales={"x": {"time": False}, "y": {"auto": False, "range": span}},
            axes=({**axis, "size": 24}, {**axis, "size": 40, "space": 22}), legend={"show": False},
            padding=(8, 10, 0, 0), cursor={"drag": {"x": False, "y": False}},
        )  # fmt: skip

    def show(self, table: np.ndarray) -> None:
        """Draw rows of ``TRACE_COLUMNS``."""
        self._chart.data = (np.ascontiguousarray(table[:, 0]), *(trace.values(table) for trace in self._traces))

    def remove(self) -> None:
        """Take it off the page."""
        self._title.remove()
        self._chart.remove()


class PlotsPanel:
    """The plots, made anew when another support brings other limits.

    Args:
        gui: where to add them (into the current container).
        limits: what the lines are held against.
        height: of each plot, pixels.
    """

    def __init__(self, gui: viser.GuiApi, limits: PlotLimits, height: int) -> None:
        self._gui, self._height, self._limits = gui, height, limits
        gui.add_html(f'<div style="font-size:12px;padding:0 10px">{_legend()}</div>')
        self._place = gui.add_folder(None)
        self._paused = gui.add_checkbox("Hold the plots", False, hint="stop the plots, not the simulation")
        self._plots = self._made(limits)
        self._shown: np.ndarray | None = None

    def show(self, snapshot: Snapshot) -> None:
        """Draw the last seconds."""
        if snapshot.limits != self._limits:
            for plot in self._plots:
                plot.remove()
            self._limits, self._plots = snapshot.limits, self._made(snapshot.limits)
        table = snapshot.traces
        if self._paused.value or table is self._shown or len(table) < 2:
            return
        self._shown = table
        table = table[table[:, 0] >= table[-1, 0] - _WINDOW_S]
        for plot in self._plots:
            plot.show(table)

    def _made(self, limits: PlotLimits) -> tuple[Plot, ...]:
        frontal, sagittal = palette.FORCE, palette.CAPTURE
        torques = [
            Trace(limits.ankle_frontal, "ankle_frontal_nm", frontal),
            Trace(limits.ankle_sagittal, "ankle_sagittal_nm", sagittal),
            *_torque_limits(limits.ankle_frontal_nm, frontal), *_torque_limits(limits.ankle_sagittal_nm, sagittal),
        ]  # fmt: skip
        reach = _BEYOND * max(limits.ankle_sagittal_nm, limits.ankle_frontal_nm)
        title = (
            f'<span style="color:{palette.css(frontal)}">{limits.ankle_frontal} frontal</span>, '
            f'<span style="color:{palette.css(sagittal)}">{limits.ankle_sagittal} sagittal</span> ankle torque [N·m]'
        )
        with self._place:
            return (
                Plot(self._gui, "Lateral (frontal plane) from P [mm], + left", _points("y", limits.lateral_mm),
                     _range(limits.lateral_mm), self._height),
                Plot(self._gui, "Sagittal from P [mm], + front", _points("x", limits.sagittal_mm),
                     _range(limits.sagittal_mm), self._height),
                Plot(self._gui, title, torques, (-reach, reach), self._height),
            )  # fmt: skip


def _legend() -> str:
    names = (
        ("ZMP", palette.ZMP_MEASURED), ("ZMP commanded ζ", palette.ZMP_COMMANDED), ("CoM", palette.COM),
        ("DCM", palette.CAPTURE), ("sole edge", palette.LIMIT),
    )  # fmt: skip
    return " ".join(
        f'<span style="white-space:nowrap"><span style="color:{palette.css(colour)}">━</span> {name}</span>'
        for name, colour in names
    )


def _points(axis: str, edges: tuple[float, float]) -> list[Trace]:
    return [
        Trace("edge", edges[0], palette.LIMIT, 2.0), Trace("edge", edges[1], palette.LIMIT, 2.0),
        Trace("DCM", f"dcm_{axis}_mm", palette.CAPTURE), Trace("CoM", f"com_{axis}_mm", palette.COM),
        Trace("ZMP commanded", f"zmp_commanded_{axis}_mm", palette.ZMP_COMMANDED),
        Trace("ZMP", f"zmp_{axis}_mm", palette.ZMP_MEASURED),
    ]  # fmt: skip


def _torque_limits(size: float, colour: palette.Rgb) -> list[Trace]:
    return [Trace("limit", sign * size, colour, 1.0, (4.0, 4.0)) for sign in (-1.0, 1.0)]


def _range(edges: tuple[float, float]) -> tuple[float, float]:
    middle, half = 0.5 * (edges[0] + edges[1]), 0.5 * (edges[1] - edges[0])
    return middle - _BEYOND * half, middle + _BEYOND * half
