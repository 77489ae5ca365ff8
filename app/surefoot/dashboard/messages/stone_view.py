"""From stones to what is drawn of them."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from surefoot.geometry.rotations import quaternion_wxyz
from surefoot.simulation.ground import Ground, GroundPose
from surefoot.simulation.stones import BOX, WEDGE, PlacedStone, Stone


@dataclass(frozen=True)
class StoneView:
    """One stone as it is seen.

    Attributes:
        number: counts stones of a run.
        stone: what it is.
        position: centre of what is drawn (3,) in world [m]; of a wedge the ground's point below its top's middle.
        wxyz: its orientation; of a wedge the ground's.
        lengths: full lengths (3,) along its own axes.
        top_m: how high its highest point is above the ground now.
    """

    number: int
    stone: Stone
    position: tuple[float, float, float]
    wxyz: tuple[float, float, float, float]
    lengths: tuple[float, float, float]
    top_m: float


def stone_views(placed: Iterable[PlacedStone], time_s: float, ground: GroundPose) -> tuple[StoneView, ...]:
    """All stones that are out of the ground at a time."""
    there = (p for p in placed if p.placed_s <= time_s < p.removed_s and p.stone.top_at(time_s) > 0.0)
    return tuple(stone_view(p.number, p.stone, time_s, ground) for p in sorted(there, key=lambda p: p.number))


def stone_view(number: int, stone: Stone, time_s: float, ground: GroundPose) -> StoneView:
    """One stone at a time; of a box only what is above the ground, so that one that drops is as thick as it will be."""
    centre, lengths, top = stone.centre_at(time_s), 2.0 * stone.half_lengths(), stone.top_at(time_s)
    if stone.shape == BOX:
        lengths[2] = stone.height_m if stone.drops else top
        centre[2] = top - 0.5 * lengths[2]
    elif stone.shape == WEDGE:
        centre = np.array((stone.x_m, stone.y_m, 0.0))
    place = ground.to_world(centre)
    wxyz = quaternion_wxyz(ground.rotation)
    return StoneView(number, stone, tuple(place.tolist()), tuple(wxyz.tolist()), tuple(lengths.tolist()), top)


def preview_of(stone: Stone, rotation: np.ndarray, pivot: np.ndarray) -> StoneView:
    """A stone as it will stand when it has come up."""
    ground = GroundPose(Ground(), pivot)
    ground.lie(rotation)
    return stone_view(-1, replace(stone, drops=False), np.inf, ground)
