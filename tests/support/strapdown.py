"""The plainest estimator: it adds up what the IMU says, and believes every joint."""

import numpy as np

from surefoot.estimation.interface import Estimate
from surefoot.estimation.registry import EstimatorEntry
from surefoot.geometry.rotations import quaternion_wxyz, rotation_from_vector
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.sensing import ImuMount, SensorNoise, SensorReadings

TICK_S = 0.001


class Strapdown:
    """Strapdown integration of an IMU at the origin of the free body; its covariance is a made-up constant."""

    def __init__(self, robot: RobotDescription, imu: ImuMount, noise: SensorNoise):
        assert imu.body == robot.base
        self._gravity = np.array((0.0, 0.0, -robot.gravity))
        self._started = False

    def reset(self, state: RobotState) -> None:
        """Stand where it is told to stand."""
        x, y, z, w = state.q[3:7]
        vector = 2.0 * np.arctan2(np.linalg.norm((x, y, z)), w) * np.array((x, y, z))
        length = np.linalg.norm((x, y, z))
        self.rotation = rotation_from_vector(vector / length if length > 0.0 else np.zeros(3))
        self.position, self.velocity = state.q[:3].copy(), self.rotation.dot(state.v[:3])

    def tick(self, readings: SensorReadings) -> Estimate:
        """Velocity by the specific force, position by the velocity, orientation by the gyro: as MuJoCo does a step."""
        if self._started:  # the first readings are of the state that it was told
            self.velocity = self.velocity + TICK_S * (self.rotation.dot(readings.accelerometer) + self._gravity)
            self.position = self.position + TICK_S * self.velocity
            self.rotation = self.rotation.dot(rotation_from_vector(TICK_S * readings.gyro))
        self._started = True
        w, x, y, z = quaternion_wxyz(self.rotation)
        q = np.concatenate((self.position, (x, y, z, w), readings.joint_positions))
        v = np.concatenate((self.rotation.T.dot(self.velocity), readings.gyro, readings.joint_velocities))
        return Estimate(RobotState(q, v, readings.time_s), readings.feet, 1e-6 * np.eye(9))


class Failing(Strapdown):
    """Raises after 50 ms."""

    def tick(self, readings: SensorReadings) -> Estimate:
        """Or earlier."""
        if readings.time_s > 0.0495:
            raise RuntimeError("no idea where I am")
        return super().tick(readings)


class GivesNan(Strapdown):
    """Believes a joint to be nowhere after 50 ms."""

    def tick(self, readings: SensorReadings) -> Estimate:
        """Or earlier."""
        estimate = super().tick(readings)
        if readings.time_s > 0.0495:
            estimate.state.q[9] = np.nan
        return estimate


STRAPDOWN = EstimatorEntry("strapdown", "adds up what the IMU says", Strapdown)
FAILING = EstimatorEntry("failing", "raises", Failing)
NAN = EstimatorEntry("gives-nan", "gives what is no number", GivesNan)
NO_ENTRY = "not an entry"
THIEF = EstimatorEntry("truth", "a name of ours", Strapdown)
BUILDLESS = EstimatorEntry("buildless", "cannot be built", None)
