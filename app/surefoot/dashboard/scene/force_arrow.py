"""Pushes and pulls of a saved run: an arrow from the point that the force acts on."""

import numpy as np
import viser

from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.ui import palette
from surefoot.experiments.runs.saved_world import METRES_PER_NEWTON
from surefoot.simulation.external_forces import ActingForce

_SEEN_M = 3e-4


class ForceArrow:
    """The arrow.

    Args:
        server: where to draw.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        self._mover = NodeMover()
        self._arrow = server.scene.add_arrows(
            "/world/external_force",
            np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 1e-4]]]),  # an arrow without length has no direction
            palette.FORCE,
            shaft_radius=0.008,
            head_radius=0.02,
            head_length=0.05,
            visible=False,
        )

    def update(self, acting: ActingForce) -> None:
        """Draw a force, or none."""
        acts = bool(np.isfinite(acting.point).all() and acting.force.any())
        self._arrow.visible = acts
        if acts:
            points = np.stack((acting.point, acting.point + METRES_PER_NEWTON * acting.force))[None]
            self._mover.set(self._arrow, "points", points.astype(np.float32), _SEEN_M)
