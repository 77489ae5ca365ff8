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
        self._lag_s = min(LAG_S2_RAD * noise.joint_velocity, LONGEST_LAG_S)
        self._angles: np.ndarray | None = None
        self._velocities = self._smooth = np.zeros(0)
        self._step_s, self._weights = math.nan, np.zeros((2, 5))

    def update(self, angles: np.ndarray, velocities: np.ndarray, step_s: float) -> tuple[np.ndarray, np.ndarray]:
        """Angles (n,) [rad] and velocities (n,) [rad/s] now, from measured ones, ``step_s`` after the last."""
        if self._angles is None:
            self.start(angles, velocities)
            return angles, velocities
        if step_s != self._step_s:
            self._step_s, self._weights = step_s, self._weights_after(step_s)
        parts = (self._angles, self._velocities, self._smooth, angles, velocities)
        now, smooth = self._weights.dot(parts)
        self._angles, self._velocities, self._smooth = now, velocities, smooth
        return now, smooth

    def start(self, angles: np.ndarray, velocities: np.ndarray) -> None:
        """From angles (n,) [rad] and velocities (n,) [rad/s] that are told."""
        self._angles, self._velocities, self._smooth = angles, velocities, velocities

    def _weights_after(self, step_s: float) -> np.ndarray:
        """(2, 5): angles and smooth velocities now, by those and the measured velocities before, and measured ones."""
        follow = 1.0 if math.isinf(self._rate) else 1.0 - math.exp(-self._rate * step_s)
        predicted, share = 1.0 - follow, step_s / (self._lag_s + step_s) if self._lag_s > 0.0 else 1.0
        mean = 0.5 * step_s * predicted  # of the velocities at either end
        return np.array(((predicted, mean, 0.0, follow, mean), (0.0, 0.0, 1.0 - share, 0.0, share)))
