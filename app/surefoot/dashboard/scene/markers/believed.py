"""What an estimator has of the theory's points: believed centre of mass and capture point."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import disc, ring
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import SupportPlane, drawable
from surefoot.dashboard.ui import palette

_LIFT_M = 0.006  # above the true ones, which are larger
_NOWHERE = np.full(2, np.nan)


class BelievedMarker(Marker):
    """A small disc for the centre of mass and a hollow diamond for the capture point, in the colour of the ghost."""

    key, label, symbol, colour = "believed", "Believed robot", "◇", palette.BELIEVED
    help = "as the estimator has it: ghost, CoM (disc) and DCM (hollow diamond); only where there is an estimator"

    def create(self, canvas: Canvas) -> None:
        """Make disc and diamond."""
        self._com = canvas.sign("believed_com", (disc(0.009, 0.004), self.colour))
        self._capture = canvas.sign("believed_capture", (ring(0.014, 0.021, 0.005, sides=4), self.colour))

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Lay them below the believed centre of mass, and where the capture point is believed to be."""
        believed = geometry.believed
        places = (_NOWHERE, _NOWHERE) if believed is None else (believed.com[:2], believed.capture)
        for node, place in zip((self._com, self._capture), places, strict=True):
            known = drawable(place)
            node.visible = self.shown and known
            if known:
                self._canvas.put(node, place, plane, _LIFT_M)
