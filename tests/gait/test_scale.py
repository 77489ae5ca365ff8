"""The gait of a robot of another size: exactly Bip's for Bip, and the same in its own lengths and times for others."""

import dataclasses
import math

import numpy as np
import pytest

from surefoot.experiments.scenario.reference_spec import WALKING_GAINS, ReferenceSpec, even_walk, walking_gains
from surefoot.gait.com_feedback import CoMFeedback
from surefoot.gait.emergency_step import LANDING_S, REACH_AHEAD_M, REACH_ASIDE_M, landing_time, step_reach
from surefoot.gait.footsteps import AHEAD_M, ASIDE_M, Footstep, step_limits
from surefoot.gait.scale import BIP, GaitScale, gait_scale
from surefoot.gait.step_adjustment import StepAdjustment, hurry
from surefoot.gait.swing_foot import SwingFoot, searched
from surefoot.gait.touchdown import LOOSE_N, TOUCH_N, TOUCH_S, Touchdown
from surefoot.gait.zmp_plan import REST_FORWARD_M, rest_in
from surefoot.momentum.zmp import natural_frequency
from surefoot.robot.description import load_robot
from surefoot.task.posture import DEFAULT_COM_HEIGHT, standing_com_height, walking_com_height

GRAVITY = 9.81
# A robot that is Bip at half the length everywhere: times shrink by sqrt(2), forces by 8
HALF = GaitScale(length=0.5, time=math.sqrt(0.5), force=0.125, sole=0.5, sole_middle=0.5, width=0.5)
STANCE = Footstep(1, np.array((0.0, 0.0)), 0.0)


def test_every_ratio_of_bip_is_exactly_one():
    scale = gait_scale(load_robot("bip"))
    assert [getattr(scale, field.name) for field in dataclasses.fields(GaitScale)] == [1.0] * 6
    assert scale.speed == scale.acceleration == scale.rate == scale.stiffness == 1.0


def test_bip_walks_with_its_own_sizes_and_gains():
    robot = load_robot("bip")
    assert walking_gains(robot) == WALKING_GAINS
    assert even_walk(robot) == {
        name: getattr(ReferenceSpec, name) for name in ("step_length_m", "step_width_m", "step_period_s", "lift_m")
    }
    assert walking_com_height(robot) == standing_com_height(robot) == DEFAULT_COM_HEIGHT
    assert (landing_time(robot), step_reach(robot)) == (LANDING_S, (REACH_AHEAD_M, REACH_ASIDE_M))
    assert step_limits(gait_scale(robot)) == (AHEAD_M, ASIDE_M)


def test_the_ratios_of_a_robot_are_those_of_its_legs_height_weight_and_soles():
    """``offset``: 34.8 kg, legs of 0.633 m, soles from -65 to 135 mm, ankles 0.2 m apart."""
    scale = gait_scale(load_robot("offset"))
    assert scale.force == pytest.approx(34.8 / 104.81, abs=1e-3)
    assert scale.length == pytest.approx(0.633 / 0.82, abs=1e-3)
    assert scale.sole == pytest.approx(0.09 / 0.18)
    assert scale.sole_middle == pytest.approx(0.035 / 0.025)
    assert scale.width == pytest.approx(0.2 / 0.22)
    assert scale.time**2 == pytest.approx(standing_com_height(load_robot("offset")) / DEFAULT_COM_HEIGHT)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.95, 1.2])
def test_a_swing_of_half_the_size_is_the_same_swing_at_half_the_size(share):
    start, target = np.array((0.0, 0.1, 0.08)), np.array((0.4, 0.1, 0.08))
    whole = SwingFoot(start, np.eye(3), target, np.eye(3), 0.05, 0.6)
    half = SwingFoot(0.5 * start, np.eye(3), 0.5 * target, np.eye(3), 0.025, 0.6 * HALF.time, HALF)
    one, other = whole.at(0.6 * share), half.at(0.6 * HALF.time * share)
    assert other.position == pytest.approx(0.5 * one.position)
    assert other.velocity == pytest.approx(HALF.speed * one.velocity)
    assert other.acceleration == pytest.approx(HALF.acceleration * one.acceleration)


