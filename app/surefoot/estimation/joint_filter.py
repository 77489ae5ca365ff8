"""Joint angles less noisy than the encoders: their velocities say how they move, the encoders where they are."""

import math

import numpy as np

from surefoot.robot.sensing import SensorNoise


class JointFilter:
    """Follows the angles of all joints.

    The best rate for white noise in both: encoders off by sigma_q and velocities off by sigma_v, each sample anew, make
    a Kalman filter that follows the encoders with sigma_v / sigma_q. Without noise in the encoders it is not needed.

    Args:
        noise: what the sensors' data sheets say.
    """

    def __init__(self, noise: SensorNoise):
        self._rate = noise.joint_velocity / noise.joint_position if noise.joint_position > 0.0 else math.inf
        self._angles: np.ndarray | None = None
        self._velocities = np.zeros(0)

    def update(self, angles: np.ndarray, velocities: np.ndarray, step_s: float) -> np.ndarray:
        """Angles (n,) [rad] now, from measured ones [rad] and velocities (n,) [rad/s]; ``step_s`` since the last."""
        if self._angles is None or math.isinf(self._rate):
            self._angles = angles
        else:
            predicted = self._angles + (0.5 * step_s) * (self._velocities + velocities)
            self._angles = predicted + (1.0 - math.exp(-self._rate * step_s)) * (angles - predicted)
        self._velocities = velocities
        return self._angles

    def start(self, angles: np.ndarray, velocities: np.ndarray) -> None:
        """From angles (n,) [rad] and velocities (n,) [rad/s] that are told."""
        self._angles, self._velocities = angles, velocities
