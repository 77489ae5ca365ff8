"""Bisection finds the largest level survived with as few episodes as there can be."""

import math

import pytest

from surefoot.experiments.bench.cell_runner import bisect_levels, every_level


@pytest.mark.parametrize("count", [1, 2, 7, 15, 31, 12])
@pytest.mark.parametrize("search", [bisect_levels, every_level])
def test_a_known_threshold_is_found_wherever_it_lies(search, count):
    for threshold in range(-1, count):
        asked = []

        def survives(i, threshold=threshold, asked=asked):
            asked.append(i)
            return i <= threshold

        assert search(count, survives) == threshold
        assert len(asked) == len(set(asked))
        if search is bisect_levels:
            assert len(asked) <= math.ceil(math.log2(count + 1))


def test_every_level_stops_counting_at_the_first_failure():
    answers = [True, True, False, True]
    assert every_level(4, answers.__getitem__) == 1
