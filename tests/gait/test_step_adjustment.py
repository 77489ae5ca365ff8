"""Moved and hurried steps, against a pendulum that is integrated."""

import math

import numpy as np
import pytest

from surefoot.gait.footsteps import Footstep
from surefoot.gait.step_adjustment import (
    AHEAD_M,
    ASIDE_M,
    GAIN,
    KEPT,
    LATE_GAIN,
    LATE_M,
    LEAST_M,
    MOST_HURRY,
    UNTIL_S,
    WIDTHS_M,
    StepAdjustment,
    hurry,
)

OMEGA, STEP_S = 3.2, 1e-4
YAW = 0.4
STANCE = Footstep(1, np.array((0.3, -0.2)), YAW)  # the right foot stands
PLANNED = Footstep(0, STANCE.point + STANCE.axes @ (0.2, 0.22), YAW)


@pytest.fixture
def adjustment():
    found = StepAdjustment(OMEGA)
    found.lifted()
    return found


def test_a_step_goes_to_where_the_capture_point_will_be_off_its_plan(adjustment):
    error, left_s = STANCE.axes @ (0.01, 0.02), 0.3  # beyond what is left to the feet
    planned, real = np.array((0.35, -0.1)), np.array((0.35, -0.1)) + error
    for _ in range(round(left_s / STEP_S)):  # xi' = omega (xi - p), the same p for both
        planned = planned + STEP_S * OMEGA * (planned - STANCE.point)
        real = real + STEP_S * OMEGA * (real - STANCE.point)
    off = STANCE.axes.T @ (real - planned)
    more = error + STANCE.axes @ (LEAST_M, LEAST_M)
    moved = STANCE.axes.T @ (adjustment.move(PLANNED, STANCE, more, left_s) - PLANNED.point)
    assert moved == pytest.approx(GAIN * off, abs=1e-4)
    assert (moved > 0.0).all()  # ahead, and outward


def test_little_is_left_to_the_feet_and_much_has_its_limits(adjustment):
    assert adjustment.move(PLANNED, STANCE, STANCE.axes @ (0.009, -0.009), 0.5) == pytest.approx(PLANNED.point)
    far = STANCE.axes.T @ (adjustment.move(PLANNED, STANCE, STANCE.axes @ (1.0, 1.0), 0.2) - STANCE.point)
    assert far == pytest.approx((0.2 + AHEAD_M, min(0.22 + ASIDE_M, WIDTHS_M[1])))
    near = STANCE.axes.T @ (adjustment.move(PLANNED, STANCE, STANCE.axes @ (0.0, -1.0), 0.2) - STANCE.point)
    assert near == pytest.approx((0.2, WIDTHS_M[0]))


def test_shortly_before_the_landing_the_place_stays(adjustment):
    there = adjustment.move(PLANNED, STANCE, STANCE.axes @ (0.03, 0.0), 0.2)
    assert adjustment.move(PLANNED, STANCE, STANCE.axes @ (0.1, 0.1), 0.9 * UNTIL_S) == pytest.approx(there)


def test_the_steps_after_it_are_moved_ever_less(adjustment):
    first = adjustment.move(PLANNED, STANCE, STANCE.axes @ (0.03, 0.03), 0.3) - PLANNED.point
    adjustment.landed()
    (after,) = adjustment.steps([STANCE])
    assert after.point - STANCE.point == pytest.approx(KEPT * first)
    adjustment.lifted()
    assert adjustment.move(STANCE, PLANNED, np.zeros(2), 0.3) - STANCE.point == pytest.approx(KEPT * first)


@pytest.mark.parametrize(("foot", "side"), [(0, 1.0), (1, -1.0)])
def test_a_robot_that_falls_towards_the_foot_in_the_air_hurries_and_else_does_not(foot, side):
    stance = Footstep(1 - foot, np.zeros(2), YAW)
    outward = stance.axes @ (0.0, side)
    assert hurry(foot, stance, 0.1 * outward) == MOST_HURRY
    assert 1.0 < hurry(foot, stance, 0.04 * outward) < MOST_HURRY
    assert hurry(foot, stance, 0.01 * outward) == hurry(foot, stance, -0.1 * outward) == 1.0
    assert hurry(foot, stance, stance.axes @ (0.1, 0.0)) == 1.0
    assert math.isclose(hurry(foot, stance, 0.1 * outward + stance.axes @ (0.3, 0.0)), MOST_HURRY)


def test_a_foot_that_is_late_goes_on_after_the_capture_point_and_the_next_step_does_not(adjustment):
    way = STANCE.axes @ (0.1, 0.02)
    adjustment.late(way)
    assert adjustment.move(PLANNED, STANCE, np.zeros(2), -0.05) - PLANNED.point == pytest.approx(LATE_GAIN * way)
    here, then = adjustment.steps([PLANNED, STANCE])
    assert here.point - PLANNED.point == pytest.approx(LATE_GAIN * way)  # where it is expected is where it is led
    assert then.point == pytest.approx(STANCE.point)
    adjustment.late(50.0 * way)
    moved = adjustment.move(PLANNED, STANCE, np.zeros(2), -0.3) - PLANNED.point
    assert moved == pytest.approx(LATE_M * way / np.linalg.norm(way))
    adjustment.landed()
    assert adjustment.steps([STANCE])[0].point == pytest.approx(STANCE.point)
