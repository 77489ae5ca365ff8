"""Ctrl-click into the scene: a stone below the part of the foot that was hit, or where the ray meets the ground."""

from collections.abc import Callable

import numpy as np
import viser

from app.dashboard.commands import PlaceStone
from app.geometry.polygon import convex_hull

_FARTHEST_M = 4.0
_FOOT_TOP_M = 0.03  # the foot's plate above its sole


def hit_ground(
    origin: tuple[float, float, float], direction: tuple[float, float, float], height: float = 0.0
) -> tuple[float, float] | None:
    """Where a ray meets the horizontal plane at a height; None when it points away or lands far off."""
    if direction[2] >= -1e-6 or origin[2] <= height:
        return None
    reach = (height - origin[2]) / direction[2]
    x, y = origin[0] + reach * direction[0], origin[1] + reach * direction[1]
    return (x, y) if abs(x) < _FARTHEST_M and abs(y) < _FARTHEST_M else None


def stone_place(
    origin: tuple[float, float, float], direction: tuple[float, float, float], soles: np.ndarray
) -> tuple[float, float] | None:
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


def place_on_click(
    server: viser.ViserServer, send: Callable[[PlaceStone], None], stone: Callable[[], tuple[float, float]],
    soles: Callable[[], np.ndarray],
) -> None:  # fmt: skip
    """Let ctrl-click (cmd-click) place stones.

    Args:
        server: whose scene.
        send: takes the command.
        stone: height and size [m] chosen at the moment.
        soles: corners of both soles at the moment.
    """

    @server.scene.on_click(modifier="cmd/ctrl")
    def _(event: viser.SceneClickEvent) -> None:
        place = stone_place(event.ray_origin, event.ray_direction, soles())
        if place is not None:
            height, size = stone()
            send(PlaceStone(x_m=place[0], y_m=place[1], height_m=height, size_m=size))
