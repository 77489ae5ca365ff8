"""Wilson's interval against published values, and ranges over seeds."""

import math

import pytest

from app.experiments.lab.statistics import median_and_range, wilson_interval


@pytest.mark.parametrize(
    ("successes", "trials", "low", "high"),
    [
        (81, 263, 0.2553, 0.3662),  # Newcombe 1998, Statistics in Medicine 17, table I, method 3
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0000, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ],
)
def test_wilson_interval_has_the_published_values(successes, trials, low, high):
    assert wilson_interval(successes, trials) == pytest.approx((low, high), abs=5e-5)


def test_wilson_interval_is_symmetric_and_stays_between_0_and_1():
    low, high = wilson_interval(20, 20)
    assert high == 1.0
    assert low == pytest.approx(1.0 - wilson_interval(0, 20)[1])
    assert wilson_interval(0, 0) == (0.0, 1.0)


def test_median_and_range_leave_out_what_was_refused():
    found = median_and_range([3.0, math.nan, 1.0, 2.0])
    assert (found.median, found.low, found.high) == (2.0, 1.0, 3.0)
    assert math.isnan(median_and_range([math.nan]).median)
