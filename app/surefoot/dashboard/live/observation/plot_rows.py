"""What the plots are made of: a row of numbers every few ticks, kept for as long as a plot can look back."""

import math

import numpy as np

from surefoot.dashboard.messages.signals import SIGNALS, TRACE_COLUMNS, Sample
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.robot.description import BASE_DOFS
from surefoot.simulation.loop import Simulation, TickResult
from surefoot.simulation.measurement import measured_delta, sole_outline

TRACE_EVERY_TICKS = 10  # 10 ms: what happens between two rows is not seen
LONGEST_WINDOW_S = 30.0
_BLOCK_ROWS = 100
_ROWS = round(LONGEST_WINDOW_S * 1000.0 / TRACE_EVERY_TICKS)
_NS_PER_US = 1e3
_NO_EDGES = (math.nan, math.nan, math.nan, math.nan)


class TraceLog:
    """The last rows. Full blocks never change again, so that a copy costs next to nothing."""

    def __init__(self) -> None:
        self._blocks: tuple[np.ndarray, ...] = ()
        self._tail: list[tuple[float, ...]] = []
        self._table: np.ndarray | None = None

    def add(self, row: tuple[float, ...]) -> None:
        """Append a row of ``TRACE_COLUMNS``; the oldest ones make room."""
        self._tail.append(row)
        self._table = None
        if len(self._tail) == _BLOCK_ROWS:
            self._blocks = (*self._blocks, np.array(self._tail))[-(_ROWS // _BLOCK_ROWS) :]
            self._tail = []

    def table(self) -> np.ndarray:
        """All rows (n, len(TRACE_COLUMNS)), oldest first; the same object until a row is added."""
        if self._table is None:
            tail = np.array(self._tail).reshape(-1, len(TRACE_COLUMNS))
            self._table = np.concatenate((*self._blocks, tail))
        return self._table

    def copy(self) -> "TraceLog":
        """An independent log with the same rows."""
        other = TraceLog()
        other._blocks, other._tail, other._table = self._blocks, list(self._tail), self._table
        return other


def trace_row(simulation: Simulation, result: TickResult) -> tuple[float, ...]:
    """One row of ``TRACE_COLUMNS``; all but the time are NaN for a tick that could not be measured."""
    sample = _sample(simulation, result)
    if sample is None:
        return (simulation.time_s, *[float("nan")] * (len(TRACE_COLUMNS) - 1))
    values = (signal.extract(sample) for signal in SIGNALS)
    return tuple(value if math.isfinite(value) else math.nan for value in values)  # a plot knows NaN, but no infinity


def _sample(simulation: Simulation, result: TickResult) -> Sample | None:
    output, terms, balance, com = result.output, result.terms, result.balance, result.position_com
    if terms is None or output is None or com is None:
        return None
    foot = simulation.robot.feet[simulation.support.reference_foot]
    polygon = support_polygon(simulation)
    return Sample(
        time_s=simulation.time_s,
        result=result,
        output=output,
        com=com,
        delta_measured=measured_delta(balance, com, simulation.plant.mass_kg * terms.gravity),
        edges_mm=edges_at(polygon, balance.zmp_in_world, balance.origin[:2]) if polygon else _NO_EDGES,
        dcm_margin_m=polygon.signed_margin(result.capture) if polygon else float("nan"),
        ankle_frontal_nm=float(result.applied[foot.frontal - BASE_DOFS]),
        ankle_sagittal_nm=float(result.applied[foot.sagittal - BASE_DOFS]),
        slowest_tick_us=slowest_tick_us(simulation),
    )


def support_polygon(simulation: Simulation) -> ConvexPolygon | None:
    """The hull of the planned stance soles, seen from above; None when they span no area (a NaN, a sole on edge)."""
    feet = simulation.plant.feet()
    corners = np.vstack([sole_outline(simulation.plant.built, feet[i], i) for i in simulation.support.stance])
    if not np.isfinite(corners).all():
        return None
    try:
        return convex_hull(corners.tolist())
    except ValueError:
        return None


def edges_at(polygon: ConvexPolygon, point: np.ndarray, origin: np.ndarray) -> tuple[float, float, float, float]:
    """Where the lines through a point cross the polygon: rear, front, right and left [mm] from the origin.

    Beside the polygon, where such a line misses it, the nearest one that does not counts.
    """
    corners = (polygon.vertices - origin).tolist()  # a dozen: no numpy
    seen = (point if np.isfinite(point).all() else polygon.centroid) - origin
    spans = []
    for axis, value in ((0, float(seen[1])), (1, float(seen[0]))):
        cuts = _crossings(corners, axis, value)
        spans += [1e3 * min(cuts), 1e3 * max(cuts)]
    return spans[0], spans[1], spans[2], spans[3]


def slowest_tick_us(simulation: Simulation) -> float:
    """Longest control tick [us] since the last call, by the probe of the loop; NaN without one."""
    longest = max(simulation.tick_ns) / _NS_PER_US if simulation.tick_ns else float("nan")
    simulation.tick_ns.clear()
    return longest


def _crossings(corners: list[list[float]], axis: int, value: float) -> list[float]:
    """Where the outline (n, 2) crosses the line along an axis whose other coordinate is a value, or the nearest one."""
    across = [corner[1 - axis] for corner in corners]
    value = min(max(value, min(across)), max(across))
    found = []
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        (start, end), (along_a, along_b) = (a[1 - axis], b[1 - axis]), (a[axis], b[axis])
        if start == end == value:
            found += [along_a, along_b]
        elif min(start, end) <= value <= max(start, end) and start != end:
            found.append(along_a + (value - start) / (end - start) * (along_b - along_a))
    return found
