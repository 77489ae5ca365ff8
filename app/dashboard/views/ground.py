"""The ground: a grid of 10 cm and 1 m, drawn where it lies, on a slope too."""

import numpy as np
import viser
import viser.transforms as vtf

from app.dashboard.snapshot import Geometry

_LIGHT = {"plane_color": (232, 236, 239), "cell_color": (190, 196, 202), "section_color": (128, 136, 146)}
_DARK = {"plane_color": (46, 51, 57), "cell_color": (78, 86, 94), "section_color": (132, 140, 148)}
_BELOW_M = 0.0015  # a little below the soles, so that neither flickers


def pose_of_ground(geometry: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Position (3,) and quaternion (4,), w first, of the frame in which the ground is z = 0."""
    R, pivot = geometry.ground_rotation, geometry.ground_pivot
    return pivot - R.dot(pivot), vtf.SO3.from_matrix(R).wxyz


class GroundView:
    """The ground.

    Args:
        server: where to draw.
        root: node of the ground's frame.
    """

    def __init__(self, server: viser.ViserServer, root: str) -> None:
        self._frame = server.scene.add_frame(root, show_axes=False)
        self._grid = server.scene.add_grid(
            f"{root}/grid", infinite_grid=True, cell_size=0.1, section_size=1.0, plane_opacity=1.0, fade_distance=14.0,
            shadow_opacity=0.35, position=(0.0, 0.0, -_BELOW_M),
        )  # fmt: skip
        self.set_dark(False)

    def set_dark(self, dark: bool) -> None:
        """Colours for a dark or a light page."""
        for name, colour in (_DARK if dark else _LIGHT).items():
            setattr(self._grid, name, colour)

    def update(self, geometry: Geometry) -> None:
        """Move it to where it lies."""
        self._frame.position, self._frame.wxyz = pose_of_ground(geometry)
