"""The plane on which the markers of the theory's points lie."""

import numpy as np
import viser.transforms as vtf

from surefoot.dashboard.messages.snapshot import Geometry

LIFT_M = 0.003  # drawn a little above the ground, so that it is not in it
_FARTHEST_M = 50.0


class SupportPlane:
    """The plane on which points of the theory are drawn: parallel to the ground, as high as the support.

    Args:
        geometry: where ground and support are.
    """

    def __init__(self, geometry: Geometry) -> None:
        self.up = geometry.ground_rotation[:, 2]
        self.wxyz = vtf.SO3.from_matrix(geometry.ground_rotation).wxyz
        self._through = geometry.support_origin

    def points(self, places: np.ndarray) -> np.ndarray:
        """The points (n, 3) of the plane above or below places (n, 2) in world [m]."""
        drop = (places - self._through[:2]) @ self.up[:2] / self.up[2]
        return np.column_stack((places, self._through[2] - drop))

    def point(self, place: np.ndarray) -> np.ndarray:
        """The same of one place (2,)."""
        return self.points(place[None, :])[0]


def drawable(place: np.ndarray) -> bool:
    """Whether a point [m] is known, and near enough to be drawn."""
    return bool(np.isfinite(place).all()) and bool(np.abs(place).max() < _FARTHEST_M)
