"""Intervals: how sure a figure is."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

_Z_95 = 1.959963984540054  # two-sided 95 % of the normal distribution


def wilson_interval(successes: int, trials: int, z: float = _Z_95) -> tuple[float, float]:
    """Wilson's score interval of a proportion, 95 % by default; (0, 1) without trials."""
    if trials == 0:
        return 0.0, 1.0
    p = successes / trials
    spread = 1.0 + z * z / trials
    middle = (p + z * z / (2 * trials)) / spread
    half = z * math.sqrt(p * (1.0 - p) / trials + z * z / (4.0 * trials * trials)) / spread
    low = 0.0 if successes == 0 else max(0.0, middle - half)
    return low, 1.0 if successes == trials else min(1.0, middle + half)


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
