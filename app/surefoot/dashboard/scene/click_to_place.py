"""Ctrl-click into the scene: a stone below the part of the foot that was hit, or where the ray meets the ground."""

import math
from collections.abc import Callable

import numpy as np
import viser

from surefoot.geometry.polygon import convex_hull

_FARTHEST_M = 8.0  # from the eye, wherever a robot has walked to
_FOOT_TOP_M = 0.03  # the foot's plate above its sole

Place = tuple[float, float]


def hit_ground(
    origin: tuple[float, float, float], direction: tuple[float, float, float], height: float = 0.0
) -> Place | None:
    """Where a ray meets the horizontal plane at a height; None when it points away or lands far off."""
    if direction[2] >= -1e-6 or origin[2] <= height:
        return None
    reach = (height - origin[2]) / direction[2]
    ahead, aside = reach * direction[0], reach * direction[1]
    return (origin[0] + ahead, origin[1] + aside) if math.hypot(ahead, aside) < _FARTHEST_M else None


def ray_to_ground(eye: np.ndarray, seen: np.ndarray) -> np.ndarray | None:
    """Where the line from an eye (3,) through a point (3,) meets the ground (2,); None when it does not."""
    place = hit_ground(tuple(eye.tolist()), tuple((seen - eye).tolist()))
    return None if place is None else np.array(place)


def stone_place(
    origin: tuple[float, float, float], direction: tuple[float, float, float], soles: np.ndarray
) -> Place | None:
    """Where a click wants its stone: below the part of a foot that it hit, or where it hit the ground.

    Args:
        origin: of the ray.
        direction: of the ray.
        soles: (2, n, 3) corners of both soles.
    """
    for sole in soles:
        if not np.isfinite(sole).all():
            continue
        top = hit_ground(origin, direction, float(sole[:, 2].mean()) + _FOOT_TOP_M)
        if top is not None and convex_hull(sole[:, :2].tolist()).contains(np.array(top)):
            return top
    return hit_ground(origin, direction)


def stones_on_click(
    server: viser.ViserServer,
    place: Callable[[Place], None],
    aim: Callable[[Place], None],
    soles: Callable[[], np.ndarray],
) -> None:
    """Let ctrl-click (cmd-click) place stones, and ctrl-shift-click show where one would be.

    Args:
        server: whose scene.
        place: takes the place of a ctrl-click.
        aim: takes the place of a ctrl-shift-click.
        soles: corners of both soles at the moment.
    """

    @server.scene.on_click(modifier="cmd/ctrl")
    def _(event: viser.SceneClickEvent) -> None:
        if (clicked := stone_place(event.ray_origin, event.ray_direction, soles())) is not None:
            place(clicked)

    @server.scene.on_click(modifier="cmd/ctrl+shift")
    def _(event: viser.SceneClickEvent) -> None:
        if (clicked := stone_place(event.ray_origin, event.ray_direction, soles())) is not None:
            aim(clicked)
