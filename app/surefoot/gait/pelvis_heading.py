"""Where the pelvis looks."""

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.footsteps import yaw_of
from surefoot.geometry.rotations import rotation_from_rpy

_TURNS_S = 0.2  # the pelvis turns after the feet with this time constant


class PelvisHeading:
    """It looks where the feet look: between them as they are, for they too are turned by what they stand on.

    Args:
        yaw_rad: at first.
    """

    def __init__(self, yaw_rad: float) -> None:
        self._yaw = yaw_rad

    def turn(self, terms: DynamicsTerms, elapsed_s: float) -> np.ndarray:
        """Pelvis -> world (3, 3) as it should be now; it was asked so long ago [s]."""
        between = 0.5 * sum(yaw_of(foot.rotation_foot_to_world) for foot in terms.feet)
        self._yaw += (between - self._yaw) * min(1.0, elapsed_s / _TURNS_S)
        return rotation_from_rpy(0.0, 0.0, self._yaw)
