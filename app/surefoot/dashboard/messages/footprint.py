"""Where a foot will be set down."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from surefoot.gait.footsteps import Footstep
from surefoot.robot.feet import Foot


@dataclass(frozen=True, slots=True, eq=False)
class Footprint:
    """The outline of a sole on the ground, of a step to come.

    Attributes:
        foot: 0 left, 1 right.
        outline: (n, 3) corners in world [m], at the height where the ground is expected.
    """

    foot: int
    outline: np.ndarray


def footprints_of(steps: Iterable[Footstep], feet: tuple[Foot, Foot], height_m: float) -> tuple[Footprint, ...]:
    """The soles of steps to come.

    Args:
        steps: in the order in which they are made.
        feet: whose soles.
        height_m: where the ground is expected.
    """
    outlines = [(step.foot, step.point + feet[step.foot].sole.vertices @ step.axes.T) for step in steps]
    return tuple(Footprint(foot, np.column_stack((xy, np.full(len(xy), height_m)))) for foot, xy in outlines)
