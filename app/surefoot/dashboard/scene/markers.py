"""What the theory talks about, drawn into the scene: support polygon, ZMP, CoM, capture point, forces, trails."""

from dataclasses import dataclass

import numpy as np
import viser
import viser.transforms as vtf

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import (
    disc,
    fan_faces,
    outline_segments,
    padded,
    path_segments,
    quartered_ball,
    quartered_disc,
    ring,
)  # fmt: skip
from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.scene.unlit_mesh import Part, glowing_glb
from surefoot.dashboard.ui import palette

_LIFT_M = 0.003  # drawn a little above the ground, so that it is not in it
_METRES_PER_NEWTON = 0.35 / 1000.0
_MOST_CONTACTS = 12
_LEAST_FORCE_N = 2.0
_TRAIL_SEGMENTS = 40
_TRAIL_EVERY = 6
_FARTHEST_M = 50.0
_SEEN_OF_ARROWS_M, _SEEN_OF_TRAILS_M = 3e-4, 1e-4
_WHITE: palette.Rgb = (255, 255, 255)


@dataclass(frozen=True)
class OverlayKind:
    """One thing that can be shown or hidden.

    Attributes:
        key: its name in code.
        label: what the page calls it.
        symbol: how it looks, for the legend.
        colour: out of the palette.
        help: one line.
    """

    key: str
    label: str
    symbol: str
    colour: palette.Rgb
    help: str


OVERLAYS = (
    OverlayKind("polygon", "Support polygon", "▰", palette.POLYGON, "hull of the soles that carry load: the ZMP cannot "
                "leave it"),
    OverlayKind("soles", "Sole outlines", "▱", palette.SOLE, "edges of both soles"),
    OverlayKind("zmp", "ZMP measured", "●", palette.ZMP_MEASURED, "centre of pressure of the ground forces"),
    OverlayKind("command", "ZMP commanded ζ", "◯", palette.ZMP_COMMANDED, "where the controller wants the ZMP, after "
                "margin and guard"),
    OverlayKind("com", "CoM and projection", "◔", palette.COM, "centre of mass G, and the point of the ground below "
                "it"),
    OverlayKind("capture", "Capture point (DCM)", "◆", palette.CAPTURE, "G + velocity / ω: once outside the support "
                "polygon, balance is lost"),
    OverlayKind("forces", "Contact forces", "↑", palette.FORCE, "force of the ground at every contact point"),
    OverlayKind("trails", "Trails", "~", palette.ZMP_MEASURED, "the last second of measured ZMP and CoM projection"),
)  # fmt: skip


