"""Which changes of settings belong to one drag of a slider: they follow each other closely and share a setting."""

from collections.abc import Iterable

PAUSE_S = 1.5  # of the wall clock; a hand that rests longer begins again


class SliderDrags:
    """Numbers the drags."""

    def __init__(self) -> None:
        self._number = 0
        self._names: frozenset[str] = frozenset()
        self._latest_s = float("-inf")

    def number(self, names: Iterable[str], now_s: float) -> int:
        """The drag that a change of these settings belongs to, 1 or more.

        Args:
            names: settings that change.
            now_s: wall clock.
        """
        changed = frozenset(names)
        if now_s - self._latest_s > PAUSE_S or not changed & self._names:
            self._number, self._names = self._number + 1, frozenset()
        self._names |= changed
        self._latest_s = now_s
        return self._number

    def end(self) -> None:
        """Something else happened: whatever comes next is another drag."""
        self._latest_s = float("-inf")
