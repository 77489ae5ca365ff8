"""The world moved below a robot that walks, where no camera can follow it."""

import numpy as np

from surefoot.dashboard.scene.following_camera import SWAY_M
from surefoot.dashboard.scene.leash import Leash
from surefoot.dashboard.scene.markers.markers import Markers
from surefoot.dashboard.scene.scene import SceneView

_SHARE = 0.26  # of the way, 25 times a second: as softly as a camera that follows
# Viser sends no position that a node has already. So that the first one is sent nevertheless: a recording that starts
# over sets only what was sent, and would leave the world where its end has left it.
_ELSEWHERE = (0.0, 0.0, -1e-5)


class Treadmill:
    """Keeps the robot near the origin: the camera of a page on disk is its reader's own, and nobody moves it.

    Args:
        scene, markers: what is moved.
    """

    def __init__(self, scene: SceneView, markers: Markers) -> None:
        self._scene, self._markers = scene, markers
        self._leash, self._begun = Leash(SWAY_M, _SHARE), False
        self._move(_ELSEWHERE)

    def follow(self, robot: np.ndarray) -> None:
        """The robot is there now (2,) in world [m]."""
        if self._begun:
            self._leash.follow(robot)
        else:
            self._leash.settle(robot)
        self._begun = True
        x, y = self._leash.point.tolist()
        self._move((-x, -y, 0.0))

    def _move(self, offset: tuple[float, float, float]) -> None:
        self._scene.move_to(offset)
        self._markers.move_to(offset)
