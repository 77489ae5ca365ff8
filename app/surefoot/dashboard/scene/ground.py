"""The ground, drawn where it lies, on a slope too: what stands on it, and a grid of 10 cm and 1 m."""

import numpy as np
import viser
import viser.transforms as vtf

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import Part, bar, glowing_glb
from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.scene.terrain import TerrainView
from surefoot.dashboard.ui import palette
from surefoot.simulation.terrain import Terrain

_LIGHT = {"plane_color": (232, 236, 239), "cell_color": (190, 196, 202), "section_color": (128, 136, 146)}
_DARK = {"plane_color": (46, 51, 57), "cell_color": (78, 86, 94), "section_color": (132, 140, 148)}
_BELOW_M = 0.0015  # a little below the soles, so that neither flickers
_RULER_X_M, _RULER_Y_M, _RULER_WIDE_M = -0.65, 0.5, 0.018
_INK: palette.Rgb = (70, 78, 88)


def pose_of_ground(geometry: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Position (3,) and quaternion (4,), w first, of the frame in which the ground is z = 0."""
    R, pivot = geometry.ground_rotation, geometry.ground_pivot
    return pivot - R.dot(pivot), vtf.SO3.from_matrix(R).wxyz


def _ruler() -> list[Part]:
    """A metre in steps of 10 cm, and an arrow to the front."""
    low, y, wide = _RULER_X_M, _RULER_Y_M, _RULER_WIDE_M
    dark = [bar((low + 0.1 * i, y), (low + 0.1 * (i + 1), y + wide)) for i in range(0, 10, 2)]
    light = [bar((low + 0.1 * i, y), (low + 0.1 * (i + 1), y + wide)) for i in range(1, 10, 2)]
    middle = y + 0.5 * wide
    tip, base = low + 1.2, low + 1.12
    corners = [(base, middle - 0.03, 0.0), (tip, middle, 0.0), (base, middle + 0.03, 0.0)]
    head = (np.array(corners), np.array([(0, 1, 2)]))
    shaft = bar((low + 1.03, middle - 0.006), (base, middle + 0.006))
    return [*((mesh, _INK) for mesh in (*dark, head, shaft)), *((mesh, (250, 250, 250)) for mesh in light)]


class GroundBlocks:
    """What stands on the ground from the start.

    Args:
        server: where to draw.
        root: node of the ground's frame.
        endless: see ``TerrainView``.
    """

    def __init__(self, server: viser.ViserServer, root: str, *, endless: bool = False) -> None:
        self._frame = server.scene.add_frame(root, show_axes=False)
        self._mover = NodeMover()
        self._terrain = TerrainView(server, root, endless=endless)

    def show_terrain(self, terrain: Terrain) -> None:
        """Draw what stands on it."""
        self._terrain.show(terrain)

    def update(self, geometry: Geometry) -> None:
        """Move it to where it lies."""
        position, wxyz = pose_of_ground(geometry)
        self._mover.set(self._frame, "position", position)
        self._mover.set(self._frame, "wxyz", wxyz)


class GroundView(GroundBlocks):
    """The ground with all that stands on it, a grid and a ruler.

    Args:
        server: where to draw.
        root: node of the ground's frame.
    """

    def __init__(self, server: viser.ViserServer, root: str) -> None:
        super().__init__(server, root, endless=True)
        self._grid = server.scene.add_grid(
            f"{root}/grid",
            infinite_grid=True,
            cell_size=0.1,
            section_size=1.0,
            plane_opacity=1.0,
            fade_distance=14.0,
            shadow_opacity=0.35,
            position=(0.0, 0.0, -_BELOW_M),
        )
        self.set_dark(False)
        scene, y = server.scene, _RULER_Y_M
        scene.add_glb(f"{root}/ruler", glowing_glb(_ruler()), cast_shadow=False, receive_shadow=False)
        for ahead, text in ((0.0, "0"), (0.5, "50 cm"), (1.0, "1 m"), (1.2, "front")):
            scene.add_label(
                f"{root}/label_{text.replace(' ', '_')}",
                text,
                position=(_RULER_X_M + ahead, y + 0.05, 0.002),
                anchor="bottom-center",
                font_size_mode="scene",
                font_scene_height=0.045,
                depth_test=True,
            )

    def set_dark(self, dark: bool) -> None:
        """Colours for a dark or a light page."""
        for name, colour in (_DARK if dark else _LIGHT).items():
            setattr(self._grid, name, colour)

    def show_terrain(self, terrain: Terrain) -> None:
        """Draw what stands on it; the grid lies as low as the plane does."""
        super().show_terrain(terrain)
        self._mover.set(self._grid, "position", np.array((0.0, 0.0, -_BELOW_M - terrain.depth_m)))
