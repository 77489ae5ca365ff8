"""Where a robot that walks will set its feet."""

import numpy as np

from surefoot.dashboard.messages.footprint import Footprint
from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import MOST_CORNERS, fan_faces, outline_segments, padded
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane
from surefoot.dashboard.ui import palette

_MOST = 4  # steps ahead that a gait tells of
_COLOURS = (palette.LEFT_FOOT, palette.RIGHT_FOOT)
_SEEN_M = 1e-3  # the sole that stands, by which their height is known, is never quite still


class FootprintsMarker(Marker):
    """The soles of the next steps, filled, in one colour for each foot."""

    key, label, symbol, colour = "footprints", "Steps to come", "▰", palette.LEFT_FOOT
    help = "where a robot that walks will set its feet: left teal, right wine-red"
    update_every = 3  # they change once a step

    def create(self, canvas: Canvas) -> None:
        """Make edges and areas for each foot."""
        faces = np.vstack([fan_faces() + MOST_CORNERS * i for i in range(_MOST)])
        self._edges = [
            canvas.lines(f"footprints_{foot}", _MOST * MOST_CORNERS, colour, 2.5)
            for foot, colour in enumerate(_COLOURS)
        ]
        self._areas = [
            canvas.scene.add_mesh_simple(
                f"{canvas.prefix}/footprints_{foot}_area",
                np.zeros((_MOST * MOST_CORNERS, 3)),
                faces,
                color=colour,
                opacity=0.25,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )
            for foot, colour in enumerate(_COLOURS)
        ]

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Lay them on the ground, those of each foot with nodes of their own."""
        for foot, (edges, area) in enumerate(zip(self._edges, self._areas, strict=True)):
            own = [footprint for footprint in geometry.footprints if footprint.foot == foot][:_MOST]
            edges.visible = area.visible = self.shown and bool(own)
            if own:
                outlines = _outlines(own)
                edge = np.vstack([outline_segments(outline) for outline in outlines])
                self._canvas.mover.set(edges, "points", edge.astype(np.float32), _SEEN_M)
                self._canvas.mover.set(area, "vertices", np.vstack(outlines).astype(np.float32), _SEEN_M)


def _outlines(footprints: list[Footprint]) -> list[np.ndarray]:
    """Exactly as many as are ever shown (``MOST_CORNERS``, 3); those left over are a point."""
    outlines = [padded(footprint.outline) + (0.0, 0.0, LIFT_M) for footprint in footprints]
    return outlines + [padded(outlines[-1][-1:])] * (_MOST - len(outlines))
