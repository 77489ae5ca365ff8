"""Where the feet are set down."""

import math

import numpy as np
import pytest

from surefoot.gait.footsteps import Footstep, plan_footsteps

FEET = (Footstep(0, np.array((0.0, 0.1)), 0.0), Footstep(1, np.array((0.0, -0.1)), 0.0))


def test_straight_steps_alternate_and_the_last_sets_the_feet_beside_each_other():
    steps = plan_footsteps(FEET, steps=4, length_m=0.2, width_m=0.2, first_foot=1)
    assert [step.foot for step in steps] == [1, 0, 1, 0]
    assert np.array([step.point for step in steps]) == pytest.approx(
        np.array([(0.2, -0.1), (0.4, 0.1), (0.6, -0.1), (0.6, 0.1)])
    )


def test_a_turn_on_the_spot_keeps_the_middle_and_turns_to_the_left():
    steps = plan_footsteps(FEET, steps=7, length_m=0.0, width_m=0.2, turn_rad=math.radians(15.0))
    assert steps[-2].yaw_rad == steps[-1].yaw_rad == pytest.approx(math.radians(90.0))
    assert steps[-1].point + steps[-2].point == pytest.approx([0.0, 0.0], abs=1e-12)
    assert steps[-1].point == pytest.approx([-0.1, 0.0])  # the left foot, seen along +y


def test_along_an_arc_the_middle_goes_ahead_by_the_step_and_each_foot_stands_half_the_width_aside():
    steps, centre = plan_footsteps(FEET, steps=9, length_m=0.2, width_m=0.22, turn_rad=0.1), np.zeros(2)
    for number, step in enumerate(steps[:-1], start=1):
        assert step.yaw_rad == pytest.approx(0.1 * number)
        centre = centre + 0.2 * np.array((math.cos(0.1 * number), math.sin(0.1 * number)))
        aside = step.point - centre
        assert np.linalg.norm(aside) == pytest.approx(0.11)
        left = np.array((-math.sin(step.yaw_rad), math.cos(step.yaw_rad)))
        assert aside @ left == pytest.approx(0.11 if step.foot == 0 else -0.11)
