"""How a walk has planned ZMP and capture point, over the steps ahead."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import path_segments
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane
from surefoot.dashboard.ui import palette

_SEGMENTS = 48  # 4 steps of two pieces each, and the shift before them
_SEEN_M = 1e-3


class PlanMarker(Marker):
    """A line ahead of each of the two points."""

    key, label, symbol, colour = "plan", "Plan ahead", "∿", palette.ZMP_COMMANDED
    help = "ZMP (orange) and capture point (green) as a walk has planned them, over its next steps"
    update_every = 3  # it is told no oftener

    def create(self, canvas: Canvas) -> None:
        """Make the lines."""
        self._lines = [
            canvas.lines(f"plan_{name}", _SEGMENTS, colour, 3.0)
            for name, colour in (("zmp", palette.ZMP_COMMANDED), ("capture", palette.CAPTURE))
        ]

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Lay them along where the points are to go."""
        plan = geometry.plan_ahead
        visible = self.shown and len(plan) > 1
        for i, line in enumerate(self._lines):
            line.visible = visible
            if visible:
                path = plane.points(plan[:, 2 * i : 2 * i + 2]) + LIFT_M * plane.up
                self._canvas.mover.set(line, "points", path_segments(path, _SEGMENTS).astype(np.float32), _SEEN_M)
