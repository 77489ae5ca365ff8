"""Where measured ZMP and CoM projection were in the last second."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import path_segments
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane
from surefoot.dashboard.ui import palette, symbols

_SEGMENTS = 40
_SEEN_M = 1e-4


class TrailsMarker(Marker):
    """A line behind each of the two points."""

    key, label, symbol, colour = "trails", "Trails", "~", palette.ZMP_MEASURED
    help = "the last second of measured ZMP and CoM projection"
    update_every = 6  # they grow slowly, and are long

    def create(self, canvas: Canvas) -> None:
        """Make the lines."""
        self._lines = [
            (point, canvas.lines(f"trail_{point.key}", _SEGMENTS, point.colour, 2.0))
            for point in (symbols.ZMP, symbols.COM)
        ]

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Lay them along where the points were."""
        for point, line in self._lines:
            trail = point.trail(geometry)
            known = trail[np.isfinite(trail).all(axis=1)]
            line.visible = self.shown and len(known) > 1
            path = plane.points(known) + LIFT_M * plane.up
            self._canvas.mover.set(line, "points", path_segments(path, _SEGMENTS).astype(np.float32), _SEEN_M)