class Overlays:
    """Every node is made once and then only moved.

    Args:
        server: where to draw.
        prefix: name of the node below which everything hangs.
        offset: where the world's origin is drawn (3,) [m].
    """

    def __init__(
        self,
        server: viser.ViserServer,
        *,
        prefix: str = "/overlay",
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        scene = server.scene
        self._root = scene.add_frame(prefix, show_axes=False, position=offset)
        self._shown = {kind.key: True for kind in OVERLAYS}
        self._counter = 0
        self._mover = NodeMover()
        flat = padded(np.zeros((1, 3)))

        def marker(name: str, *parts: Part) -> viser.GlbHandle:
            return scene.add_glb(f"{prefix}/{name}", glowing_glb(parts), cast_shadow=False, receive_shadow=False)

        def lines(name: str, count: int, colour: palette.Rgb, width: float) -> viser.LineSegmentsHandle:
            return scene.add_line_segments(
                f"{prefix}/{name}", np.zeros((count, 2, 3)), colour, thickness=width, thickness_units="screen"
            )

        self._polygon = scene.add_mesh_simple(
            f"{prefix}/polygon", flat, fan_faces(), color=palette.POLYGON, opacity=0.45, side="double",
            cast_shadow=False, receive_shadow=False,
        )  # fmt: skip
        self._soles = lines("soles", 8, palette.SOLE, 2.5)
        self._zmp = marker("zmp", (disc(0.013, 0.006), palette.ZMP_MEASURED))
        self._command = marker("command", (ring(0.019, 0.025, 0.005), palette.ZMP_COMMANDED))
        self._capture = marker("capture", (disc(0.019, 0.005, sides=4), palette.CAPTURE))
        light, dark = quartered_ball(0.04)
        self._com = marker("com", (light, _WHITE), (dark, palette.COM))
        light, dark = quartered_disc(0.015, 0.004)
        self._shadow = marker("com_ground", (light, _WHITE), (dark, palette.COM))
        self._plumb = lines("plumb", 1, palette.COM, 2.0)
        self._forces = scene.add_arrows(
            f"{prefix}/forces",
            np.zeros((_MOST_CONTACTS, 2, 3)),
            palette.FORCE,
            shaft_radius=0.004,
            head_radius=0.010,
            head_length=0.025,
        )
        self._trail_zmp = lines("trail_zmp", _TRAIL_SEGMENTS, palette.ZMP_MEASURED, 2.0)
        self._trail_com = lines("trail_com", _TRAIL_SEGMENTS, palette.COM, 2.0)

    def show(self, key: str, visible: bool) -> None:
        """Show or hide one kind."""
        self._shown[key] = visible

    def set_visible(self, visible: bool) -> None:
        """Show or hide all of it."""
        self._root.visible = visible

    def move_to(self, offset: tuple[float, float, float]) -> None:
        """Draw the world's origin elsewhere (3,) [m]."""
        self._root.position = offset

    def update(self, geometry: Geometry) -> None:
        """Move everything to where it is."""
        if not self._root.visible:
            return
        plane = SupportPlane(geometry)
        self._fill(geometry.support_polygon, plane)
        self._soles.visible = self._shown["soles"]
        if self._shown["soles"] and np.isfinite(geometry.soles).all():
            segments = np.vstack([outline_segments(sole) for sole in geometry.soles])
            self._mover.set(self._soles, "points", (segments + _LIFT_M * plane.up).astype(np.float32))
        self._put(self._zmp, "zmp", plane, geometry.zmp_measured, 0.005)
        self._put(self._command, "command", plane, geometry.zmp_commanded, 0.004)
        self._put(self._capture, "capture", plane, geometry.capture, 0.003)
        self._put(self._shadow, "com", plane, geometry.com[:2], 0.001)
        self._hang(geometry.com, plane)
        self._arrows(geometry.contacts)
        self._counter += 1
        if self._counter % _TRAIL_EVERY == 0:
            self._trails(geometry.trail, plane)

    def _put(
        self, node: viser.SceneNodeHandle, key: str, plane: "SupportPlane", place: np.ndarray, lift: float
    ) -> None:
        known = _drawable(place)
        node.visible = self._shown[key] and known
        if known:
            self._mover.set(node, "position", plane.point(place) + (_LIFT_M + lift) * plane.up)
            self._mover.set(node, "wxyz", plane.wxyz)

    def _hang(self, com: np.ndarray, plane: "SupportPlane") -> None:
        """The CoM and the line down to its projection."""
        visible = self._shown["com"] and _drawable(com)
        self._com.visible = self._plumb.visible = visible
        if visible:
            self._mover.set(self._com, "position", com)
            self._mover.set(self._plumb, "points", np.array([[plane.point(com[:2]), com]], dtype=np.float32))

    def _fill(self, corners: np.ndarray, plane: "SupportPlane") -> None:
        self._polygon.visible = self._shown["polygon"] and len(corners) > 2
        if len(corners) > 2:
            self._mover.set(self._polygon, "vertices", (padded(corners) + _LIFT_M * plane.up).astype(np.float32))

    def _arrows(self, contacts: np.ndarray) -> None:
        self._forces.visible = self._shown["forces"]
        points = np.zeros((_MOST_CONTACTS, 2, 3), dtype=np.float32)
        points[:, 1, 2] = 1e-4  # an arrow without length has no direction
        points[:, :, 2] -= 5.0
        strong = contacts[np.abs(contacts[:, 3:]).sum(axis=1) > _LEAST_FORCE_N][:_MOST_CONTACTS]
        points[: len(strong), 0] = strong[:, :3]
        points[: len(strong), 1] = strong[:, :3] + _METRES_PER_NEWTON * strong[:, 3:]
        self._mover.set(self._forces, "points", points, _SEEN_OF_ARROWS_M)

    def _trails(self, trail: np.ndarray, plane: "SupportPlane") -> None:
        for node, columns in ((self._trail_zmp, trail[:, :2]), (self._trail_com, trail[:, 2:4])):
            known = columns[np.isfinite(columns).all(axis=1)]
            node.visible = self._shown["trails"] and len(known) > 1
            path = plane.points(known) + _LIFT_M * plane.up
            self._mover.set(node, "points", path_segments(path, _TRAIL_SEGMENTS).astype(np.float32), _SEEN_OF_TRAILS_M)


class SupportPlane:
    """The plane on which points of the theory are drawn: parallel to the ground, as high as the support.

    Args:
        geometry: where ground and support are.
    """

    def __init__(self, geometry: Geometry) -> None:
        self.up = geometry.ground_rotation[:, 2]
        self.wxyz = vtf.SO3.from_matrix(geometry.ground_rotation).wxyz
        self._through = geometry.support_origin

    def points(self, places: np.ndarray) -> np.ndarray:
        """The points (n, 3) of the plane above or below places (n, 2) in world [m]."""
        drop = (places - self._through[:2]) @ self.up[:2] / self.up[2]
        return np.column_stack((places, self._through[2] - drop))

    def point(self, place: np.ndarray) -> np.ndarray:
        """The same of one place (2,)."""
        return self.points(place[None, :])[0]


def _drawable(place: np.ndarray) -> bool:
    return bool(np.isfinite(place).all()) and bool(np.abs(place).max() < _FARTHEST_M)
