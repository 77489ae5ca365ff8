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
from collections.abc import Sequence

import numpy as np
from scipy.linalg.lapack import dposv  # pyright: ignore[reportAttributeAccessIssue]  (made at import)

from surefoot.dynamics.turns import turn_of, vector_of
from surefoot.geometry.rotations import skew
from surefoot.geometry.triples import combine
from surefoot.record import record

ROTATION, VELOCITY, POSITION = slice(0, 3), slice(3, 6), slice(6, 9)
ANKLES = (slice(9, 12), slice(12, 15))
SOLES = (slice(15, 18), slice(18, 21))
GYRO_BIAS, ACCELEROMETER_BIAS = slice(21, 24), slice(24, 27)
ERRORS = 27

_SEEN = slice(9, 21)
_MOVING = 15  # errors before this one change by themselves, soles and biases only by their walks
# (12, 27): ankles and soles as told by the joints: e_d - e_p, e_C - e_R
_H = np.eye(12, ERRORS, 9) - np.eye(ERRORS)[[6, 7, 8, 6, 7, 8, 0, 1, 2, 0, 1, 2]]
_SKEW = np.concatenate([skew(axis).reshape(1, 9) for axis in np.eye(3)])  # (3, 9): x.dot(_SKEW) is skew(x), row by row


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
        gyro_bias, accelerometer_bias: 3 components each [rad/s], [m/s2], IMU axes.
        covariance: (27, 27) of the errors, in the order of the slices above.
    """

    def __init__(self, noise: FilterNoise, gravity: float):
        self._noise, self._gravity = noise, (0.0, 0.0, -gravity)
        self.rotation, self.vectors, self.soles = np.eye(3), np.zeros((4, 3)), [np.eye(3), np.eye(3)]
        self.gyro_bias = self.accelerometer_bias = (0.0, 0.0, 0.0)
        self.covariance = np.zeros((ERRORS, ERRORS))
        self._step_s, self._transition = math.nan, np.eye(_MOVING, ERRORS)
        self._walks = np.zeros(ERRORS)
        self._walks[GYRO_BIAS], self._walks[ACCELEROMETER_BIAS] = noise.gyro_walk**2, noise.accelerometer_walk**2
        self._walks[VELOCITY] = noise.accelerometer**2  # rotated isotropic noise is isotropic
        self._carried = np.zeros((_MOVING, 3))
        self._carried[:3] = np.eye(3)

    def propagate(
        self, gyro: Sequence[float], accelerometer: Sequence[float], step_s: float, ankles_and_soles: np.ndarray
    ) -> None:
        """Go on by one step.

        Args:
            gyro: 3 components, of the step, bias included, IMU axes [rad/s].
            accelerometer: likewise [m/s2].
            step_s: its length [s].
            ankles_and_soles: (12,) densities of how the ankles [m/sqrt(s)] and then the soles [rad/sqrt(s)] may move.
        """
        self._propagate_covariance(step_s, ankles_and_soles)
        before = self.rotation
        self.rotation = before.dot(turn_of(np.array(combine(step_s, gyro, -step_s, self.gyro_bias))))
        own = np.array(combine(1.0, accelerometer, -1.0, self.accelerometer_bias))
        twice = (before + self.rotation).dot(own).tolist()  # of either end
        change = combine(0.5 * step_s, twice, step_s, self._gravity)
        v, p = self.vectors[:2].tolist()
        mean = combine(1.0, v, 0.5, change)
        self.vectors[:2] = combine(1.0, v, 1.0, change), combine(1.0, p, step_s, mean)

    def _propagate_covariance(self, step_s: float, ankles_and_soles: np.ndarray) -> None:
        """P -> Phi P Phi^T + Q, with Phi = 1 + A step.

        Of A: e_R' = -R e_bg;  e_v' = g x e_R - R e_ba - v x R e_bg;  e_p' = e_v - p x R e_bg;  e_d' = -d x R e_bg.
        The gyro's noise enters as its bias does.
        """
        R, F, carried = self.rotation, self._transition, self._carried
        if step_s != self._step_s:
            self._step_s = step_s
            F[VELOCITY, ROTATION] = step_s * skew(np.array(self._gravity))
            F[POSITION, VELOCITY] = step_s * np.eye(3)
            F[POSITION, ROTATION] = 0.5 * step_s * F[VELOCITY, ROTATION]
        carried[3:] = self.vectors.dot(_SKEW).reshape(12, 3)
        turned = carried.dot(R) * -step_s
        F[:, GYRO_BIAS] = turned
        F[VELOCITY, ACCELEROMETER_BIAS] = R * -step_s
        P, moved = self.covariance, F.dot(self.covariance)
        P[:_MOVING, _MOVING:] = rest = moved[:, _MOVING:]
        P[_MOVING:, :_MOVING] = rest.T
        if step_s > 0.0:
            moved[:, GYRO_BIAS] += turned * (self._noise.gyro**2 / step_s)
        P[:_MOVING, :_MOVING] = moved.dot(F.T)
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
        ankles = positions.dot(R.T) - (self.vectors[2:] - self.vectors[1])
        soles = [vector_of(R.dot(seen).dot(sole.T)) for seen, sole in zip(rotations, self.soles, strict=True)]
        innovation = np.concatenate((ankles.reshape(6), *soles))
        PH = P.dot(_H.T)
        S = _H.dot(PH) + noise
        _, gain, failed = dposv(S, PH.T)
        if failed:
            self.covariance.fill(np.nan)  # no covariance any more: nothing that follows is to be believed
        P -= PH.dot(gain)
        self.covariance = P = P + P.T
        P *= 0.5
        self._move(innovation.dot(gain))

    def _move(self, error: np.ndarray) -> None:
        turn = turn_of(error[ROTATION])
        self.rotation = turn.dot(self.rotation)
        self.vectors = self.vectors.dot(turn.T) + error[3:15].reshape(4, 3)
        self.soles = [turn_of(error[of]).dot(sole) for of, sole in zip(SOLES, self.soles, strict=True)]
        self.gyro_bias = combine(1.0, self.gyro_bias, 1.0, error[GYRO_BIAS].tolist())
        self.accelerometer_bias = combine(1.0, self.accelerometer_bias, 1.0, error[ACCELEROMETER_BIAS].tolist())
