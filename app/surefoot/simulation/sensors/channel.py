"""One sensor's samples on their way to the controller: how often they are taken, and how late they come."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

from surefoot.simulation.physics import TIMESTEP_S

T = TypeVar("T")


def whole_ticks(period_s: float) -> int:
    """A time between two samples [s] as ticks, one at least."""
    return max(1, round(period_s / TIMESTEP_S))


class Channel(Generic[T]):
    """Takes a sample every so many ticks and hands it on so many ticks later; the latest arrived one is held.

    MuJoCo's own history buffers delay signals too, but as they are: noise belongs to the sample, and the joint velocity
    is made from noisy ones, so that both come before the delay.

    Args:
        period_s: between two samples [s], in whole ticks.
        latency_s: from taking a sample to having it [s], in whole ticks. Until the first comes, the first is had.
    """

    def __init__(self, period_s: float, latency_s: float):
        self._period = whole_ticks(period_s)
        self._latency = round(latency_s / TIMESTEP_S)
        self._tick = 0
        self._samples: deque[tuple[int, T]] = deque()  # tick of its arrival, sample

    def pass_on(self, take: Callable[[], T]) -> T:
        """What the controller has in this tick; ``take`` is called in those that a sample is taken in."""
        if self._tick % self._period == 0:
            self._samples.append((self._tick + self._latency, take()))
        while len(self._samples) > 1 and self._samples[1][0] <= self._tick:
            self._samples.popleft()
        self._tick += 1
        return self._samples[0][1]
