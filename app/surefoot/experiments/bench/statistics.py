"""Intervals: how sure a figure is."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

_Z_95 = 1.959963984540054  # two-sided 95 % of the normal distribution
_RESAMPLES = 10_000
_BOOTSTRAP_SEED = 0


def wilson_interval(successes: float, trials: int, z: float = _Z_95) -> tuple[float, float]:
    """Wilson's score interval of a proportion, 95 % by default; (0, 1) without trials."""
    if trials == 0:
        return 0.0, 1.0
    p = successes / trials
    spread = 1.0 + z * z / trials
    middle = (p + z * z / (2 * trials)) / spread
    half = z * math.sqrt(p * (1.0 - p) / trials + z * z / (4.0 * trials * trials)) / spread
    low = 0.0 if successes == 0 else max(0.0, middle - half)
    return low, 1.0 if successes == trials else min(1.0, middle + half)


def share_interval(successes: int, trials: int, cases: int) -> tuple[float, float]:
    """95 % interval of a share of trials that are several seeds of each of some cases.

    Wilson's of the same share with as many trials as there are cases. Seeds of a case are near copies of one another,
    so counting each as a trial of its own would make the interval too narrow; this counts them as one trial together,
    which is right when they always agree and too wide when they do not: never too sure. Unlike a bootstrap over the
    cases it says something where all of them agree (9 of 9). The cases are designed, not drawn: the interval reads them
    as if they were a sample of disturbances of their kind.
    """
    return wilson_interval(cases * successes / trials, cases) if trials else (0.0, 1.0)


def bootstrap_means(families: Sequence[np.ndarray]) -> np.ndarray:
    """Means over families of means over cases, of 10 000 resamples of the cases; the same ones whenever it is called.

    A case is drawn with all its seeds (they are within its value already) and for all controllers at once, so that
    differences of columns are paired; each family keeps its number of cases, and the families stay as they are.

    Args:
        families: of each, a value for every case and controller (cases, controllers).

    Returns:
        (resamples, controllers).
    """
    random = np.random.default_rng(_BOOTSTRAP_SEED)
    drawn = [values[random.integers(len(values), size=(_RESAMPLES, len(values)))].mean(axis=1) for values in families]
    return np.mean(drawn, axis=0)


def middle_95(resampled: np.ndarray) -> tuple[float, float]:
    """The percentile interval, six digits: the same on every machine. With few cases it is a little too narrow."""
    low, high = np.percentile(resampled, (2.5, 97.5))
    return round(float(low), 6) + 0.0, round(float(high), 6) + 0.0  # no -0.0


@dataclass(frozen=True)
class Range:
    """Median and range of a threshold over seeds."""

    median: float
    low: float
    high: float


def median_and_range(values: Sequence[float]) -> Range:
    """Of some values; those that are NaN are left out. NaN when nothing is left."""
    known = [value for value in values if not math.isnan(value)]
    if not known:
        return Range(math.nan, math.nan, math.nan)
    return Range(float(np.median(known)), min(known), max(known))
