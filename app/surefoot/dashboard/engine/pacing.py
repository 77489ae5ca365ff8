"""How many ticks are due by the wall clock, and how well the simulation keeps up with it."""

from surefoot.simulation.physics import TIMESTEP_S

# What could not be caught up by then is given up: simulated time slows, nothing spirals. A robot that barely keeps up
# makes good for a slow quarter of a second in the seconds after it
_MOST_BEHIND_S = 0.25
_LATE_S = 0.06
_WINDOW_S = 1.0


class Pacer:
    """Turns wall-clock time into ticks.

    Args:
        now: wall clock [s].
    """

    def __init__(self, now: float) -> None:
        self.real_time_factor = 0.0
        self._last, self._owed_s = now, 0.0
        self._window_start, self._window_ticks = now, 0

    def due(self, now: float, speed: float, *, playing: bool) -> int:
        """Ticks to make now."""
        elapsed, self._last = now - self._last, now
        if not playing:
            self._owed_s = 0.0
            return 0
        self._owed_s = min(self._owed_s + elapsed * speed, _MOST_BEHIND_S)
        return int(self._owed_s / TIMESTEP_S)

    @property
    def behind(self) -> bool:
        """Whether so much is still owed after a request that the simulation cannot keep up."""
        return self._owed_s > _LATE_S

    def advanced(self, ticks: int, now: float) -> None:
        """Say how many ticks were made."""
        self._owed_s -= ticks * TIMESTEP_S
        self._window_ticks += ticks
        if (span := now - self._window_start) >= _WINDOW_S:
            self.real_time_factor = self._window_ticks * TIMESTEP_S / span
            self._window_start, self._window_ticks = now, 0
