"""The feet: which stand, where the sole's corners are, which joints make the ankle."""

from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property

import numpy as np

from surefoot.geometry.polygon import ConvexPolygon, convex_hull


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


_LOWEST_M = 0.004  # collision points within this above the lowest one make the sole


def sole_from_points(points: np.ndarray) -> tuple[ConvexPolygon, np.ndarray]:
    """The sole that a foot's collision points make: the hull of the lowest ones.

    Args:
        points: (n, 3) in the foot frame [m].

    Returns:
        Its outline, and its corners (n, 3) from the ankle centre [m].

    Raises:
        ValueError: they span no area.
    """
    bottom = points[:, 2].min()
    outline = convex_hull(points[points[:, 2] <= bottom + _LOWEST_M, :2])
    return outline, np.column_stack((outline.vertices, np.full(len(outline.vertices), bottom)))


@dataclass(frozen=True, eq=False, kw_only=True)
class Foot:
    """One foot.

    The foot frame has its origin at the ankle centre, x forward along the sole, z along the sole's normal.

    Attributes:
        side: left or right.
        body: name of the foot's link.
        rotation_in_body: (3, 3) foot frame -> link frame.
        ankle_in_body: (3,) the ankle centre in the link frame [m].
        ankle_height_m: distance from the sole plane up to the ankle centre, h = |AP|.
        sole: the sole's outline, (x, y) in the foot frame relative to the point P below the ankle.
        corners_from_ankle: (n, 3) sole corners relative to the ankle centre, foot frame [m], in the order of
            ``sole.vertices``.
        sagittal, frontal: velocity indices of the ankle's pitch and roll joint, whichever comes first down the leg.
        leg: velocity indices of the six joints from the base's side down to the foot.
    """

    side: Side
    body: str
    rotation_in_body: np.ndarray = field(default_factory=lambda: np.eye(3))
    ankle_in_body: np.ndarray = field(default_factory=lambda: np.zeros(3))
    ankle_height_m: float
    sole: ConvexPolygon
    corners_from_ankle: np.ndarray
    sagittal: int
    frontal: int
    leg: tuple[int, ...]

    @cached_property
    def is_body_frame(self) -> bool:
        """Whether the foot frame is the link's own."""
        return not self.ankle_in_body.any() and bool((self.rotation_in_body == np.eye(3)).all())

    @property
    def sole_middle_m(self) -> float:
        """How far the middle of the sole's length lies ahead of the ankle [m]."""
        along = self.sole.vertices[:, 0]
        return 0.5 * float(along.min() + along.max())

    def point_below(self, ankle: np.ndarray, rotation: np.ndarray) -> np.ndarray:
        """P, the point of the sole below the ankle (3,) in world [m].

        Args:
            ankle: its centre (3,) in world [m].
            rotation: foot -> world (3, 3).
        """
        return ankle - self.ankle_height_m * rotation[:, 2]
