"""The centre of mass, its projection on the ground and the line between them."""

import numpy as np

from surefoot.dashboard.messages.snapshot import Geometry
from surefoot.dashboard.scene.marker_meshes import quartered_ball, quartered_disc
from surefoot.dashboard.scene.markers.marker import Canvas, Marker
from surefoot.dashboard.scene.markers.support_plane import SupportPlane, drawable
from surefoot.dashboard.ui import palette, symbols

_WHITE: palette.Rgb = (255, 255, 255)
_LIFT_M = 0.001


class ComMarker(Marker):
    """A quartered ball, the quartered disc below it and the line down to it."""

    key = symbols.COM.key
    label, symbol, colour = "CoM and projection", "◔", symbols.COM.colour
    help = "centre of mass G, and the point of the ground below it"

    def create(self, canvas: Canvas) -> None:
        """Make ball, disc and line."""
        light, dark = quartered_ball(0.04)
        self._ball = canvas.sign("com", (light, _WHITE), (dark, self.colour))
        light, dark = quartered_disc(0.015, 0.004)
        self._disc = canvas.sign("com_ground", (light, _WHITE), (dark, self.colour))
        self._line = canvas.lines("plumb", 1, self.colour, 2.0)

    def update(self, geometry: Geometry, plane: SupportPlane) -> None:
        """Move them to the centre of mass and below it."""
        com = geometry.com
        below = symbols.COM.place(geometry)
        known = drawable(below)
        self._disc.visible = self.shown and known
        if known:
            self._canvas.put(self._disc, below, plane, _LIFT_M)
        visible = self.shown and drawable(com)
        self._ball.visible = self._line.visible = visible
        if visible:
            self._canvas.mover.set(self._ball, "position", com)
            self._canvas.mover.set(self._line, "points", np.array([[plane.point(below), com]], dtype=np.float32))
