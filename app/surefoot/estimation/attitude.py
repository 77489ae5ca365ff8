"""Attitude and velocity of an IMU by a complementary filter: what turns fast by the gyro, where up is by the rest.

The accelerometer alone cannot tell tilt from acceleration. A velocity that the legs tell can: where the believed
velocity, made from the accelerometer and the believed attitude, runs away from it, the attitude is wrong (after Hua,
"Attitude estimation for accelerated vehicles using GPS/INS measurements", Control Engineering Practice 18, 2010).
"""

import numpy as np

from surefoot.geometry.rotations import cross, turn_by

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
        velocity: (3,) of the IMU in world [m/s].
        gyro_bias, accelerometer_bias: (3,) [rad/s], [m/s2], IMU axes.
    """

    def __init__(self, gravity: float):
        self._gravity, self._down, self._up = gravity, np.array((0.0, 0.0, -gravity)), np.array((0.0, 0.0, 1.0))
        self.rotation, self.velocity = np.eye(3), np.zeros(3)
        self.gyro_bias, self.accelerometer_bias = np.zeros(3), np.zeros(3)

    def predict(self, gyro: np.ndarray, accelerometer: np.ndarray, step_s: float) -> None:
        """Go on by one step with the readings (3,) of the step, biases included."""
        before = self.rotation
        self.rotation = before.dot(turn_by((gyro - self.gyro_bias) * step_s))
        force = (before + self.rotation).dot(accelerometer - self.accelerometer_bias)  # twice: of either end
        self.velocity = self.velocity + step_s * (0.5 * force + self._down)

    def correct(self, velocity: np.ndarray, by_feet: np.ndarray, hold: float, step_s: float, bias_rate: float) -> None:
        """Pull towards what the legs say.

        With R = Exp(e) R^, a wrong attitude makes a wrong acceleration e x (g up), and the velocity settles that much
        over VELOCITY_RATE away: up x (velocity - v^) VELOCITY_RATE / g is the part of e that is tilt. A gyro bias that
        is b too large turns R^ by R b too slowly, so that e grows along R b.

        Args:
            velocity: (3,) of the IMU by the legs, in world [m/s].
            by_feet: (3,) rotation vector from the believed attitude to that by the soles, world [rad].
            hold: from 0 to 1, how much the feet are to be trusted.
            step_s: time since the last call.
            bias_rate: 1/s with which the accelerometer's bias is found where the attitude is known, so that the
                accelerometer is what is wrong; 0 where it is not.
        """
        off = velocity - self.velocity
        if bias_rate > 0.0:  # both poles there
            self.velocity = self.velocity + (hold * 2.0 * bias_rate * step_s) * off
            bias = (hold * bias_rate * bias_rate * step_s) * off.dot(self.rotation)
            self.accelerometer_bias = self.accelerometer_bias - bias
            turn, drift = (START_FEET_RATE * hold) * by_feet, (START_FEET_BIAS_RATE * hold) * by_feet
        else:
            self.velocity = self.velocity + (hold * VELOCITY_RATE * step_s) * off
            error = cross(self._up, off) * (hold * VELOCITY_RATE / self._gravity)
            turn = (FEET_RATE * hold) * by_feet + TILT_RATE * error
            drift = (FEET_BIAS_RATE * hold) * by_feet + TILT_BIAS_RATE * error
        self.gyro_bias = self.gyro_bias - step_s * drift.dot(self.rotation)
        self.rotation = turn_by(step_s * turn).dot(self.rotation)
