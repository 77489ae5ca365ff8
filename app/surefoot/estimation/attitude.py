"""Attitude and velocity of an IMU by a complementary filter: what turns fast by the gyro, where up is by the rest.

The accelerometer alone cannot tell tilt from acceleration. A velocity that the legs tell can: where the believed
velocity, made from the accelerometer and the believed attitude, runs away from it, the attitude is wrong (after Hua,
"Attitude estimation for accelerated vehicles using GPS/INS measurements", Control Engineering Practice 18, 2010).
"""

from collections.abc import Sequence

import numpy as np

from surefoot.dynamics.turns import turn_of
from surefoot.geometry.triples import combine

# All rates are chosen, on Bip; the second of a pair is at most about the first squared over four: nothing overshoots.
# 1/s with which the believed velocity follows that of the legs: a bias b of the accelerometer leaves b / 10, and of
# the legs' noise what is slower than 1.6 Hz goes through
VELOCITY_RATE = 10.0
# 1/s with which the attitude follows the accelerometer, 1/s2 the gyro's bias (double pole at 0.15 1/s: far slower than
# a robot sways, whose acceleration is no tilt)
TILT_RATE, TILT_BIAS_RATE = 0.3, 0.02
# Likewise for the soles, which do not turn but may settle (poles at 1.7 and 0.3 1/s)
FEET_RATE, FEET_BIAS_RATE = 2.0, 0.5
# And while the biases are not known at all (double pole at 4 1/s: done within the second that it is used)
START_FEET_RATE, START_FEET_BIAS_RATE = 8.0, 16.0


class AttitudeFilter:
    """Follows attitude, velocity and the biases.

    Args:
        gravity: g [m/s2].

    Attributes:
        rotation: R (3, 3) IMU axes -> world.
        velocity: 3 components, of the IMU in world [m/s].
        gyro_bias, accelerometer_bias: 3 components each [rad/s], [m/s2], IMU axes.
    """

    def __init__(self, gravity: float):
        self._gravity = gravity
        self.rotation, self.velocity = np.eye(3), (0.0, 0.0, 0.0)
        self.gyro_bias = self.accelerometer_bias = (0.0, 0.0, 0.0)

    def predict(self, gyro: Sequence[float], accelerometer: Sequence[float], step_s: float) -> None:
        """Go on by one step with the readings of the step, 3 components each, biases included."""
        before = self.rotation
        self.rotation = before.dot(turn_of(np.array(combine(step_s, gyro, -step_s, self.gyro_bias))))
        own = np.array(combine(1.0, accelerometer, -1.0, self.accelerometer_bias))
        twice = (before + self.rotation).dot(own).tolist()  # of either end
        x, y, z = combine(1.0, self.velocity, 0.5 * step_s, twice)
        self.velocity = x, y, z - step_s * self._gravity

    def correct(
        self,
        velocity: Sequence[float],
        by_feet: Sequence[float],
        hold: float,
        step_s: float,
        bias_rate: float,
        *,
        gyro_unknown: bool = False,
    ) -> None:
        """Pull towards what the legs say.

        With R = Exp(e) R^, a wrong attitude makes a wrong acceleration e x (g up), and the velocity settles that much
        over VELOCITY_RATE away: up x (velocity - v^) VELOCITY_RATE / g is the part of e that is tilt. A gyro bias that
        is b too large turns R^ by R b too slowly, so that e grows along R b.

        Args:
            velocity: 3 components, of the IMU by the legs, in world [m/s].
            by_feet: 3 components, rotation vector from the attitude by the soles to the believed one, world [rad].
            hold: from 0 to 1, how much the feet are to be trusted.
            step_s: time since the last call.
            bias_rate: 1/s with which the accelerometer's bias is found where the attitude is known, so that the
                accelerometer is what is wrong; 0 where it is not.
            gyro_unknown: nothing is known of the gyro's bias yet: it is found fast.
        """
        off = x, y, _ = combine(1.0, velocity, -1.0, self.velocity)
        if bias_rate > 0.0:  # both poles there
            self.velocity = combine(1.0, self.velocity, hold * 2.0 * bias_rate * step_s, off)
            wrong = np.array(off).dot(self.rotation).tolist()
            self.accelerometer_bias = combine(1.0, self.accelerometer_bias, -hold * bias_rate**2 * step_s, wrong)
            tilt = 0.0, 0.0, 0.0
        else:
            self.velocity = combine(1.0, self.velocity, hold * VELOCITY_RATE * step_s, off)
            share = hold * VELOCITY_RATE / self._gravity
            tilt = -share * y, share * x, 0.0
        turn_rate, drift_rate = FEET_RATE, FEET_BIAS_RATE
        if gyro_unknown:
            turn_rate, drift_rate = START_FEET_RATE, START_FEET_BIAS_RATE
        drift = np.array(combine(-drift_rate * hold, by_feet, TILT_BIAS_RATE, tilt)).dot(self.rotation).tolist()
        self.gyro_bias = combine(1.0, self.gyro_bias, -step_s, drift)
        turn = np.array(combine(-step_s * turn_rate * hold, by_feet, step_s * TILT_RATE, tilt))
        self.rotation = turn_of(turn).dot(self.rotation)
