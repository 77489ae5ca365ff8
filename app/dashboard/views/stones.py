"""The stones: boxes that rise out of the ground or lie on it, and tilt with it."""

import numpy as np
import viser

from app.dashboard import palette
from app.dashboard.snapshot import Geometry
from app.dashboard.views.ground import pose_of_ground

_MOST_STONES = 24
_UNSEEN = np.array((0.0, 0.0, -5.0))


class StonesView:
    """All stones of one world.

    Args:
        server: where to draw.
        root: node below which they hang; they follow the ground.
    """

    def __init__(self, server: viser.ViserServer, root: str) -> None:
        self._frame = server.scene.add_frame(f"{root}/stones", show_axes=False)
        corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
        self._stones = server.scene.add_batched_meshes_simple(
            f"{root}/stones/boxes", corners, _BOX_FACES,
            batched_wxyzs=np.tile((1.0, 0.0, 0.0, 0.0), (_MOST_STONES, 1)),
            batched_positions=np.tile(_UNSEEN, (_MOST_STONES, 1)),
            batched_scales=np.full((_MOST_STONES, 3), 0.01),
            batched_colors=palette.STONE, flat_shading=True, lod="off", side="double",
        )  # fmt: skip
        self._drawn = np.empty((0, 6))

    def update(self, geometry: Geometry) -> None:
        """Move them to where they are."""
        self._frame.position, self._frame.wxyz = pose_of_ground(geometry)
        stones = geometry.stones
        if np.array_equal(stones, self._drawn):
            return
        self._drawn = stones
        positions = np.tile(_UNSEEN, (_MOST_STONES, 1))
        scales = np.full((_MOST_STONES, 3), 0.01)
        positions[: len(stones)], scales[: len(stones)] = stones[:, :3], stones[:, 3:]
        self._stones.batched_positions, self._stones.batched_scales = positions, scales


_BOX_FACES = np.array([
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
    (1, 5, 7), (1, 7, 3),
])  # fmt: skip
