"""Both estimators against a trajectory whose readings Pinocchio computed: value, sign, biases, what drifts."""

import numpy as np
import pytest

from surefoot.estimation.registry import estimator_named
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.robot.description import RobotState
from tests.support.swaying_robot import SwayingRobot

OURS = ("anchor", "invariant-ekf")
TILT, YAW, VELOCITY, POSITION = slice(0, 2), 2, slice(3, 6), slice(6, 9)
STEP_S = 1e-3
# Part of a wrong tilt that is left after 3 s. anchor is held back by soles that were told as wrong, at 2 1/s, and give
# way at 1 1/s: of its 0.3 1/s by gravity a third acts, and all of it just after each change of the foot
TILT_LEFT = {"anchor": (0.5, 0.75), "invariant-ekf": (-0.02, 0.02)}
GYRO_BIAS, ACCELEROMETER_BIAS = np.array((0.005, -0.004, 0.003)), np.array((0.05, -0.04, 0.08))


def built(name, robot, mount, noise):
    build = estimator_named(name).build
    assert build is not None
    return build(robot, mount, noise)


@pytest.mark.parametrize("name", OURS)
def test_without_noise_it_believes_the_truth_while_the_base_moves_and_the_robot_changes_its_foot(
    name, robot, mount, sheet, errors
):
    truth = SwayingRobot(robot, mount, first=rotation_from_rpy(0.05, -0.08, 0.7))
    estimator = built(name, robot, mount, sheet())
    estimator.reset(truth.at(0.0).state)
    worst, moved = np.zeros(9), 0.0
    for k in range(1600):
        now = truth.at(k * STEP_S)
        estimate = estimator.tick(now.readings)
        worst = np.maximum(worst, np.abs(errors(now, estimate)))
        moved = max(moved, float(np.abs(now.state.v[:6]).max()))
        assert np.allclose(estimate.state.v[3:6], now.state.v[3:6], rtol=0.0, atol=1e-3)
        assert np.array_equal(estimate.state.q[7:], now.readings.joint_positions)
    assert moved > 0.5  # or it would be no test
    # what is left is of the order of the step, 1 ms of 0.5 m/s and more
    assert worst[:3].max() < 5e-5
    assert worst[VELOCITY].max() < 1e-3
    assert worst[POSITION].max() < 1e-3


@pytest.mark.parametrize("accelerometer_bias", [ACCELEROMETER_BIAS, np.zeros(3)], ids=["both", "gyro alone"])
@pytest.mark.parametrize("name", OURS)
def test_it_finds_the_biases_and_keeps_its_tilt(name, accelerometer_bias, robot, mount, sheet, errors):
    truth = SwayingRobot(robot, mount)
    noise = sheet(gyro_bias=0.005, accelerometer_bias=0.1 if accelerometer_bias.any() else 0.0)
    estimator = built(name, robot, mount, noise)
    estimator.reset(truth.at(0.0).state)
    rates, tilts = [], []
    for k in range(3000):
        now = truth.at(k * STEP_S)
        exact = now.readings
        exact.gyro[:] += GYRO_BIAS
        exact.accelerometer[:] += accelerometer_bias
        estimate = estimator.tick(exact)
        rates.append(np.abs(estimate.state.v[3:6] - now.state.v[3:6]).max())
        tilts.append(np.abs(errors(now, estimate)[TILT]).max())
    assert rates[0] > 0.9 * np.abs(GYRO_BIAS).max()  # nothing is known of it at first
    assert max(rates[-100:]) < 0.2 * np.abs(GYRO_BIAS).max()
    # what the gyro's bias turns in 0.3 s, or the accelerometer's leans when 0.3 of it is not found
    assert max(tilts) < 0.3 * max(np.abs(GYRO_BIAS).max(), np.abs(accelerometer_bias[:2]).max() / robot.gravity)


@pytest.mark.parametrize("name", OURS)
@pytest.mark.parametrize("axis", range(3))
def test_a_wrong_attitude_comes_right_in_tilt_and_stays_wrong_in_yaw(name, axis, robot, mount, sheet, errors):
    """Gravity tells roll and pitch. Nothing tells yaw: the same readings fit every heading."""
    truth = SwayingRobot(robot, mount, amplitude_rad=0.05)
    noise = sheet(gyro=1e-3, accelerometer=0.02, joint_position=1e-4, accelerometer_bias=1e-3, gyro_bias=1e-4)
    estimator = built(name, robot, mount, noise)
    told = truth.at(0.0).state
    estimator.reset(RobotState(_turned(told.q, axis, 0.02), told.v))
    for k in range(3000):
        now = truth.at(k * STEP_S)
        estimate = estimator.tick(now.readings)
    left = float(errors(now, estimate)[axis])
    if axis == YAW:
        assert left == pytest.approx(-0.02, abs=2e-4)
    else:
        low, high = TILT_LEFT[name]
        assert 0.02 * low < -left < 0.02 * high


def _turned(q, axis, angle):
    """The configuration with its base turned about a world axis."""
    x, y, z, w = q[3:7]
    half = np.zeros(3)
    half[axis] = np.sin(0.5 * angle)
    c, v = np.cos(0.5 * angle), np.array((x, y, z))
    turned = c * v + w * half + np.cross(half, v)
    return np.concatenate((q[:3], turned, (c * w - half @ v,), q[7:]))
