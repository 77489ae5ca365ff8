"""Noise of sensors, errors of an estimate."""

from collections.abc import Callable

import numpy as np
import pytest

from surefoot.estimation.interface import Estimate
from surefoot.geometry.rotations import rotation_from_rpy, rotation_from_xyzw, rotation_vector
from surefoot.robot.sensing import ImuMount, SensorNoise, SensorReadings
from tests.support.swaying_robot import Instant

NO_NOISE = dict.fromkeys(SensorNoise.__slots__, 0.0)


@pytest.fixture(scope="session")
def mount() -> ImuMount:
    """On the trunk, above three joints, at an angle: nothing cancels by chance."""
    return ImuMount("trunk", np.array((0.05, 0.02, 0.1)), rotation_from_rpy(0.3, -0.2, 1.0))


@pytest.fixture(scope="session")
def sheet() -> Callable[..., SensorNoise]:
    """What data sheets say; no noise but what is told."""
    return lambda **known: SensorNoise(**{**NO_NOISE, **known})


@pytest.fixture(scope="session")
def errors() -> Callable[[Instant, Estimate], np.ndarray]:
    """(9,) true minus believed: rotation vector [rad], velocity [m/s], position [m] of the base in the world."""

    def difference(truth: Instant, estimate: Estimate) -> np.ndarray:
        one, other = truth.state, estimate.state
        R, R_believed = rotation_from_xyzw(one.q[3:7]), rotation_from_xyzw(other.q[3:7])
        turned = rotation_vector(R @ R_believed.T)
        return np.concatenate((turned, R @ one.v[:3] - R_believed @ other.v[:3], one.q[:3] - other.q[:3]))

    return difference


@pytest.fixture(scope="session")
def spoil() -> Callable[..., SensorReadings]:
    """Perfect readings, a generator and data sheets -> noisy ones, with given biases of gyro and accelerometer."""

    def noisy(readings, rng, noise, gyro_bias=0.0, accelerometer_bias=0.0):
        joints = len(readings.joint_positions)
        return SensorReadings(
            readings.time_s,
            readings.gyro + gyro_bias + noise.gyro * rng.normal(size=3),
            readings.accelerometer + accelerometer_bias + noise.accelerometer * rng.normal(size=3),
            readings.joint_positions + noise.joint_position * rng.normal(size=joints),
            readings.joint_velocities + noise.joint_velocity * rng.normal(size=joints),
            readings.feet,
        )

    return noisy
