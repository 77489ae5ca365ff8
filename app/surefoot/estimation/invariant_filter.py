"""The right-invariant extended Kalman filter of an IMU above two feet: propagation, correction, covariance.

After Hartley, Ghaffari, Eustice and Grizzle, "Contact-aided invariant extended Kalman filtering for robot state
estimation" (arXiv 1904.09251). Errors are told in the world: for orientation R, velocity v, position p, ankles d_i and
sole orientations C_i,

    R = Exp(e_R) R^,  v = Exp(e_R) v^ + e_v,  p = Exp(e_R) p^ + e_p,  d_i = Exp(e_R) d_i^ + e_di,  C_i = Exp(e_Ci) C_i^

(^: believed; e_v and so on to first order), and b = b^ + e_b for the biases of gyro and accelerometer. Then, biases
apart, neither the propagation of these errors nor what the joint angles say of them depends on the believed state, so
that a wrong belief cannot make yaw or position seem observable. We differ from the paper in three points: the soles'
orientations are states too, since flat soles do not turn; both feet stay in the state, a foot in the air with a
process noise that lets it go anywhere; and an error is "true minus believed".
"""

import math

import numpy as np
from scipy.linalg.lapack import dposv  # pyright: ignore[reportAttributeAccessIssue]  (made at import)

from surefoot.geometry.rotations import rotation_vector, skew, turn_by
from surefoot.record import record

ROTATION, VELOCITY, POSITION = slice(0, 3), slice(3, 6), slice(6, 9)
ANKLES = (slice(9, 12), slice(12, 15))
SOLES = (slice(15, 18), slice(18, 21))
GYRO_BIAS, ACCELEROMETER_BIAS = slice(21, 24), slice(24, 27)
ERRORS = 27

# Ankles and soles as told by the joints: e_d - e_p, e_C - e_R
_SEEN = slice(9, 21)
_MOVING = 15  # errors before this one change by themselves, soles and biases only by their walks
_FROM = np.array((6, 7, 8, 6, 7, 8, 0, 1, 2, 0, 1, 2))


@record
class FilterNoise:
    """White noise and random walks that the filter counts on.

    Attributes:
        gyro, accelerometer: densities [rad/s/sqrt(Hz)], [m/s2/sqrt(Hz)].
        gyro_walk, accelerometer_walk: of the biases [rad/s/sqrt(s)], [m/s2/sqrt(s)].
    """

    gyro: float
    accelerometer: float
    gyro_walk: float
    accelerometer_walk: float


