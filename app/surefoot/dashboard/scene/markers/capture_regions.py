"""K_0 and K_1: where the capture point may be without a step, and with one."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import MOST_CORNERS, fan_faces, outline_segments, padded
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane, drawable
from surefoot.dashboard.ui import palette
from surefoot.gait.emergency_step import LANDING_S, step_region
from surefoot.momentum.zmp import natural_frequency
from surefoot.robot.feet import Foot

_CORNERS_1 = 12  # of K_1, at most: each edge comes from one of the soles or of the places that a foot can reach
_SEEN_M = 1e-3
_LOWER_M = 0.001  # K_1 is large: whatever else lies on the ground is seen above it


class CaptureRegionsMarker(Marker):
    """The outline of K_0, and K_1 filled: one for each foot that may stand while the other steps."""

    key, label, symbol, colour = "regions", "Capture regions K₀, K₁", "▰", palette.CAPTURE
    help = (
        "where the capture point may be without a step (K₀, dark edge) and with one that "
        f"lands {LANDING_S:g} s later with Bip, sooner with a smaller robot (K₁, green), "
        "from each foot that is to stand"
    )
    update_every = 2
    shown_at_first = False  # it covers much of the ground

    def create(self, canvas: Canvas) -> None:
        """Make an edge for K_0, edge and area for the K_1 of each foot."""
        self._inner = canvas.lines("region_0", MOST_CORNERS, palette.REGION_EDGE, 3.0)
        self._edges = [canvas.lines(f"region_1_{foot}", _CORNERS_1, self.colour, 2.0) for foot in range(2)]
        self._areas = [
            canvas.scene.add_mesh_simple(
                f"{canvas.prefix}/region_1_{foot}_area",
                np.zeros((_CORNERS_1, 3)),
                fan_faces(_CORNERS_1),
                color=self.colour,
                opacity=0.15,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )
            for foot in range(2)
        ]
        for node in (self._inner, *self._edges, *self._areas):
            node.visible = False

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Lay them on the ground; nothing is computed while they are not wanted."""
        known = self.shown and drawable(geometry.com) and drawable(geometry.support_origin)
        self._inner.visible = known and len(geometry.support_polygon) > 2
        if self._inner.visible:
            corners = padded(geometry.support_polygon) + LIFT_M * plane.up
            self._canvas.mover.set(self._inner, "points", outline_segments(corners).astype(np.float32), _SEEN_M)
        for foot, (edge, area) in enumerate(zip(self._edges, self._areas, strict=True)):
            edge.visible = area.visible = known and foot in geometry.standing and drawable(geometry.soles[foot])
            if edge.visible:
                region = plane.points(self._region_1(geometry, foot)) + (LIFT_M - _LOWER_M) * plane.up
                corners = padded(region, _CORNERS_1).astype(np.float32)
                self._canvas.mover.set(edge, "points", outline_segments(corners), _SEEN_M)
                self._canvas.mover.set(area, "vertices", corners, _SEEN_M)

    def _region_1(self, geometry: Geometry, stance: int) -> np.ndarray:
        """Corners (n, 2) in world [m]."""
        robot = self._canvas.robot
        omega = natural_frequency(float(geometry.com[2] - geometry.support_origin[2]), robot.gravity)
        point, axes = foot_on_ground(robot.feet[stance], geometry.soles[stance])
        return point + step_region(robot, stance, omega).vertices @ axes.T


def foot_on_ground(foot: Foot, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """P (2,) in world [m] and the horizontal axes (2, 2) of a foot, from the corners of its sole (4, 3).

    The axes are those of the turn about the vertical that brings the sole's outline nearest to its corners.
    """
    outline, seen = foot.sole.vertices, corners[:, :2]
    a, b = outline - outline.mean(axis=0), seen - seen.mean(axis=0)
    cosine, sine = float((a * b).sum()), float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
    axes = np.array(((cosine, -sine), (sine, cosine))) / np.hypot(cosine, sine)
    return seen.mean(axis=0) - axes @ outline.mean(axis=0), axes
