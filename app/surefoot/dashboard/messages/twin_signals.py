"""How the two robots of a twin run are compared: one entry for each column of the table, taken from their recorders."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

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
