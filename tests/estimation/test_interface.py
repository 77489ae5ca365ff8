"""The time between readings."""

import math
from itertools import pairwise

from surefoot.estimation.interface import step_between


def test_every_millisecond_is_the_same_step_however_late():
    times = [k * 1e-3 for k in range(5000, 6000)]
    assert {step_between(last, now) for last, now in pairwise(times)} == {1e-3}


def test_the_first_readings_come_after_no_time():
    assert step_between(math.nan, 3.0) == 0.0
