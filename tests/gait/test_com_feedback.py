"""The capture point's feedback, against a pendulum that is integrated with the ZMP it asks for."""

import math

import numpy as np
import pytest

from surefoot.gait.com_feedback import CAPTURE_GAIN, CoMFeedback

HEIGHT, GRAVITY, STEP_S = 0.95, 9.81, 1e-4
PLACE = np.array((0.1, -0.05))


@pytest.fixture
def feedback():
    return CoMFeedback(HEIGHT, GRAVITY)


def test_a_pendulum_comes_back_to_a_plan_that_rests_and_the_error_decays_as_it_should(feedback):
    com, velocity = np.array((0.13, -0.09, HEIGHT)), np.array((0.05, 0.1, 0.0))

    def error() -> np.ndarray:
        return com[:2] + velocity[:2] / math.sqrt(GRAVITY / HEIGHT) - PLACE

    first = error()
    for _ in range(round(0.5 / STEP_S)):
        velocity = velocity + STEP_S * feedback.acceleration(com, velocity, PLACE, PLACE)
        com = com + STEP_S * velocity
    assert error() == pytest.approx(first * math.exp(-CAPTURE_GAIN * 0.5), rel=0.01)


def test_the_force_it_asks_for_goes_through_the_zmp_it_stands_for(feedback):
    """(z'' + g) (x - p) = x'' (z - z_sole) of the point mass, with p = plan + (1 + k / omega) error."""
    com, velocity = np.array((0.12, 0.03, 0.9)), np.array((0.2, -0.1, 0.05))
    x, y, up = feedback.acceleration(com, velocity, PLACE, PLACE + 0.02)
    zmp = com[:2] - np.array((x, y)) * com[2] / (GRAVITY + up)
    omega = math.sqrt(GRAVITY / HEIGHT)
    away = com[:2] + velocity[:2] / omega - (PLACE + 0.02)
    assert zmp == pytest.approx(PLACE + (1.0 + CAPTURE_GAIN / omega) * away)


def test_the_height_is_kept_above_the_soles_and_follows_them_smoothly(feedback):
    high = np.array((0.1, -0.05, HEIGHT + 0.03))
    assert feedback.acceleration(high, np.zeros(3), PLACE, PLACE)[2] < 0.0  # too high: down
    for _ in range(1000):
        feedback.follow_soles(0.03, 1e-3)
    assert feedback.sole_height_m == pytest.approx(0.03, abs=1e-6)
    assert feedback.acceleration(high, np.zeros(3), PLACE, PLACE)[2] == pytest.approx(0.0, abs=1e-3)
    feedback.follow_soles(0.0, 0.04)
    assert 0.0 < feedback.sole_height_m < 0.03


def test_a_leg_that_reaches_back_is_as_long_as_one_below_a_com_that_is_carried_lower():
    feedback, reserved = (CoMFeedback(HEIGHT, GRAVITY, reserve_m=reserve_m) for reserve_m in (0.0, 0.02))
    for one in (feedback, reserved):
        one.lower_for(0.3)
    assert math.hypot(0.3, HEIGHT - feedback.lowered_m) == pytest.approx(HEIGHT)
    assert reserved.lowered_m == pytest.approx(feedback.lowered_m - 0.02)
    reserved.lower_for(0.05)
    assert reserved.lowered_m == 0.0
