"""The way of the ZMP that goes with footsteps."""

import math
from itertools import pairwise

import numpy as np
import pytest

from surefoot.gait.footsteps import Footstep, StepTiming
from surefoot.gait.zmp_plan import BRAKE_MARGIN_M, REST_FORWARD_M, braking_zmp, rest_in, zmp_ahead

TIMING = StepTiming(start_s=0.0, period_s=0.8, double_support_share=0.25, lift_m=0.05)


def step(foot, x, y, yaw=0.0):
    return Footstep(foot, np.array((x, y)), yaw)


def test_it_rests_ahead_of_the_ankle_where_the_foot_points_to():
    assert rest_in(step(0, 1.0, 2.0)) == pytest.approx([1.0 + REST_FORWARD_M, 2.0])
    assert rest_in(step(1, 1.0, 2.0, math.pi / 2)) == pytest.approx([1.0, 2.0 + REST_FORWARD_M])


def test_it_rests_while_one_foot_stands_crosses_while_both_do_and_ends_between_them():
    here, ahead = step(0, 0.0, 0.1), [step(1, 0.2, -0.1), step(0, 0.2, 0.1)]
    pieces = zmp_ahead(here, ahead, TIMING)
    assert [piece.duration_s for piece in pieces] == pytest.approx([0.6, 0.2, 0.6, 0.2])
    for one, other in pairwise(pieces):
        assert one.end == pytest.approx(other.start)
    assert pieces[0].start == pytest.approx(rest_in(here))
    assert pieces[0].end == pytest.approx(rest_in(here))
    assert pieces[2].start == pytest.approx(rest_in(ahead[0]))
    assert pieces[-1].end == pytest.approx(0.5 * (rest_in(ahead[0]) + rest_in(ahead[1])))


@pytest.mark.parametrize("yaw", [0.0, 0.7])
def test_it_brakes_most_where_the_sole_comes_nearest_to_the_capture_point(robot, yaw):
    foot, sole = step(0, 0.3, 0.1, yaw), robot.feet[0].sole
    inside = foot.point + foot.axes @ (0.05, -0.02)
    assert braking_zmp(foot, sole, inside) == pytest.approx(inside)
    capture = foot.point + foot.axes @ (0.5, -0.2)
    zmp = braking_zmp(foot, sole, capture)
    samples = np.stack(np.meshgrid(np.linspace(-0.2, 0.2, 161), np.linspace(-0.2, 0.2, 161)), -1).reshape(-1, 2)
    allowed = samples[(samples @ sole.normals.T <= sole.offsets - BRAKE_MARGIN_M).all(axis=1)]
    nearest = np.linalg.norm(foot.point + allowed @ foot.axes.T - capture, axis=1).min()
    assert np.linalg.norm(zmp - capture) <= nearest + 1e-9
    assert sole.signed_margin((zmp - foot.point) @ foot.axes) == pytest.approx(BRAKE_MARGIN_M)
    assert np.linalg.norm(zmp - capture) > nearest - 0.005
