"""The force of the ground at every contact point."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import SupportPlane
from surefoot.dashboard.ui import palette

_METRES_PER_NEWTON = 0.35 / 1000.0  # for Bip; other robots' weight is an arrow as long in proportion
_MOST_CONTACTS = 12
_LEAST_FORCE_N = 2.0
_SEEN_M = 3e-4


class ForcesMarker(Marker):
    """An arrow for each contact that carries load."""

    key, label, symbol, colour = "forces", "Contact forces", "↑", palette.FORCE
    help = "force of the ground at every contact point"

    def create(self, canvas: Canvas) -> None:
        """Make as many arrows as are ever shown."""
        self._arrows = canvas.scene.add_arrows(
            f"{canvas.prefix}/forces",
            np.zeros((_MOST_CONTACTS, 2, 3)),
            self.colour,
            shaft_radius=0.004,
            head_radius=0.010,
            head_length=0.025,
        )

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Move them to the contacts; those left over go below the ground."""
        contacts, sizes = geometry.contacts, self._canvas.robot.sizes
        scale = _METRES_PER_NEWTON * sizes.com_height / sizes.weight
        self._arrows.visible = self.shown
        points = np.zeros((_MOST_CONTACTS, 2, 3), dtype=np.float32)
        points[:, 1, 2] = 1e-4  # an arrow without length has no direction
        points[:, :, 2] -= 5.0
        strong = contacts[np.abs(contacts[:, 3:]).sum(axis=1) > _LEAST_FORCE_N][:_MOST_CONTACTS]
        points[: len(strong), 0] = strong[:, :3]
        points[: len(strong), 1] = strong[:, :3] + scale * strong[:, 3:]
        self._canvas.mover.set(self._arrows, "points", points, _SEEN_M)
