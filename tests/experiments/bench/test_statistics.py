"""Intervals against published values and by hand, and ranges over seeds."""

import math

import numpy as np
import pytest

from surefoot.experiments.bench.statistics import (
    bootstrap_means,
    median_and_range,
    middle_95,
    share_interval,
    wilson_interval,
)


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


def test_seeds_of_a_case_add_no_trials():
    assert share_interval(27, 27, 9) == wilson_interval(9, 9)
    assert share_interval(20, 27, 9) == wilson_interval(20 / 3, 9)
    assert share_interval(7, 9, 9) == wilson_interval(7, 9)
    low, high = share_interval(20, 27, 9)
    assert low < wilson_interval(20, 27)[0] and high > wilson_interval(20, 27)[1]
    assert share_interval(0, 0, 0) == (0.0, 1.0)


def test_the_bootstrap_has_the_spread_of_a_mean_of_means():
    """Of two families with n cases each: sum of variance / n, over 4; the same every time; columns are paired."""
    random = np.random.default_rng(1)
    a, b = random.random((24, 1)), random.random((8, 1))
    families = [np.hstack((a, a - 0.1)), np.hstack((b, b - 0.3))]
    means = bootstrap_means(families)
    assert means[:, 0].mean() == pytest.approx(0.5 * (a.mean() + b.mean()), abs=2e-3)
    assert means[:, 0].std() == pytest.approx(0.5 * math.sqrt(a.var() / 24 + b.var() / 8), rel=0.03)
    assert middle_95(means[:, 0] - means[:, 1]) == (0.2, 0.2)
    assert (means == bootstrap_means(families)).all()
