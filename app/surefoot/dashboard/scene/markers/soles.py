"""What the robot stands on: the outlines of its soles, and the hull of those that carry load."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import fan_faces, outline_segments, padded
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane
from surefoot.dashboard.ui import palette


class SupportPolygonMarker(Marker):
    """The support polygon, filled."""

    key, label, symbol, colour = "polygon", "Support polygon", "▰", palette.POLYGON
    help = "hull of the soles that carry load: the ZMP cannot leave it"

    def create(self, canvas: Canvas) -> None:
        """Make the polygon."""
        self._polygon = canvas.scene.add_mesh_simple(
            f"{canvas.prefix}/polygon",
            padded(np.zeros((1, 3))),
            fan_faces(),
            color=self.colour,
            opacity=0.45,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Move its corners."""
        corners = geometry.support_polygon
        self._polygon.visible = self.shown and len(corners) > 2
        if len(corners) > 2:
            vertices = (padded(corners) + LIFT_M * plane.up).astype(np.float32)
            self._canvas.mover.set(self._polygon, "vertices", vertices)


class SolesMarker(Marker):
    """The edges of both soles."""

    key, label, symbol, colour = "soles", "Sole outlines", "▱", palette.SOLE
    help = "edges of both soles"

    def create(self, canvas: Canvas) -> None:
        """Make the edges."""
        self._edges = canvas.lines("soles", 8, self.colour, 2.5)

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Move them."""
        self._edges.visible = self.shown
        if self.shown and np.isfinite(geometry.soles).all():
            segments = np.vstack([outline_segments(sole) for sole in geometry.soles])
            self._canvas.mover.set(self._edges, "points", (segments + LIFT_M * plane.up).astype(np.float32))
