"""How long ticks took: median and percentiles of any number of them, in a bounded memory."""

from collections import Counter

import numpy as np

_BITS = 11  # significant ones that are kept of a duration: 0.1 % of it


class TickTimes:
    """Counts durations by their leading bits."""

    def __init__(self) -> None:
        self._counts: Counter[int] = Counter()

    def take(self, durations_ns: list[int]) -> None:
        """Count some more [ns], and empty their list."""
        for duration in durations_ns:
            dropped = max(0, duration.bit_length() - _BITS)
            self._counts[duration >> dropped << dropped] += 1
        durations_ns.clear()

    def percentile_us(self, percent: float) -> float | None:
        """The duration [us] that this share of them did not exceed, to 0.1 %; None where there are none."""
        if not self._counts:
            return None
        durations = sorted(self._counts)
        places = np.cumsum([self._counts[duration] for duration in durations])
        place = percent / 100.0 * (places[-1] - 1)
        return durations[int(np.searchsorted(places, place, side="right"))] * 1e-3
