"""How long ticks took: as NumPy has it, to the 0.1 % that are kept."""

import numpy as np
import pytest

from surefoot.experiments.runs.tick_times import TickTimes


@pytest.mark.parametrize("percent", [50.0, 99.0])
@pytest.mark.parametrize("count", [1, 2, 7, 5000])
def test_percentiles(percent, count):
    durations = np.random.default_rng(count).lognormal(12.0, 1.0, count).astype(int).tolist()
    wanted = 1e-3 * np.percentile(durations, percent, method="lower")
    times = TickTimes()
    for start in range(0, count, 50):
        some = durations[start : start + 50]
        times.take(some)
        assert some == []
    assert times.percentile_us(percent) == pytest.approx(wanted, rel=1e-3)


def test_there_is_none_of_nothing():
    assert TickTimes().percentile_us(50.0) is None


def test_what_it_keeps_does_not_grow_with_the_run():
    times, random = TickTimes(), np.random.default_rng(1)
    kept = []
    for _ in range(2):
        times.take(random.integers(200_000, 800_000, 40_000).tolist())
        kept.append(len(times._counts))
    assert kept[1] < 1.05 * kept[0] < 5000
