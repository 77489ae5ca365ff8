"""Pushes and pulls of a saved run: an arrow from the point that the force acts on."""

import numpy as np
import viser

from surefoot.dashboard.scene.node_mover import NodeMover
from surefoot.dashboard.ui import palette
from surefoot.experiments.runs.saved_world import force_scale
from surefoot.robot.description import RobotDescription
from surefoot.simulation.external_forces import ActingForce

_SEEN_M = 3e-4


class ForceArrow:
    """The arrow.

    Args:
        server: where to draw.
        robot: whose weight makes the arrow's length.
    """

    def __init__(self, server: viser.ViserServer, robot: RobotDescription) -> None:
        self._mover, self._metres_per_newton = NodeMover(), force_scale(robot)
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
            points = np.stack((acting.point, acting.point + self._metres_per_newton * acting.force))[None]
            self._mover.set(self._arrow, "points", points.astype(np.float32), _SEEN_M)
