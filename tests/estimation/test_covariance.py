"""The covariance of ``invariant-ekf``: consistent with its errors, and honest of what no sensor tells."""

import dataclasses

import numpy as np
import pytest
from scipy.stats import chi2

from surefoot.estimation.invariant_ekf import (
    START_POSITION_M,
    START_SPEED_M_S,
    START_TILT_RAD,
    START_YAW_RAD,
    InvariantEKF,
)
from surefoot.geometry.rotations import quaternion_wxyz, rotation_from_vector, rotation_from_xyzw
from surefoot.robot.description import RobotState
from tests.support.swaying_robot import SwayingRobot

RUNS, TICKS = 10, 800  # long enough for a change of the foot


@pytest.fixture(scope="module")
def noise(sheet):
    return sheet(gyro=0.01, gyro_bias=0.005, accelerometer=0.05, accelerometer_bias=0.1, joint_position=1e-3)


@pytest.fixture(scope="module")
def known(noise):
    """The same with noise in the joint velocities too: beside perfect ones the encoders would hardly be followed."""
    return dataclasses.replace(noise, joint_velocity=0.02)


def as_told(state, rng):
    """A state that differs from the truth as much as the filter is told that it may."""
    spread = np.concatenate(
        (
            (START_TILT_RAD, START_TILT_RAD, START_YAW_RAD),
            3 * (START_SPEED_M_S,),
            3 * (START_POSITION_M,),
        )
    )
    error = spread * rng.normal(size=9)
    R = rotation_from_xyzw(state.q[3:7])
    believed = rotation_from_vector(-error[:3]) @ R
    w, x, y, z = quaternion_wxyz(believed)
    q, v = state.q.copy(), state.v.copy()
    q[:3], q[3:7] = q[:3] - error[6:], (x, y, z, w)
    v[:3] = believed.T @ (R @ state.v[:3] - error[3:6])
    return RobotState(q, v, state.time_s)


def test_errors_are_as_large_as_the_covariance_says(robot, mount, known, errors, spoil):
    """The normalised squared error is never above what chance allows of chi-square, nor far below it.

    Below, the filter is too careful: it counts on feet that move, and these stand still. How far below is chosen.
    """
    squares: dict[int, list[float]] = {200: [], 500: [], TICKS - 1: []}
    for seed in range(RUNS):
        rng = np.random.default_rng(seed)
        truth = SwayingRobot(robot, mount, amplitude_rad=0.06, period_s=0.6, seed=seed)
        estimator = InvariantEKF(robot, mount, known)
        estimator.reset(as_told(truth.at(0.0).state, rng))
        biases = known.gyro_bias * rng.normal(size=3), known.accelerometer_bias * rng.normal(size=3)
        for k in range(TICKS):
            now = truth.at(k * 1e-3)
            estimate = estimator.tick(spoil(now.readings, rng, known, *biases))
            if k in squares:
                error = errors(now, estimate)
                squares[k].append(error @ np.linalg.solve(estimate.covariance, error))
    means = {k: float(np.mean(values)) for k, values in squares.items()}
    low, high = chi2.ppf((0.001, 0.999), 9 * RUNS) / RUNS
    assert all(mean < high for mean in means.values())
    assert all(mean > 0.3 * low for mean in means.values())


def test_yaw_and_place_are_known_ever_less_and_tilt_is_not(robot, mount, noise):
    truth = SwayingRobot(robot, mount, amplitude_rad=0.05, period_s=0.5)
    estimator = InvariantEKF(robot, mount, noise)
    estimator.reset(truth.at(0.0).state)
    sigmas = []
    for k in range(3001):
        estimate = estimator.tick(truth.at(k * 1e-3).readings)
        if k in (1000, 3000):  # at rest, between two feet
            sigmas.append(np.sqrt(np.diag(estimate.covariance)))
    growth = sigmas[1] / sigmas[0]
    assert growth[2] > 1.5  # yaw
    assert growth[8] > 1.5  # height, which only the feet tell
    assert (growth[6:8] > 1.05).all()  # x and y, which also had the error of tilt
    assert (growth[[0, 1, 3, 4, 5]] < 1.0).all()  # tilt, velocity
