"""Lengths, times and impulses that were chosen for Bip, in proportion to another robot."""

import math
from functools import lru_cache

from surefoot.experiments.scenario.robots import robot_named
from surefoot.gait.scale import gait_scale
from surefoot.record import record

_DIGITS = 3  # of a scaled value: 0.0028, not 0.002776


@record
class Proportions:
    """Ratios of a robot to Bip, whose own are all 1. ``scaled`` applies them.

    Attributes:
        sole_length, sole_width: of its soles: what lies below them, and how far G may go.
        leg: of its legs: steps, and what is stepped over.
        time: of its natural times, sqrt(h / g): periods of steps.
        foot_spread: of the distance between its feet.
    """

    sole_length: float
    sole_width: float
    leg: float
    time: float
    foot_spread: float
    _weight: float

    def along(self, axis: str) -> float:
        """Of the sole along ``sagittal`` or ``lateral``."""
        return self.sole_length if axis == "sagittal" else self.sole_width

    def impulse(self, direction_deg: float) -> float:
        """Of the impulse that moves its capture point by the same share of the sole: J = m omega d, omega^2 = g / h.

        Args:
            direction_deg: of the push, 0 forward, 90 to the left: d is between the sole's length and width.
        """
        angle = math.radians(direction_deg)
        sole = math.hypot(self.sole_length * math.cos(angle), self.sole_width * math.sin(angle))
        return self._weight * sole / self.time


@lru_cache(maxsize=4)
def proportions_of(robot: str) -> Proportions:
    """Those of a robot as a scenario names it. Raises InvalidInput."""
    description = robot_named(robot)
    sizes, scale = description.sizes, gait_scale(description)
    return Proportions(
        sole_length=sizes.sole_length,
        sole_width=sizes.sole_width,
        leg=sizes.leg,
        time=scale.time,
        foot_spread=scale.width,
        _weight=sizes.weight,
    )


def scaled(value: float, ratio: float) -> float:
    """A value times a ratio, to three digits; the value itself where they are as large (within 1e-9)."""
    if abs(ratio - 1.0) < 1e-9:
        return value
    return float(f"{value * ratio:.{_DIGITS}g}")
