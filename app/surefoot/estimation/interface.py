"""What every estimator takes and gives: readings in, a believed state out."""

import math
from typing import Protocol

import numpy as np

from surefoot.record import record
from surefoot.robot.description import RobotState
from surefoot.robot.sensing import FootSensing, SensorReadings

# Where each error stands in a covariance; world axes
ORIENTATION, VELOCITY, POSITION = slice(0, 3), slice(3, 6), slice(6, 9)


@record
class Estimate:
    """What is believed of the robot in one tick.

    Attributes:
        state: configuration and velocity, as a controller takes them; its time is that of the readings.
        sensing: what controller and gait are told of the feet.
        covariance: (9, 9) of the errors of base orientation (rotation vector from the believed to the true one)
            [rad], of the velocity [m/s] and position [m] of the base's origin; all in world axes.
    """

    state: RobotState
    sensing: FootSensing
    covariance: np.ndarray


class Estimator(Protocol):
    """Anything that turns readings into a believed state; it sees nothing else of the world."""

    def reset(self, state: RobotState) -> None:
        """Start from a state that it is told: where it is and where it faces, no reading says."""
        ...

    def tick(self, readings: SensorReadings) -> Estimate:
        """Take the readings of one millisecond."""
        ...


def step_between(last_s: float, now_s: float) -> float:
    """Time since the last readings [s], 0 at the first ones, where ``last_s`` is NaN.

    In whole nanoseconds: the last digits of a difference of two times change from tick to tick, and what depends on the
    step alone would be computed anew each time.
    """
    return 0.0 if math.isnan(last_s) else round(now_s - last_s, 9)
