"""The next stone, see-through, where it would be placed."""

import numpy as np
import viser

from surefoot.dashboard.messages.stone_view import StoneView
from surefoot.dashboard.scene.stones import cube, half_ball, wedge
from surefoot.dashboard.ui import palette
from surefoot.simulation.stones import BOX, HALF_BALL, WEDGE, Stone

_OPACITY = 0.55
_SAME_PLACE_M = 0.004


class Preview:
    """A see-through stone.

    Args:
        server: where to draw.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        shapes = {BOX: cube(), HALF_BALL: half_ball(), WEDGE: wedge(Stone(shape=WEDGE), Stone.height_m)}
        self._nodes = {
            shape: server.scene.add_mesh_simple(
                f"/preview/{shape}",
                *mesh,
                color=palette.PREVIEW,
                opacity=_OPACITY,
                flat_shading=shape != HALF_BALL,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
                visible=False,
            )
            for shape, mesh in shapes.items()
        }
        self._drawn: StoneView | None = None

    def update(self, wanted: StoneView | None, stones: tuple[StoneView, ...]) -> None:
        """Show it there, or nothing when there is no wish or a stone stands there already."""
        if wanted is not None and any(_same_place(wanted, view) for view in stones):
            wanted = None
        if wanted == self._drawn:
            return
        self._drawn = wanted
        for shape, node in self._nodes.items():
            node.visible = wanted is not None and shape == wanted.stone.shape
            if wanted is not None and node.visible:
                node.position, node.wxyz = wanted.position, wanted.wxyz
                if shape == WEDGE:
                    node.vertices = wedge(wanted.stone, wanted.top_m)[0].astype(np.float32)
                else:
                    node.scale = wanted.lengths


def _same_place(one: StoneView, other: StoneView) -> bool:
    return float(np.hypot(one.stone.x_m - other.stone.x_m, one.stone.y_m - other.stone.y_m)) < _SAME_PLACE_M
