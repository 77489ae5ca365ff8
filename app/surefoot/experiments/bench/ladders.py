"""Levels, directions and the robot, as the families use them."""

from collections.abc import Sequence

import numpy as np

from surefoot.experiments.scenario.proportions import scaled

BIP = "bip"  # the robot that the levels were chosen for
EIGHT = (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0)
TWO = (0.0, 90.0)
WORDS = {
    0.0: "forward",
    45.0: "forward-left",
    90.0: "left",
    135.0: "backward-left",
    180.0: "backward",
    225.0: "backward-right",
    270.0: "right",
    315.0: "forward-right",
}


def rungs(first: float, last: float, count: int) -> tuple[float, ...]:
    """Equally spaced levels without rounding dust."""
    return tuple(round(level, 6) for level in np.linspace(first, last, count).tolist())


def in_proportion(levels: Sequence[float], ratio: float) -> tuple[float, ...]:
    """Bip's levels times a ratio."""
    return tuple(scaled(level, ratio) for level in levels)
