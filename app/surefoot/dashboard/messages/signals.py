"""What of the live run can be plotted: one entry for each number, its column's name and where it is taken from."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:  # so that the page's modules, which need the names only, load no physics
    from surefoot.control.interface import ControlOutput
    from surefoot.simulation.loop import TickResult

_MM_PER_M = 1e3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sample:
    """What the signals are taken from: a tick that could be measured.

    Attributes:
        time_s: simulated time.
        result: of the tick.
        output: what the controller decided.
        com: (3,) centre of mass, world [m].
        delta_measured: (3,) delta_P about the support's origin, world [N m].
        edges_mm: where the lines through the measured ZMP cross the outline of the soles: rear, front, right and left
            of the support's origin.
        dcm_margin_m: distance of the capture point from that outline, positive inside.
        ankle_frontal_nm, ankle_sagittal_nm: torques applied at the ankle of the reference foot.
        slowest_tick_us: longest control tick since the last sample; NaN when unknown.
    """

    time_s: float
    result: "TickResult"
    output: "ControlOutput"
    com: np.ndarray
    delta_measured: np.ndarray
    edges_mm: tuple[float, float, float, float]
    dcm_margin_m: float
    ankle_frontal_nm: float
    ankle_sagittal_nm: float
    slowest_tick_us: float


@dataclass(frozen=True, slots=True)
class Signal:
    """One number that can be plotted.

    Attributes:
        key: name of its column, which ends with the unit.
        unit: as the title of a plot writes it.
        extract: takes it from a sample.
    """

    key: str
    unit: str
    extract: Callable[[Sample], float]


def _from_origin(point: Callable[[Sample], np.ndarray], axis: int) -> Callable[[Sample], float]:
    """Coordinate [mm] of a world point [m] from P of the stance foot (midway between both P in double support)."""
    return lambda sample: _MM_PER_M * float(point(sample)[axis] - sample.result.balance.origin[axis])


def _zmp(sample: Sample) -> np.ndarray:
    return sample.result.balance.zmp_in_world


def _zmp_commanded(sample: Sample) -> np.ndarray:
    return sample.output.zmp_commanded_in_world


def _com(sample: Sample) -> np.ndarray:
    return sample.com


def _dcm(sample: Sample) -> np.ndarray:
    return sample.result.capture


SIGNALS = (
    Signal("time_s", "s", lambda sample: sample.time_s),
    Signal("zmp_x_mm", "mm", _from_origin(_zmp, 0)),
    Signal("zmp_y_mm", "mm", _from_origin(_zmp, 1)),
    Signal("zmp_commanded_x_mm", "mm", _from_origin(_zmp_commanded, 0)),
    Signal("zmp_commanded_y_mm", "mm", _from_origin(_zmp_commanded, 1)),
    Signal("com_x_mm", "mm", _from_origin(_com, 0)),
    Signal("com_y_mm", "mm", _from_origin(_com, 1)),
    Signal("dcm_x_mm", "mm", _from_origin(_dcm, 0)),
    Signal("dcm_y_mm", "mm", _from_origin(_dcm, 1)),
    Signal("edge_rear_mm", "mm", lambda sample: sample.edges_mm[0]),
    Signal("edge_front_mm", "mm", lambda sample: sample.edges_mm[1]),
    Signal("edge_right_mm", "mm", lambda sample: sample.edges_mm[2]),
    Signal("edge_left_mm", "mm", lambda sample: sample.edges_mm[3]),
    Signal("zmp_margin_mm", "mm", lambda sample: _MM_PER_M * sample.result.balance.zmp_margin),
    Signal("dcm_margin_mm", "mm", lambda sample: _MM_PER_M * sample.dcm_margin_m),
    Signal("delta_commanded_x_nm", "N·m", lambda sample: float(sample.output.delta_commanded[0])),
    Signal("delta_commanded_y_nm", "N·m", lambda sample: float(sample.output.delta_commanded[1])),
    Signal("delta_measured_x_nm", "N·m", lambda sample: float(sample.delta_measured[0])),
    Signal("delta_measured_y_nm", "N·m", lambda sample: float(sample.delta_measured[1])),
    Signal("ankle_frontal_nm", "N·m", lambda sample: sample.ankle_frontal_nm),
    Signal("ankle_sagittal_nm", "N·m", lambda sample: sample.ankle_sagittal_nm),
    Signal("force_left_n", "N", lambda sample: sample.result.balance.normal_forces[0]),
    Signal("force_right_n", "N", lambda sample: sample.result.balance.normal_forces[1]),
    Signal("tick_us", "µs", lambda sample: sample.slowest_tick_us),
)
TRACE_COLUMNS = tuple(signal.key for signal in SIGNALS)


def column_of(key: str, columns: tuple[str, ...] = TRACE_COLUMNS) -> int:
    """Where a signal stands in the rows of a table.

    Args:
        key: of the signal.
        columns: of the table.

    Raises:
        ValueError: there is no such signal; the message lists those that there are.
    """
    if key not in columns:
        raise ValueError(f"no signal {key!r}; there are: {', '.join(columns)}")
    return columns.index(key)