@pytest.mark.parametrize("time_s", [0.02, 0.08, 0.12, 0.3])
def test_ground_is_searched_alike(time_s):
    down, speed, acceleration = searched(time_s)
    found = searched(HALF.time * time_s, HALF)
    assert found == pytest.approx((0.5 * down, HALF.speed * speed, HALF.acceleration * acceleration))


def test_the_com_is_led_alike():
    """Half the pendulum with half the errors asks for the same acceleration, as gravity is the same for both."""
    whole = CoMFeedback(0.9, GRAVITY)
    half = CoMFeedback(0.45, GRAVITY, scale=HALF)
    com, velocity, zmp, capture = (np.array(v) for v in ((0.02, 0.01, 0.88), (0.1, -0.2, 0.05), (0.0, 0.0), (0.1, 0.0)))
    asked = whole.acceleration(com, velocity, zmp, capture)
    found = half.acceleration(0.5 * com, HALF.speed * velocity, 0.5 * zmp, 0.5 * capture)
    assert found == pytest.approx(asked)
    for feedback, size in ((whole, 1.0), (half, 0.5)):
        feedback.lower_for(0.3 * size)
    assert half.lowered_m == pytest.approx(0.5 * whole.lowered_m) and half.lowered_m > 0.0


def test_a_step_is_moved_and_hurried_alike():
    planned = Footstep(0, np.array((0.2, 0.22)), 0.0)
    small = Footstep(0, 0.5 * planned.point, 0.0)
    for error in (np.array((0.03, 0.0)), np.array((-0.2, 0.03)), np.array((0.0, 0.05))):
        whole = StepAdjustment(natural_frequency(0.9, GRAVITY))
        half = StepAdjustment(natural_frequency(0.45, GRAVITY), HALF)
        there = whole.move(planned, STANCE, error, 0.3)
        assert half.move(small, STANCE, 0.5 * error, 0.3 * HALF.time) == pytest.approx(0.5 * there)
        assert hurry(0, STANCE, 0.5 * error, HALF) == pytest.approx(hurry(0, STANCE, error, BIP))


def test_a_lighter_foot_has_landed_with_less_force():
    light = Touchdown(0.08, GaitScale(force=0.3))
    assert not light.has_landed(0.0, 0.0, 0.9)
    assert light.has_landed(TOUCH_S + 1e-3, 0.31 * TOUCH_N, 0.9)
    assert not light.has_landed(TOUCH_S + 2e-3, 0.29 * TOUCH_N, 0.9)
    assert light.has_bounced(1.0, 0.29 * LOOSE_N, 100.0) and not light.has_bounced(1.0, 0.31 * LOOSE_N, 100.0)


def test_the_zmp_rests_near_the_middle_of_the_sole():
    robot = load_robot("offset")
    ahead = float(rest_in(STANCE, gait_scale(robot))[0])
    assert ahead == pytest.approx(0.8 * 0.5 * (0.135 - 0.065))
    assert ahead == pytest.approx(REST_FORWARD_M * 1.4)


def test_gains_of_a_small_robot_stay_critically_damped_and_within_what_controllers_take():
    gains, bip = walking_gains(load_robot("offset")), WALKING_GAINS
    for what in ("foot", "pelvis", "lumbar"):
        damping = gains[f"{what}_damping"] / math.sqrt(gains[f"{what}_stiffness"])
        assert damping == pytest.approx(bip[f"{what}_damping"] / math.sqrt(bip[f"{what}_stiffness"]))
    assert gains["foot_stiffness"] == 400.0
    scale = gait_scale(load_robot("offset"))
    assert gains["pelvis_stiffness"] == pytest.approx(100.0 * scale.stiffness)
