"""The greatest value so far, asked for any earlier instant: what went wrong first is known only at the end of a run."""

import math

from surefoot.simulation.physics import TIMESTEP_S


class RunningExtreme:
    """Keeps the instants at which a value was greater than ever before, so that the ticks need not be kept."""

    def __init__(self) -> None:
        self._records: list[tuple[float, float]] = []

    def add(self, time_s: float, value: float) -> None:
        """A tick's value, ticks in order of time; NaN is passed over."""
        if value > (self._records[-1][1] if self._records else -math.inf):
            self._records.append((time_s, value))

    def before(self, time_s: float) -> float | None:
        """The greatest value of the ticks before the one at a time [s]; None where there is none."""
        earlier = (value for at, value in reversed(self._records) if at < time_s - 0.5 * TIMESTEP_S)
        return next(earlier, None)
