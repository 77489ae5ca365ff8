"""Where the pelvis looks."""

import numpy as np

from surefoot.dynamics.terms import DynamicsTerms
from surefoot.gait.footsteps import yaw_of
from surefoot.gait.scale import BIP, GaitScale
from surefoot.geometry.rotations import rotation_from_rpy

_TURNS_S = 0.2  # the pelvis turns after the feet with this time constant


class PelvisHeading:
    """It looks where the feet look: between them as they are, for they too are turned by what they stand on.

    Args:
        yaw_rad: at first.
        scale: of the robot.
    """

    def __init__(self, yaw_rad: float, scale: GaitScale = BIP) -> None:
        self._yaw, self._turns_s = yaw_rad, _TURNS_S * scale.time

    def turn(self, terms: DynamicsTerms, elapsed_s: float) -> np.ndarray:
        """Pelvis -> world (3, 3) as it should be now; it was asked so long ago [s]."""
        between = 0.5 * sum(yaw_of(foot.rotation_foot_to_world) for foot in terms.feet)
        self._yaw += (between - self._yaw) * min(1.0, elapsed_s / self._turns_s)
        return rotation_from_rpy(0.0, 0.0, self._yaw)
