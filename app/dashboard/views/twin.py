"""The second robot of a twin run: a translucent ghost over the first, or beside it with its own markers."""

from dataclasses import replace

import numpy as np
import viser

from app.dashboard import palette
from app.dashboard.commands import Command, PlaceStone
from app.dashboard.snapshot import Geometry, Snapshot
from app.dashboard.views.scene import SceneView
from app.dashboard.views.shapes import disc, fan_faces, outline_segments, padded
from app.dashboard.views.stones import StonesView

ARRANGEMENTS = (GHOST, BESIDE) = ("ghost over the first", "side by side")
APART_M = 0.8
BOTH_POSITION, BOTH_LOOK_AT = (2.75, 2.2, 1.6), (0.0, 0.4, 0.8)
_OPACITY = {GHOST: 0.38, BESIDE: 0.95}
_LIFT_M = 0.004
_NAME_TIMES_COM, _NAME_BESIDE_M = (1.5, 2.05), 0.42  # how high the names stand (ghost, beside), and how far aside
_DIGITS = 5  # 10 um: a robot that stands still costs nothing


class TwinScene:
    """Every node is made once, below one frame that carries the offset, and then only moved.

    Args:
        server: where to draw.
        scene: whose robot and stones to draw once more.
    """

    def __init__(self, server: viser.ViserServer, scene: SceneView) -> None:
        draw, self._view = server.scene, scene
        self._frame = draw.add_frame("/twin", show_axes=False, visible=False)
        self._beside = False
        self._links = {
            body: draw.add_batched_meshes_simple(
                f"/twin/link/{body}", vertices, faces, batched_wxyzs=((1.0, 0.0, 0.0, 0.0),),
                batched_positions=((0.0, 0.0, 0.0),), batched_colors=palette.TWIN, opacity=_OPACITY[GHOST], lod="off",
                flat_shading=True, cast_shadow=False, receive_shadow=False,
            )
            for body, (vertices, faces) in scene.link_meshes().items()
        }  # fmt: skip
        flat = padded(np.zeros((1, 3)))
        self._polygon = draw.add_mesh_simple("/twin/polygon", flat, fan_faces(), color=palette.POLYGON, opacity=0.45,
                                             side="double", cast_shadow=False, receive_shadow=False)  # fmt: skip
        self._soles = draw.add_line_segments("/twin/soles", np.zeros((8, 2, 3)), palette.TWIN, thickness=2.5,
                                             thickness_units="screen")  # fmt: skip
        self._zmp = draw.add_mesh_simple("/twin/zmp", *disc(0.011, 0.006), color=palette.ZMP_MEASURED, side="double",
                                         cast_shadow=False, receive_shadow=False)  # fmt: skip
        self._com = draw.add_icosphere("/twin/com", 0.035, color=palette.COM, cast_shadow=False, receive_shadow=False)
        self._shadow = draw.add_mesh_simple("/twin/com_ground", *disc(0.010, 0.005), color=palette.COM, side="double",
                                            cast_shadow=False, receive_shadow=False)  # fmt: skip
        self._own_stones = StonesView(server, "/twin/stones")
        self._label = draw.add_label("/twin/label", "", anchor="center-right", font_screen_scale=1.1)
        self._first_label = draw.add_label("/first_label", "", anchor="center-left", font_screen_scale=1.1,
                                           visible=False)  # fmt: skip

    def arrange(self, choice: str) -> None:
        """One of ``ARRANGEMENTS``."""
        self._beside = choice == BESIDE
        self._frame.position = (0.0, APART_M if self._beside else 0.0, 0.0)
        for node in self._links.values():
            node.opacity = _OPACITY[choice]
        self._label.anchor, self._first_label.anchor = (
            ("bottom-center", "bottom-center") if self._beside else ("center-right", "center-left")
        )
        for node in (self._polygon, self._soles, self._shadow, self._own_stones.node):
            node.visible = self._beside

    def placed(self, command: Command) -> Command:
        """A stone clicked at the twin beside the first robot is meant for the same place of both."""
        if isinstance(command, PlaceStone) and self._beside and self._frame.visible and command.y_m > 0.5 * APART_M:
            return replace(command, y_m=command.y_m - APART_M)
        return command

    def update(self, snapshot: Snapshot) -> None:
        """Move everything to where it is; hide it when there is no twin."""
        other = snapshot.twin.other if snapshot.twin else None
        self._frame.visible = self._first_label.visible = other is not None
        if other is None:
            return
        geometry = other.geometry
        self._robot(geometry)
        self._marks(geometry)
        self._own_stones.draw(geometry.stones)
        aside = 0.0 if self._beside else _NAME_BESIDE_M
        self._name(self._first_label, "first", snapshot, aside)
        self._name(self._label, "twin", other, -aside)

    def _robot(self, geometry: Geometry) -> None:
        if not np.isfinite(geometry.qpos.sum()):
            return
        positions, quaternions = self._view.link_poses(geometry.qpos)
        positions, quaternions = positions.round(_DIGITS), quaternions.round(_DIGITS)
        for body, node in self._links.items():
            node.batched_positions, node.batched_wxyzs = positions[body : body + 1], quaternions[body : body + 1]

    def _marks(self, geometry: Geometry) -> None:
        z = geometry.ground_z + _LIFT_M
        self._put(self._zmp, geometry.zmp_measured, z + 0.005)
        self._put(self._com, geometry.com[:2], float(geometry.com[2]))
        if not self._beside:
            return
        self._put(self._shadow, geometry.com[:2], z + 0.001)
        corners = geometry.support_polygon
        self._polygon.visible = len(corners) > 2
        if len(corners) > 2:
            self._polygon.vertices = (padded(corners) + (0.0, 0.0, _LIFT_M)).astype(np.float32)
        if np.isfinite(geometry.soles).all():
            segments = np.vstack([outline_segments(sole) for sole in geometry.soles])
            self._soles.points = (segments + (0.0, 0.0, _LIFT_M)).astype(np.float32)

    def _put(self, node: viser.SceneNodeHandle, place: np.ndarray, z: float) -> None:
        known = bool(np.isfinite(place).all()) and bool(np.abs(place).max() < 50.0)
        node.visible = known
        if known:
            node.position = (float(place[0]), float(place[1]), z)

    def _name(self, label: viser.LabelHandle, who: str, robot: Snapshot, left_m: float) -> None:
        verdict, com = robot.verdict, robot.geometry.com
        fell = f": fell at {verdict.fall_time_s:.2f} s" if verdict.fall_time_s is not None else ""
        label.text = f"{who} · {robot.controller}{fell}"
        if np.isfinite(com.sum()):
            label.position = (
                round(float(com[0]), 2), round(float(com[1]) + left_m, 2),
                round(float(com[2]) * _NAME_TIMES_COM[self._beside], 2),
            )  # fmt: skip
