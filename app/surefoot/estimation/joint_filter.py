"""Joints less noisy than their sensors: velocities say how angles move, encoders where they are."""

import math

import numpy as np

from surefoot.robot.sensing import SensorNoise

LAG_S2_RAD, LONGEST_LAG_S = 0.2, 0.02  # lag that noise in the velocities is worth: 4 ms for 0.02 rad/s
# However little noise a velocity has, its sum is not known better: in the 1 ms between two samples an acceleration of
# 2 rad/s2 changes it by this much, which is also the noise that IHMC's open-robotics-software calls low
FINEST_VELOCITY_RAD_S = 2e-3


class JointFilter:
    """Follows angles and velocities of all joints.

    The best rate for white noise in both: encoders off by sigma_q and velocities off by sigma_v, each sample anew, make
    a Kalman filter that follows the encoders with sigma_v / sigma_q. Without noise in the encoders it is not needed.
    Velocities without noise still count as off by ``FINEST_VELOCITY_RAD_S``: their sum alone would keep every error
    that it ever had.
    Velocities are smoothed with a lag in proportion to their noise: a chosen trade, no optimum.

    Args:
        noise: what the sensors' data sheets say.
    """

    def __init__(self, noise: SensorNoise):
        moves = max(noise.joint_velocity, FINEST_VELOCITY_RAD_S)
        self._rate = moves / noise.joint_position if noise.joint_position > 0.0 else math.inf
        self._angles: np.ndarray | None = None
        self._velocities = self._smooth = np.zeros(0)
        self._lag_s = min(LAG_S2_RAD * noise.joint_velocity, LONGEST_LAG_S)

    def update(self, angles: np.ndarray, velocities: np.ndarray, step_s: float) -> tuple[np.ndarray, np.ndarray]:
        """Angles (n,) [rad] and velocities (n,) [rad/s] now, from measured ones, ``step_s`` after the last."""
        if self._angles is None:
            self._angles, self._smooth = angles, velocities
        elif math.isinf(self._rate):
            self._angles = angles
        else:
            predicted = self._angles + (0.5 * step_s) * (self._velocities + velocities)
            self._angles = predicted + (1.0 - math.exp(-self._rate * step_s)) * (angles - predicted)
        if self._lag_s > 0.0:
            self._smooth = self._smooth + step_s / (self._lag_s + step_s) * (velocities - self._smooth)
        else:
            self._smooth = velocities
        self._velocities = velocities
        return self._angles, self._smooth

    def start(self, angles: np.ndarray, velocities: np.ndarray) -> None:
        """From angles (n,) [rad] and velocities (n,) [rad/s] that are told."""
        self._angles, self._velocities, self._smooth = angles, velocities, velocities
