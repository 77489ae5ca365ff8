"""What ideal sensors would say: the only thing of the plant that a robot which does not know everything gets."""

import numpy as np

from surefoot.record import record
from surefoot.robot.sensing import FootSensing


@record
class IdealSignals:
    """The signals without any error, of the millisecond that has just passed.

    Attributes:
        gyro: (3,) angular velocity of the IMU at the end of it, with which it turned, IMU axes [rad/s].
        accelerometer: (3,) specific force during it, in the IMU's axes at its beginning [m/s2].
        joint_positions: (n,) now [rad].
        joint_velocities: (n,) now [rad/s].
        feet: what the ground did to the feet during it.
    """

    gyro: np.ndarray
    accelerometer: np.ndarray
    joint_positions: np.ndarray
    joint_velocities: np.ndarray
    feet: FootSensing
