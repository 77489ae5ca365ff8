"""What a gait that was found by trial on Bip is multiplied by for another robot.

Two robots whose legs move alike have the same Froude number: lengths go with the leg, times with sqrt(h / g). How far
the ZMP may be led goes with the sole instead, which is small on many a robot with long legs.
"""

import math
from functools import lru_cache

from surefoot.record import record
from surefoot.robot.description import RobotDescription

_BIP_FOOT_SPREAD_M, _BIP_SOLE_MIDDLE_M = 0.11, 0.025


@record
class GaitScale:
    """Ratios to Bip; its own are exactly 1, so that no digit of its gait changes.

    Attributes:
        length: of the legs' lengths: steps, lifts, ways.
        time: sqrt of the ratio of G's heights: periods and time constants.
        force: of the weights.
        sole: of the soles' widths: errors that a sole can correct, and margins in it.
            sole_middle: of how far the middles of the soles lie ahead of the ankles.
        width: of the distances between the feet.
    """

    length: float = 1.0
    time: float = 1.0
    force: float = 1.0
    sole: float = 1.0
    sole_middle: float = 1.0
    width: float = 1.0

    @property
    def speed(self) -> float:
        """Length over time."""
        return self.length / self.time

    @property
    def acceleration(self) -> float:
        """Length over time squared."""
        return self.length / self.time**2

    @property
    def rate(self) -> float:
        """1 over time: gains on errors, damping."""
        return 1.0 / self.time

    @property
    def stiffness(self) -> float:
        """1 over time squared."""
        return 1.0 / self.time**2

    def lengths(self, ends: tuple[float, float]) -> tuple[float, float]:
        """A range [m] in proportion to the legs."""
        return self.length * ends[0], self.length * ends[1]

    def widths(self, ends: tuple[float, float]) -> tuple[float, float]:
        """A range [m] across the heading, in proportion to the distance between the feet."""
        return self.width * ends[0], self.width * ends[1]


BIP = GaitScale()


@lru_cache(maxsize=16)
def gait_scale(robot: RobotDescription) -> GaitScale:
    """That of a robot."""
    sizes = robot.sizes
    return GaitScale(
        length=sizes.leg,
        time=math.sqrt(sizes.com_height),
        force=sizes.weight,
        sole=sizes.sole_width,
        sole_middle=round(robot.feet[0].sole_middle_m, 4) / _BIP_SOLE_MIDDLE_M,
        width=sizes.foot_spread_m / _BIP_FOOT_SPREAD_M,
    )
