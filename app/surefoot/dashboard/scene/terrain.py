"""Uneven ground in the browser: its blocks, the higher the lighter."""

import numpy as np
import viser

from surefoot.dashboard.scene.stones import cube
from surefoot.dashboard.ui.height_colours import height_colours
from surefoot.simulation.terrain import LEVEL, Block, Terrain

_SEEN_M = 12.0  # of a block that is as good as endless, so far to each side of where the robot starts
_BETWEEN_M = 0.1  # from one robot's uneven ground to the other's


def is_endless(block: Block) -> bool:
    """Whether a block reaches from one side of the scene to the other, as a ledge does."""
    return block.width_m > 2.0 * _SEEN_M


def terrain_width_m(terrain: Terrain) -> float:
    """How far beside itself a terrain can be drawn again without meeting itself [m]; 0 for one that is endless."""
    sides = [(block.y_m, 0.5 * block.width_m) for block in terrain.blocks if not is_endless(block)]
    return max(y + half for y, half in sides) - min(y - half for y, half in sides) + _BETWEEN_M if sides else 0.0


class TerrainView:
    """The blocks of one world.

    Args:
        server: where to draw.
        parent: node of the frame in which the ground is z = 0.
        endless: draw endless blocks too; where a second robot walks beside the first they are there already.
    """

    def __init__(self, server: viser.ViserServer, parent: str, *, endless: bool = True) -> None:
        self._server, self._name, self._endless = server, f"{parent}/terrain", endless
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
        drawn = [i for i, block in enumerate(terrain.blocks) if self._endless or not is_endless(block)]
        if drawn:
            self._node = self._made(terrain, drawn)

    def _made(self, terrain: Terrain, drawn: list[int]) -> viser.BatchedMeshHandle:
        boxes = np.array([_box(terrain.blocks[i], -terrain.depth_m) for i in drawn])
        return self._server.scene.add_batched_meshes_simple(
            self._name,
            *cube(),
            batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (len(boxes), 1)),
            batched_positions=boxes[:, :3],
            batched_scales=boxes[:, 3:],
            batched_colors=height_colours(terrain)[drawn],
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
