"""What can be plotted: one entry for each number, its column's name and where it is taken from.

Those of the live run first, then how the two robots of a twin run are compared.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from surefoot.control.interface import ControlOutput
    from surefoot.simulation.belief import Belief
    from surefoot.simulation.loop import TickResult

_MM_PER_M, _DEG_PER_RAD = 1e3, math.degrees(1.0)


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


def _believed(number: "Callable[[Belief], np.ndarray]", axis: int, scale: float) -> Callable[[Sample], float]:
    """A component of what an estimator believed; NaN where there is none."""

    def extract(sample: Sample) -> float:
        belief = sample.result.belief
        return math.nan if belief is None else scale * float(number(belief)[axis])

    return extract


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
    Signal("dcm_error_x_mm", "mm", _believed(lambda belief: belief.dcm_error, 0, _MM_PER_M)),
    Signal("dcm_error_y_mm", "mm", _believed(lambda belief: belief.dcm_error, 1, _MM_PER_M)),
    Signal("dcm_sigma_x_mm", "mm", _believed(lambda belief: belief.dcm_sigma, 0, _MM_PER_M)),
    Signal("dcm_sigma_y_mm", "mm", _believed(lambda belief: belief.dcm_sigma, 1, _MM_PER_M)),
    Signal("tilt_error_x_deg", "°", _believed(lambda belief: belief.orientation_error, 0, _DEG_PER_RAD)),
    Signal("tilt_error_y_deg", "°", _believed(lambda belief: belief.orientation_error, 1, _DEG_PER_RAD)),
    Signal("tilt_sigma_x_deg", "°", _believed(lambda belief: belief.orientation_sigma, 0, _DEG_PER_RAD)),
    Signal("tilt_sigma_y_deg", "°", _believed(lambda belief: belief.orientation_sigma, 1, _DEG_PER_RAD)),
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


Tick = Mapping[str, float]  # a recorder's column -> its value in one tick

TIME = "time_s"
COM = ("com_x_m", "com_y_m", "com_z_m")


@dataclass(frozen=True, slots=True)
class TwinSignal:
    """One number of the comparison.

    Attributes:
        key: name of its column, which ends with the unit.
        source: column of the recorder that it is made of.
        scale: from the unit of the one to that of the other.
        compare: makes one of the first robot's value and the twin's.
    """

    key: str
    source: str
    scale: float
    compare: Callable[[float, float], float]

    def extract(self, first: Tick, twin: Tick) -> float:
        """Its value for a tick of both."""
        return self.scale * self.compare(first[self.source], twin[self.source])


def _of_first(first: float, twin: float) -> float:
    return first


def _of_twin(first: float, twin: float) -> float:
    return twin


def _difference(first: float, twin: float) -> float:
    return twin - first


TWIN_SIGNALS = (
    TwinSignal("time_s", TIME, 1.0, _of_first),
    TwinSignal("com_x_mm", "com_x_m", 1e3, _difference),
    TwinSignal("com_y_mm", "com_y_m", 1e3, _difference),
    TwinSignal("margin_first_mm", "zmp_margin_m", 1e3, _of_first),
    TwinSignal("margin_twin_mm", "zmp_margin_m", 1e3, _of_twin),
    TwinSignal("frontal_first_nm", "delta_measured_x_nm", 1.0, _of_first),
    TwinSignal("frontal_twin_nm", "delta_measured_x_nm", 1.0, _of_twin),
    TwinSignal("sagittal_first_nm", "delta_measured_y_nm", 1.0, _of_first),
    TwinSignal("sagittal_twin_nm", "delta_measured_y_nm", 1.0, _of_twin),
)
TWIN_COLUMNS = tuple(signal.key for signal in TWIN_SIGNALS)
# What of the recorder travels for every tick: the signals' sources, and the CoM, which tells when two robots go apart
COMPARED = tuple(dict.fromkeys((TIME, *COM, *(signal.source for signal in TWIN_SIGNALS))))
