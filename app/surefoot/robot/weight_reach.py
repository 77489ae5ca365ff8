"""How far from the ankle its motors hold the robot's whole weight, in statics, and whether that is all of the sole."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class WeightReach:
    """Of one joint of an ankle.

    Attributes:
        reach_m: its torque limit over the weight: the lever at which it holds all of it; None without a limit.
        edge_m: the greatest lever there is on the sole: of the pitch joint ahead or back, of the roll joint aside.
    """

    reach_m: float | None
    edge_m: float

    @property
    def holds_sole(self) -> bool:
        """Whether it holds the weight at every edge of its sole."""
        return self.reach_m is None or self.reach_m >= self.edge_m


def weight_reach(
    limits_nm: Sequence[float | None], weight_n: float, corners: np.ndarray
) -> tuple[WeightReach, WeightReach]:
    """Of an ankle's pitch joint and of its roll joint.

    Args:
        limits_nm: torque limits of both, None where there is none [N m].
        weight_n: m g [N].
        corners: of the sole (n, 2), x ahead and y aside from the point below the ankle [m]; none: no lever either.
    """
    ahead, aside = np.abs(corners).max(axis=0).tolist() if len(corners) else (0.0, 0.0)
    pitch, roll = (None if limit is None else limit / weight_n for limit in limits_nm)
    return WeightReach(pitch, ahead), WeightReach(roll, aside)
