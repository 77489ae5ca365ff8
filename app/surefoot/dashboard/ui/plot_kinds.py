"""What can be plotted: lines out of the traces, held against their limits."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from surefoot.dashboard.messages.signals import column_of
from surefoot.dashboard.messages.snapshot import PlotLimits
from surefoot.dashboard.ui import palette

_BEYOND = 1.25  # how far past the limits a plot reaches
BAND_SIGMAS = 3.0
Span = tuple[float, float] | None


@dataclass(frozen=True)
class Trace:
    """One line: a signal (``messages/signals.py``), or a constant.

    Attributes:
        label: what it is called; lines without one are limits and stand in no legend.
        source: key of the signal, or value.
        colour: out of the palette.
        width: pixels.
        dash: pixels on and off; none for a full line.
        times: what the signal's values are multiplied by.

    Raises:
        ValueError: there is no such signal.
    """

    label: str
    source: str | float
    colour: palette.Rgb
    width: float = 1.6
    dash: tuple[float, ...] = ()
    times: float = 1.0

    def __post_init__(self) -> None:
        """Refuse a signal that does not exist."""
        if isinstance(self.source, str):
            column_of(self.source)

    def values(self, table: np.ndarray) -> np.ndarray:
        """The line's values for the rows of a table."""
        if isinstance(self.source, str):
            return self.times * table[:, column_of(self.source)]
        return np.full(len(table), self.source)


@dataclass(frozen=True)
class PlotKind:
    """One chart.

    Attributes:
        key: stable name.
        name: on its checkbox.
        title: above it, with the unit.
        traces: its lines, for the limits active.
        span: lowest and highest value shown, or None for whatever there is.
        believed: only to be had where an estimator is at work.
    """

    key: str
    name: str
    title: str
    traces: Callable[[PlotLimits], tuple[Trace, ...]]
    span: Callable[[PlotLimits], Span]
    believed: bool = False


def _points(axis: str, low: str, high: str) -> Callable[[PlotLimits], tuple[Trace, ...]]:
    return lambda _: (
        Trace("sole edge", f"edge_{low}_mm", palette.LIMIT, 2.0),
        Trace("", f"edge_{high}_mm", palette.LIMIT, 2.0),
        Trace("DCM", f"dcm_{axis}_mm", palette.CAPTURE),
        Trace("CoM", f"com_{axis}_mm", palette.COM),
        Trace("ζ", f"zmp_commanded_{axis}_mm", palette.ZMP_COMMANDED),
        Trace("ZMP", f"zmp_{axis}_mm", palette.ZMP_MEASURED),
    )


def _ankles(limits: PlotLimits) -> tuple[Trace, ...]:
    frontal, sagittal = palette.FORCE, palette.CAPTURE
    return (
        Trace(f"{limits.ankle_frontal} frontal", "ankle_frontal_nm", frontal),
        Trace(f"{limits.ankle_sagittal} sagittal", "ankle_sagittal_nm", sagittal),
        *(Trace("", sign * limits.ankle_frontal_nm, frontal, 1.0, (4.0, 4.0)) for sign in (-1.0, 1.0)),
        *(Trace("", sign * limits.ankle_sagittal_nm, sagittal, 1.0, (4.0, 4.0)) for sign in (-1.0, 1.0)),
    )


def _delta(limits: PlotLimits) -> tuple[Trace, ...]:
    frontal, sagittal, dash = palette.FORCE, palette.CAPTURE, (5.0, 3.0)
    return (
        Trace("frontal commanded", "delta_commanded_x_nm", frontal, 1.6, dash),
        Trace("measured", "delta_measured_x_nm", frontal),
        Trace("sagittal commanded", "delta_commanded_y_nm", sagittal, 1.6, dash),
        Trace("measured", "delta_measured_y_nm", sagittal),
    )


def _forces(limits: PlotLimits) -> tuple[Trace, ...]:
    return (
        Trace("left foot", "force_left_n", palette.FORCE),
        Trace("right foot", "force_right_n", palette.ZMP_MEASURED),
        Trace("", 0.0, palette.LIMIT, 1.0),
    )


def _margins(limits: PlotLimits) -> tuple[Trace, ...]:
    return (
        Trace("DCM", "dcm_margin_mm", palette.CAPTURE),
        Trace("ZMP", "zmp_margin_mm", palette.ZMP_MEASURED),
        Trace("edge", 0.0, palette.LIMIT, 2.0),
    )


def _ticks(limits: PlotLimits) -> tuple[Trace, ...]:
    return (
        Trace("slowest of 10 ticks", "tick_us", palette.FORCE),
        Trace("1 ms: real time", 1000.0, palette.LIMIT, 2.0),
    )


def _errors(signal: str, unit: str, first: str, second: str) -> Callable[[PlotLimits], tuple[Trace, ...]]:
    """Two errors, and what they should stay within if the estimator's covariance tells the truth."""
    axes, dash = (("x", first, palette.CAPTURE), ("y", second, palette.FORCE)), (4.0, 4.0)
    errors = [Trace(label, f"{signal}_error_{axis}_{unit}", colour) for axis, label, colour in axes]
    bands = [
        Trace("", f"{signal}_sigma_{axis}_{unit}", colour, 1.0, dash, sign * BAND_SIGMAS)
        for axis, _, colour in axes
        for sign in (-1.0, 1.0)
    ]
    return lambda _: (*errors, *bands)


def _range(edges: tuple[float, float]) -> tuple[float, float]:
    middle, half = 0.5 * (edges[0] + edges[1]), 0.5 * (edges[1] - edges[0])
    return middle - _BEYOND * half, middle + _BEYOND * half


def _ankle_range(limits: PlotLimits) -> tuple[float, float]:
    reach = _BEYOND * max(limits.ankle_sagittal_nm, limits.ankle_frontal_nm)
    return -reach, reach


PLOTS = (
    PlotKind(
        "lateral",
        "Lateral: ZMP, CoM",
        "Lateral from P [mm], + left",
        _points("y", "right", "left"),
        lambda limits: _range(limits.lateral_mm),
    ),
    PlotKind(
        "sagittal",
        "Sagittal: ZMP, CoM",
        "Sagittal from P [mm], + front",
        _points("x", "rear", "front"),
        lambda limits: _range(limits.sagittal_mm),
    ),
    PlotKind("ankles", "Ankle torques", "Ankle torque [N·m], limits dashed", _ankles, _ankle_range),
    PlotKind("margins", "Margins", "Distance to the sole's edge [mm], + inside", _margins, lambda _: None),
    PlotKind("delta", "δ_P", "δ_P: rate of angular momentum [N·m]", _delta, lambda _: None),
    PlotKind("forces", "Contact forces", "Force on each foot, upward [N]", _forces, lambda _: None),
    PlotKind(
        "dcm_error",
        "DCM error",
        "Believed less true DCM [mm], 3σ dashed",
        _errors("dcm", "mm", "forward", "left"),
        lambda _: None,
        believed=True,
    ),
    PlotKind(
        "tilt_error",
        "Tilt error",
        "From believed to true tilt [°], 3σ dashed",
        _errors("tilt", "deg", "about forward", "about left"),
        lambda _: None,
        believed=True,
    ),
    PlotKind("ticks", "Tick time", "Control tick [µs]", _ticks, lambda _: (0.0, 1500.0)),
)
AT_FIRST = ("lateral", "sagittal", "ankles")
MOST_SHOWN = 4
