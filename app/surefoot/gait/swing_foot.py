"""The way of a foot from where it leaves the ground to where it is to land."""

import numpy as np

from surefoot.dynamics.terms import FootTerms
from surefoot.gait.footsteps import Footstep, StepTiming
from surefoot.gait.scale import BIP, GaitScale
from surefoot.geometry.rotations import rotation_from_rpy, rotation_from_vector, rotation_vector
from surefoot.record import record
from surefoot.task.reference import quintic

TRAVEL_FROM, TRAVEL_TO = 0.05, 0.9  # share of the swing in which the foot moves ahead
HIGHEST_AT = 0.42  # share of the swing
# Downwards where the ground is expected. Where it is not found the foot goes on faster: the robot is falling meanwhile.
# Found by trial down a ledge of 60 mm; not searched for further
LANDING_SPEED_M_S, SEARCH_SPEED_M_S, SEARCH_ACCELERATION = 0.08, 0.6, 6.0
SEARCH_M = 0.08  # so far below that height ground is searched


@record
class FootMotion:
    """A foot's wanted motion at one instant, of its ankle centre, world axes.

    Attributes:
        position: (3,) [m].
        rotation: (3, 3).
        velocity: (6,) linear [m/s] and angular [rad/s].
        acceleration: (6,) linear [m/s2] and angular [rad/s2].
    """

    position: np.ndarray
    rotation: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


class SwingFoot:
    """From one pose to another within a time, lifted between.

    Args:
        position: ankle centre (3,) at lift-off [m].
        rotation: orientation there (3, 3).
        target: ankle centre (3,) where the ground is expected [m].
        target_rotation: orientation to land with (3, 3).
        lift_m: highest point above the higher of both ends [m].
        duration_s: until the ground is expected [s].
        scale: of the robot.
    """

    def __init__(
        self,
        position: np.ndarray,
        rotation: np.ndarray,
        target: np.ndarray,
        target_rotation: np.ndarray,
        lift_m: float,
        duration_s: float,
        scale: GaitScale = BIP,
    ) -> None:
        self._start, self._target, self._duration = position.copy(), target.copy(), duration_s
        self._rotation, self._scale = target_rotation, scale
        self._turn = rotation_vector(rotation.dot(target_rotation.T))  # world, from the target's to the start's
        top = max(float(position[2]), float(target[2])) + lift_m
        rise, fall = HIGHEST_AT * duration_s, (1.0 - HIGHEST_AT) * duration_s
        self._rise = quintic_between((float(position[2]), 0.0), (top, 0.0), rise)
        self._fall = quintic_between((top, 0.0), (float(target[2]), -LANDING_SPEED_M_S * scale.speed), fall)
        self._rise_s = rise

    def move_target(self, point: np.ndarray) -> None:
        """Land elsewhere (2,) [m]."""
        self._target[:2] = point

    def at(self, time_s: float) -> FootMotion:
        """The wanted motion at a time since lift-off [s]."""
        share = time_s / self._duration
        span = TRAVEL_TO - TRAVEL_FROM
        s, s1, s2 = quintic((share - TRAVEL_FROM) / span)
        s1, s2 = s1 / (span * self._duration), s2 / (span * self._duration) ** 2
        way = self._target - self._start
        position, velocity, acceleration = self._start + s * way, np.zeros(6), np.zeros(6)
        velocity[:2], acceleration[:2] = s1 * way[:2], s2 * way[:2]
        position[2], velocity[2], acceleration[2] = self._height(time_s)
        velocity[3:], acceleration[3:] = -s1 * self._turn, -s2 * self._turn
        rotation = rotation_from_vector((1.0 - s) * self._turn).dot(self._rotation)
        return FootMotion(position, rotation, velocity, acceleration)

    def _height(self, time_s: float) -> tuple[float, float, float]:
        if time_s < self._rise_s:
            return polynomial(self._rise, max(time_s, 0.0))
        if time_s < self._duration:
            return polynomial(self._fall, time_s - self._rise_s)
        down, speed, acceleration = searched(time_s - self._duration, self._scale)
        return float(self._target[2]) - down, -speed, -acceleration


def swing_to(step: Footstep, height_m: float, now: FootTerms, timing: StepTiming, scale: GaitScale) -> SwingFoot:
    """From where a foot is to a step.

    Args:
        step: where it lands.
        height_m: of its ankle there.
        now: where it is.
        timing: of the steps.
        scale: of the robot.
    """
    target = np.array((*step.point.tolist(), height_m))
    rotation = rotation_from_rpy(0.0, 0.0, step.yaw_rad)
    start = now.position_ankle_in_world
    return SwingFoot(start, now.rotation_foot_to_world, target, rotation, timing.lift_m, timing.single_s, scale)


def searched(time_s: float, scale: GaitScale = BIP) -> tuple[float, float, float]:
    """How far down [m], how fast [m/s] and with what acceleration [m/s2], so long after ground was expected [s]."""
    first, last = LANDING_SPEED_M_S * scale.speed, SEARCH_SPEED_M_S * scale.speed
    acceleration, most = SEARCH_ACCELERATION * scale.acceleration, SEARCH_M * scale.length
    gains_s = (last - first) / acceleration
    if time_s < gains_s:
        down, speed = (first + 0.5 * acceleration * time_s) * time_s, first + acceleration * time_s
    else:
        down, speed, acceleration = last * time_s - 0.5 * (last - first) * gains_s, last, 0.0
    return (down, speed, acceleration) if down < most else (most, 0.0, 0.0)


def quintic_between(start: tuple[float, float], end: tuple[float, float], duration_s: float) -> np.ndarray:
    """Coefficients (6,), rising powers of time, between two (position, velocity) without acceleration at the ends."""
    (x0, v0), (x1, v1), T = start, end, duration_s
    d, a, b = x1 - x0, v0 * T, v1 * T
    c3, c4, c5 = 10.0 * d - 6.0 * a - 4.0 * b, -15.0 * d + 8.0 * a + 7.0 * b, 6.0 * d - 3.0 * a - 3.0 * b
    return np.array((x0, v0, 0.0, c3 / T**3, c4 / T**4, c5 / T**5))


def polynomial(coefficients: np.ndarray, t: float) -> tuple[float, float, float]:
    """Value, first and second derivative of a polynomial."""
    value = first = second = 0.0
    for c in reversed(coefficients.tolist()):
        second = second * t + 2.0 * first
        first = first * t + value
        value = value * t + c
    return value, first, second
