"""Where and when a step lands: moved and hurried to where the capture point goes that has left its plan."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from surefoot.gait.footsteps import NARROWEST_M, Footstep
from surefoot.gait.scale import BIP, GaitScale

# Found by trial, walking over stones and tiles of 30 mm (seeds 400 to 421); not searched for further
GAIN = 0.7  # of what the capture point will be off its plan when the step lands, the step is moved by so much
AHEAD_M, ASIDE_M = 0.08, 0.14  # by so much at most
WIDTHS_M = (NARROWEST_M, 0.34)  # nor nearer to the foot that stands or further aside: beyond, hips and ankles give out
UNTIL_S = 0.08  # before the landing the foot goes where it goes
LEAST_M = 0.01  # of the error is left to the feet that stand: level ground is walked over as planned
KEPT = 0.5  # of how far a step was moved, the next one is moved too: the robot comes back to its way by and by
NOTHING_M = 1e-3  # less than that is as planned
HURRIED_FROM_M, HURRIED_BY_M = 0.02, 0.04  # a robot so far off towards the foot in the air begins to hurry, and fully
MOST_HURRY = 2.2  # times as fast as planned
# A foot that is late goes on after the capture point by that share of its way, and so far at most. Found by trial down
# a ledge of 60 mm; not searched for further
LATE_GAIN, LATE_M = 0.7, 0.2
LATE_FROM_S = 0.02  # after its time: on level ground a foot lands within 0.01 s of it


class StepAdjustment:
    """Keeps how far the steps to come are moved from where they were planned; it is called in every tick of a swing.

    With the ZMP in the sole an error of the capture point grows by e^(omega t): known at lift-off, it says where the
    capture point will be when the step lands, and there the step is needed. Towards the foot in the air the capture
    point also comes too early: the swing is hurried.

    Args:
        omega: natural frequency [rad/s].
        scale: of the robot.

    Attributes:
        moved_m: steps to come are moved by so much (2,), world [m].
    """

    def __init__(self, omega: float, scale: GaitScale = BIP) -> None:
        self.moved_m, self._at_lift, self._omega, self._scale = np.zeros(2), np.zeros(2), omega, scale
        self._late_m = np.zeros(2)  # only the step that is being made

    def steps(self, planned: Sequence[Footstep]) -> tuple[Footstep, ...]:
        """The steps to come as they are moved."""
        if not (self.moved_m.any() or self._late_m.any()):
            return tuple(planned)
        moved = [replace(step, point=step.point + self.moved_m) for step in planned]
        if moved:
            moved[0] = replace(moved[0], point=moved[0].point + self._late_m)
        return tuple(moved)

    def landed(self) -> None:
        """Bring the next steps nearer to where they were planned."""
        left, self._late_m = KEPT * self.moved_m, np.zeros(2)
        self.moved_m = left if math.hypot(*left) > NOTHING_M else np.zeros(2)

    def lifted(self) -> None:
        """From here the step that begins is moved."""
        self._at_lift = self.moved_m

    def late(self, way: np.ndarray) -> None:
        """Move the step on: its foot finds no ground, and the robot goes on meanwhile.

        Args:
            way: of the capture point's plan since the foot is late (2,), world [m].
        """
        far, most = LATE_GAIN * math.hypot(*way.tolist()), LATE_M * self._scale.length
        self._late_m = (LATE_GAIN if far <= most else LATE_GAIN * most / far) * way

    def move(self, planned: Footstep, stance: Footstep, error: np.ndarray, left_s: float) -> np.ndarray:
        """Where the step that is being made should land by now (2,), world [m].

        Args:
            planned: as it was planned.
            stance: the foot that stands.
            error: capture point less its plan (2,), world [m].
            left_s: until the step is to land [s].
        """
        if left_s < UNTIL_S * self._scale.time:
            return planned.point + self.moved_m + self._late_m
        ahead, left = error.dot(stance.axes).tolist()
        grows, least = GAIN * math.exp(self._omega * left_s), LEAST_M * self._scale.sole
        moves = grows * _beyond(ahead, least), grows * _beyond(left, least)
        if not (any(moves) or self._at_lift.any()):
            self.moved_m = self._at_lift
            return planned.point
        place = (planned.point + self._at_lift - stance.point).dot(stance.axes)
        side = 1.0 if planned.foot == 0 else -1.0
        place[0] += _within(moves[0], AHEAD_M * self._scale.length)
        low, high = self._scale.widths(WIDTHS_M)
        high = max(high, side * float((planned.point - stance.point).dot(stance.axes)[1]))  # who plans more gets it
        aside = side * (float(place[1]) + _within(moves[1], ASIDE_M * self._scale.width))
        place[1] = side * min(max(aside, low), high)
        self.moved_m = stance.point + stance.axes.dot(place) - planned.point
        return planned.point + self.moved_m


def hurry(foot: int, stance: Footstep, error: np.ndarray, scale: GaitScale = BIP) -> float:
    """How many times as fast as planned a swing should go on.

    Args:
        foot: in the air.
        stance: the foot that stands.
        error: capture point less its plan (2,), world [m].
        scale: of the robot.
    """
    outward = float(stance.axes[:, 1].dot(error)) * (1.0 if foot == 0 else -1.0)
    share = min(max((outward / scale.length - HURRIED_FROM_M) / HURRIED_BY_M, 0.0), 1.0)
    return 1.0 + (MOST_HURRY - 1.0) * share


def _beyond(error_m: float, least_m: float) -> float:
    return math.copysign(max(abs(error_m) - least_m, 0.0), error_m)


def _within(way_m: float, most_m: float) -> float:
    return min(max(way_m, -most_m), most_m)
