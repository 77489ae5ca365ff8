"""Uneven ground in the browser: its blocks, the higher the lighter."""

import numpy as np
import viser

from surefoot.dashboard.scene.stones import cube
from surefoot.dashboard.ui import palette
from surefoot.simulation.terrain import LEVEL, Block, Terrain

_LOWEST: palette.Rgb = (128, 120, 110)
_HIGHEST: palette.Rgb = (226, 220, 210)
_SEEN_M = 12.0  # of a block that is as good as endless, so far to each side of where the robot starts


class TerrainView:
    """The blocks of one world.

    Args:
        server: where to draw.
        parent: node of the frame in which the ground is z = 0.
    """

    def __init__(self, server: viser.ViserServer, parent: str) -> None:
        self._server, self._name = server, f"{parent}/terrain"
        self._shown: Terrain = LEVEL
        self._node: viser.BatchedMeshHandle | None = None

    def show(self, terrain: Terrain) -> None:
        """Draw another terrain in place of the one before."""
        if terrain is self._shown:
            return
        if self._node is not None:
            self._node.remove()
            self._node = None
        self._shown = terrain
        if terrain.blocks:
            self._node = self._made(terrain)

    def _made(self, terrain: Terrain) -> viser.BatchedMeshHandle:
        boxes = np.array([_box(block, -terrain.depth_m) for block in terrain.blocks])
        tops = np.array([block.top_m for block in terrain.blocks])
        share = (tops + terrain.depth_m) / max(float(np.ptp((*tops, -terrain.depth_m))), 1e-9)
        colours = np.outer(1.0 - share, _LOWEST) + np.outer(share, _HIGHEST)
        return self._server.scene.add_batched_meshes_simple(
            self._name,
            *cube(),
            batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (len(boxes), 1)),
            batched_positions=boxes[:, :3],
            batched_scales=boxes[:, 3:],
            batched_colors=colours.astype(np.uint8),
            flat_shading=True,
            lod="off",
        )


def _box(block: Block, bottom_m: float) -> tuple[float, ...]:
    """Centre and lengths of what there is to be seen of a block."""
    sides = []
    for middle, length in ((block.x_m, block.length_m), (block.y_m, block.width_m)):
        low, high = max(middle - 0.5 * length, -_SEEN_M), min(middle + 0.5 * length, _SEEN_M)
        sides.append((0.5 * (low + high), high - low))
    (x, length), (y, width) = sides
    height = block.top_m - bottom_m
    return x, y, bottom_m + 0.5 * height, length, width, height