class InvariantFilter:
    """State, covariance, and the two halves of a tick.

    Args:
        noise: of the IMU.
        gravity: g [m/s2].

    Attributes:
        rotation: R (3, 3) IMU axes -> world.
        vectors: (4, 3) v [m/s], p, left and right ankle [m], in world.
        soles: C_i (3, 3), foot axes -> world, left and right.
        gyro_bias, accelerometer_bias: (3,) [rad/s], [m/s2], IMU axes.
        covariance: (27, 27) of the errors, in the order of the slices above.
    """

    def __init__(self, noise: FilterNoise, gravity: float):
        self._noise, self._gravity = noise, np.array((0.0, 0.0, -gravity))
        self.rotation, self.vectors, self.soles = np.eye(3), np.zeros((4, 3)), [np.eye(3), np.eye(3)]
        self.gyro_bias, self.accelerometer_bias = np.zeros(3), np.zeros(3)
        self.covariance = np.zeros((ERRORS, ERRORS))
        self._step_s, self._transition = math.nan, np.eye(_MOVING, ERRORS)
        self._walks = np.zeros(ERRORS)
        self._walks[GYRO_BIAS], self._walks[ACCELEROMETER_BIAS] = noise.gyro_walk**2, noise.accelerometer_walk**2
        self._walks[VELOCITY] = noise.accelerometer**2  # rotated isotropic noise is isotropic
        self._carried = np.zeros((_MOVING, 3))
        self._carried[:3] = np.eye(3)

    def propagate(
        self, gyro: np.ndarray, accelerometer: np.ndarray, step_s: float, ankles_and_soles: np.ndarray
    ) -> None:
        """Go on by one step.

        Args:
            gyro: (3,) of the step, bias included, IMU axes [rad/s].
            accelerometer: (3,) likewise [m/s2].
            step_s: its length [s].
            ankles_and_soles: (12,) densities of how the ankles [m/sqrt(s)] and then the soles [rad/sqrt(s)] may move.
        """
        self._propagate_covariance(step_s, ankles_and_soles)
        before, v = self.rotation, self.vectors[0]
        self.rotation = before.dot(turn_by((gyro - self.gyro_bias) * step_s))
        force = (before + self.rotation).dot(accelerometer - self.accelerometer_bias)  # twice: of either end
        change = (0.5 * force + self._gravity) * step_s
        self.vectors[1] += step_s * (v + 0.5 * change)
        self.vectors[0] = v + change

    def _propagate_covariance(self, step_s: float, ankles_and_soles: np.ndarray) -> None:
        """P -> Phi P Phi^T + Q, with Phi = 1 + A step.

        Of A: e_R' = -R e_bg;  e_v' = g x e_R - R e_ba - v x R e_bg;  e_p' = e_v - p x R e_bg;  e_d' = -d x R e_bg.
        The gyro's noise enters as its bias does.
        """
        R, F, carried = self.rotation, self._transition, self._carried
        if step_s != self._step_s:
            self._step_s = step_s
            F[VELOCITY, ROTATION] = step_s * skew(self._gravity)
            F[POSITION, VELOCITY] = step_s * np.eye(3)
            F[POSITION, ROTATION] = 0.5 * step_s * F[VELOCITY, ROTATION]
        for i, (x, y, z) in enumerate(self.vectors.tolist()):
            rows = carried[3 * i + 3 : 3 * i + 6]
            rows[0, 1], rows[0, 2], rows[1, 2] = -z, y, -x
            rows[1, 0], rows[2, 0], rows[2, 1] = z, -y, x
        turned = carried.dot(R) * -step_s
        F[:, GYRO_BIAS] = turned
        F[VELOCITY, ACCELEROMETER_BIAS] = R * -step_s
        P, moved = self.covariance, F.dot(self.covariance)
        P[:_MOVING, :_MOVING] = moved.dot(F.T)
        P[:_MOVING, _MOVING:] = moved[:, _MOVING:]
        P[_MOVING:, :_MOVING] = moved[:, _MOVING:].T
        if step_s > 0.0:
            P[:_MOVING, :_MOVING] += turned.dot(turned.T) * (self._noise.gyro**2 / step_s)
        walks = self._walks
        walks[_SEEN] = ankles_and_soles * ankles_and_soles
        P.flat[:: ERRORS + 1] += walks * step_s

    def correct(self, positions: np.ndarray, rotations: np.ndarray, noise: np.ndarray) -> None:
        """Take in what the joint angles say of the feet.

        Args:
            positions: (2, 3) ankles from the IMU [m], IMU axes.
            rotations: (2, 3, 3) foot axes -> IMU axes.
            noise: (12, 12) covariance of both in world axes: ankles, then soles.
        """
        R, P = self.rotation, self.covariance
        innovation = np.empty(12)
        innovation[:6] = (positions.dot(R.T) - (self.vectors[2:] - self.vectors[1])).ravel()
        for i, sole in enumerate(self.soles):
            innovation[6 + 3 * i : 9 + 3 * i] = rotation_vector(R.dot(rotations[i]).dot(sole.T))
        PH = P[:, _SEEN] - P.take(_FROM, axis=1)
        S = PH[_SEEN] - PH.take(_FROM, axis=0) + noise
        _, gain, failed = dposv(S, PH.T)
        if failed:
            self.covariance.fill(np.nan)  # no covariance any more: nothing that follows is to be believed
        error = innovation.dot(gain)
        P = P - PH.dot(gain)
        self.covariance = 0.5 * (P + P.T)
        self._move(error)

    def _move(self, error: np.ndarray) -> None:
        turn = turn_by(error[ROTATION])
        self.rotation = turn.dot(self.rotation)
        self.vectors = self.vectors.dot(turn.T) + error[3:15].reshape(4, 3)
        self.soles = [turn_by(error[of]).dot(sole) for of, sole in zip(SOLES, self.soles, strict=True)]
        self.gyro_bias = self.gyro_bias + error[GYRO_BIAS]
        self.accelerometer_bias = self.accelerometer_bias + error[ACCELEROMETER_BIAS]
