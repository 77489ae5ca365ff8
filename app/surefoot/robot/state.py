"""The state of the robot at one instant, in Pinocchio's layout."""

import math

import numpy as np

from surefoot.record import record


@record
class RobotState:
    """Configuration and velocity.

    Attributes:
        q: (22,) pelvis position in world [m], pelvis orientation quaternion (x, y, z, w), 15 joint angles [rad].
        v: (21,) pelvis linear [m/s] and angular [rad/s] velocity, both in the pelvis frame, 15 joint rates [rad/s].
        time_s: time since the start of the run [s].
    """

    q: np.ndarray
    v: np.ndarray
    time_s: float = 0.0

    def is_finite(self) -> bool:
        """Whether every number is finite (the square of the length is finite only then)."""
        return math.isfinite(float(self.q.dot(self.q)) + float(self.v.dot(self.v)))
