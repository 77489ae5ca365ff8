"""A foot that has landed, one that has grazed something, and one that has lost the ground again."""

import numpy as np
import pytest

from surefoot.gait.touchdown import (
    LOOSE_ACCELERATION,
    LOOSE_N,
    LOOSE_SPEED_M_S,
    TOUCH_FROM,
    TOUCH_N,
    TOUCH_S,
    Touchdown,
)

TICK_S = 1e-3
LATE = 0.9  # share of the swing


@pytest.fixture
def touchdown():
    return Touchdown(0.08)


def ticks_until_landed(touchdown, forces, share=LATE):
    """How many ticks of these forces it takes, beginning with a free foot; None when it never lands."""
    for i, force in enumerate((0.0, *forces)):
        if touchdown.has_landed(i * TICK_S, force, share):
            return i
    return None


def test_it_has_landed_when_it_has_felt_the_ground_for_a_while(touchdown):
    assert ticks_until_landed(touchdown, [2.0 * TOUCH_N] * 20) == round(TOUCH_S / TICK_S + 0.5)


def test_a_foot_that_grazes_the_edge_of_a_stone_swings_on(touchdown):
    graze = [580.0] * 5 + [0.0]
    assert ticks_until_landed(touchdown, graze * 4) is None
    assert ticks_until_landed(touchdown, [0.9 * TOUCH_N] * 50) is None


def test_what_it_feels_in_the_first_half_of_the_swing_is_no_landing(touchdown):
    assert ticks_until_landed(touchdown, [500.0] * 50, share=0.9 * TOUCH_FROM) is None


def test_a_foot_that_bounces_goes_down_ever_faster_until_it_feels_the_ground_again(touchdown):
    speeds = []
    for i in range(200):
        assert touchdown.has_bounced(i * TICK_S, 0.0, 900.0)
        speeds.append(touchdown.descent_m_s(i * TICK_S))
    assert speeds[0] == pytest.approx(0.08)
    assert np.diff(speeds[:50]) == pytest.approx(np.full(49, LOOSE_ACCELERATION * TICK_S))
    assert max(speeds) == LOOSE_SPEED_M_S
    assert not touchdown.has_bounced(0.2, 2.0 * LOOSE_N, 900.0)
    assert touchdown.has_bounced(0.3, 0.0, 900.0)
    assert touchdown.descent_m_s(0.3) == pytest.approx(0.08)


def test_in_the_air_with_both_feet_none_of_them_has_bounced(touchdown):
    assert not touchdown.has_bounced(0.0, 0.0, 0.0)
