"""Uneven ground that lies there from the start: blocks that stand on the ground's plane and never move of their own."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Block:
    """A box that stands on the ground, its top level.

    Attributes:
        x_m, y_m: centre; on a slope where it would be if the ground were turned back to level.
        length_m, width_m: along x and y.
        top_m: height of its top above level zero, where the feet stand at the start.
    """

    x_m: float
    y_m: float
    length_m: float
    width_m: float
    top_m: float

    def covers(self, x_m: float, y_m: float) -> bool:
        """Whether a point lies on it, seen from above."""
        return abs(x_m - self.x_m) <= 0.5 * self.length_m and abs(y_m - self.y_m) <= 0.5 * self.width_m

    def overlaps(self, low: np.ndarray, high: np.ndarray) -> bool:
        """Whether it shares some area with the rectangle from one corner (2,) to the other (2,) [m]."""
        half = 0.5 * np.array((self.length_m, self.width_m))
        middle = np.array((self.x_m, self.y_m))
        return bool((middle + half > low).all() and (middle - half < high).all())


@dataclass(frozen=True)
class Terrain:
    """All blocks of one world, and how far its plane lies below level zero.

    Attributes:
        blocks: in no particular order; where several overlap the highest is felt.
        depth_m: 0 or more: the plane shows between blocks that go down.
    """

    blocks: tuple[Block, ...] = ()
    depth_m: float = 0.0

    def __deepcopy__(self, memo: object) -> "Terrain":
        """Nothing in it changes, so that whoever keeps a whole simulation aside need not copy it."""
        return self

    @cached_property
    def rows(self) -> np.ndarray:
        """Centre, lengths and top of each block (n, 5): x, y, along x, along y, height [m]."""
        rows = [(block.x_m, block.y_m, block.length_m, block.width_m, block.top_m) for block in self.blocks]
        return np.array(rows).reshape(-1, 5)

    def height_at(self, x_m: float, y_m: float) -> float:
        """Height [m] above level zero at a point."""
        return max((block.top_m for block in self.blocks if block.covers(x_m, y_m)), default=-self.depth_m)


LEVEL = Terrain()
