"""The swing foot's way: its ends, and its velocity and acceleration against differences."""

import numpy as np
import pytest

from surefoot.gait.swing_foot import LANDING_SPEED_M_S, SEARCH_M, SEARCH_SPEED_M_S, SwingFoot
from surefoot.geometry.rotations import rotation_from_rpy, rotation_vector

LIFT, TIME = 0.05, 0.6


@pytest.fixture
def swing():
    start, target = np.array((0.0, 0.1, 0.08)), np.array((0.4, 0.12, 0.10))
    return SwingFoot(start, rotation_from_rpy(0.05, -0.1, 0.0), target, rotation_from_rpy(0.0, 0.0, 0.3), LIFT, TIME)


def test_it_leads_from_where_the_foot_is_over_the_lift_to_where_it_lands(swing):
    start, end = swing.at(0.0), swing.at(TIME)
    assert start.position == pytest.approx([0.0, 0.1, 0.08])
    assert start.velocity == pytest.approx(np.zeros(6))
    assert rotation_vector(start.rotation.T @ rotation_from_rpy(0.05, -0.1, 0.0)) == pytest.approx(
        np.zeros(3), abs=1e-9
    )
    assert end.position == pytest.approx([0.4, 0.12, 0.10])
    assert end.velocity == pytest.approx([0.0, 0.0, -LANDING_SPEED_M_S, 0.0, 0.0, 0.0])
    assert end.rotation == pytest.approx(rotation_from_rpy(0.0, 0.0, 0.3))
    heights = [swing.at(t).position[2] for t in np.linspace(0.0, TIME, 601)]
    assert max(heights) == pytest.approx(0.10 + LIFT, abs=1e-5)


def test_it_goes_on_down_where_no_ground_is_found_ever_faster_and_then_stops(swing):
    speeds = [-swing.at(TIME + t).velocity[2] for t in (0.0, 0.05, 0.09, 0.12)]
    assert speeds[0] == pytest.approx(LANDING_SPEED_M_S)
    assert speeds == sorted(speeds)
    assert speeds[2] == speeds[3] == pytest.approx(SEARCH_SPEED_M_S)
    late = swing.at(TIME + 10.0)
    assert late.position[2] == pytest.approx(0.10 - SEARCH_M)
    assert late.velocity == pytest.approx(np.zeros(6))


@pytest.mark.parametrize("time_s", [0.05, 0.2, 0.25, 0.3, 0.5, 0.58, 0.65, 0.75])
def test_velocity_and_acceleration_are_those_of_the_pose(swing, time_s):
    h = 1e-5
    before, now, after = swing.at(time_s - h), swing.at(time_s), swing.at(time_s + h)
    linear = (after.position - before.position) / (2 * h)
    angular = rotation_vector(after.rotation @ before.rotation.T) / (2 * h)
    assert now.velocity == pytest.approx(np.concatenate((linear, angular)), abs=1e-5)
    assert now.acceleration == pytest.approx((after.velocity - before.velocity) / (2 * h), abs=1e-3)
