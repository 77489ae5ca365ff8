"""The feet: which stand, where the sole's corners are, which joints make the ankle."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon


class Side(StrEnum):
    """Left or right."""

    LEFT = "left"
    RIGHT = "right"


class Support(StrEnum):
    """Which feet are planned to carry the robot."""

    LEFT = "left"
    RIGHT = "right"
    DOUBLE = "double"

    @property
    def stance(self) -> tuple[int, ...]:
        """Indices of the stance feet (0 left, 1 right)."""
        return _STANCE[self]

    @property
    def reference_foot(self) -> int:
        """The foot whose ankle stones are placed from: the stance foot, the left one in double support."""
        return _STANCE[self][0]


_STANCE = {Support.LEFT: (0,), Support.RIGHT: (1,), Support.DOUBLE: (0, 1)}


@dataclass(frozen=True, eq=False)
class Foot:
    """One foot.

    Attributes:
        side: left or right.
        body: name of the foot's link.
        ankle_height_m: distance from the sole plane up to the ankle centre, h = |AP|.
        sole: the sole's outline, (x, y) in the foot frame relative to the point P below the ankle.
        corners_from_ankle: (4, 3) sole corners relative to the ankle centre, foot frame [m], in the order of
            ``sole.vertices``.
        sagittal, frontal: velocity indices (0..20) of the two ankle joints.
    """

    side: Side
    body: str
    ankle_height_m: float
    sole: ConvexPolygon
    corners_from_ankle: np.ndarray
    sagittal: int
    frontal: int

    def point_below(self, ankle: np.ndarray, rotation: np.ndarray) -> np.ndarray:
        """P, the point of the sole below the ankle (3,) in world [m].

        Args:
            ankle: its centre (3,) in world [m].
            rotation: foot -> world (3, 3).
        """
        return ankle - self.ankle_height_m * rotation[:, 2]
