"""Where a foot will be set down."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True, eq=False)
class Footprint:
    """The outline of a sole on the ground, of a step to come.

    Attributes:
        foot: 0 left, 1 right.
        outline: (n, 3) corners in world [m], at the height where the ground is expected.
    """

    foot: int
    outline: np.ndarray
