"""See-through links: what the theory talks about lies below the foot and inside the trunk."""

from collections.abc import Mapping

import numpy as np
import viser

_COLOUR = (150, 158, 166)
_OPACITY = 0.3


class Ghost:
    """A translucent mesh per link, in place of its solid shapes.

    Args:
        server: where to draw.
        meshes: body number -> vertices and faces in the body's axes.
    """

    def __init__(self, server: viser.ViserServer, meshes: Mapping[int, tuple[np.ndarray, np.ndarray]]) -> None:
        self._nodes = {
            body: server.scene.add_mesh_simple(
                f"/ghost/{body}", vertices, faces, color=_COLOUR, opacity=_OPACITY, flat_shading=True, visible=False,
                cast_shadow=True, receive_shadow=False,
            )
            for body, (vertices, faces) in meshes.items()
        }  # fmt: skip

    def show(self, bodies: set[int]) -> None:
        """Show these links only."""
        for body, node in self._nodes.items():
            node.visible = body in bodies

    def update(self, positions: np.ndarray, quaternions: np.ndarray) -> None:
        """Move what is shown: positions (n, 3) and quaternions (n, 4), w first, of all bodies."""
        for body, node in self._nodes.items():
            if node.visible:
                node.position, node.wxyz = positions[body], quaternions[body]
