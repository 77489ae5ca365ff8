"""The state of the robot at one instant, in Pinocchio's layout."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True, eq=False)
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
        """Whether every number is finite (a sum is finite only then, and is cheaper than a test of each)."""
        return bool(np.isfinite(self.q.sum() + self.v.sum()))
