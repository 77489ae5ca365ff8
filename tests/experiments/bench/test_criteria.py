"""Survived: no fall, CoM at its place and at rest in the last second, the swing foot never on the ground."""

import numpy as np
import pytest

from surefoot.experiments.bench.criteria import judge

TICKS = 4000


def record(**changes) -> dict:
    still = {
        "fell": False, "time_s": 0.001 * np.arange(TICKS), "com_error_m": np.full(TICKS, 0.009),
        "com_speed_mps": np.full(TICKS, 0.019), "swing_force_n": np.zeros(TICKS),
    }  # fmt: skip
    return {**still, **changes}


def spike(value: float, tick: int, level: float = 0.0) -> np.ndarray:
    values = np.full(TICKS, level)
    values[tick] = value
    return values


def test_a_robot_at_rest_at_its_place_has_survived():
    survival = judge(**record())
    assert survival.outcome == "stands"
    assert (survival.com_error_m, survival.com_speed_mps, survival.swing_force_n) == (0.009, 0.019, 0.0)


def test_a_fall_is_a_fall_however_still_it_was_before():
    assert judge(**record(fell=True)).outcome == "falls"


@pytest.mark.parametrize(
    "changes",
    [
        {"com_error_m": spike(0.010, TICKS - 1)},
        {"com_error_m": spike(0.011, TICKS - 1000)},
        {"com_speed_mps": spike(0.02, TICKS - 1)},
        {"com_error_m": np.full(TICKS, np.nan)},
        {"com_speed_mps": spike(np.nan, TICKS - 1)},
        {"swing_force_n": spike(1.0, 5)},
    ],
)
def test_one_bad_tick_is_enough_to_be_unsettled(changes):
    assert judge(**record(**changes)).outcome == "unsettled"


@pytest.mark.parametrize("name", ["com_error_m", "com_speed_mps"])
def test_before_the_last_second_the_com_may_move(name):
    assert judge(**record(**{name: spike(0.5, TICKS - 1001)})).outcome == "stands"


def test_an_episode_shorter_than_a_second_is_judged_as_a_whole():
    short = {key: value[:100] if isinstance(value, np.ndarray) else value for key, value in record().items()}
    short["com_error_m"][0] = 0.02
    assert judge(**short).outcome == "unsettled"
