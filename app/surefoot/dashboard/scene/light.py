"""The light: an even sky, and a lamp whose shadows show what touches the ground, which goes where the robot goes."""

import numpy as np
import viser

from surefoot.dashboard.scene.leash import Leash
from surefoot.dashboard.scene.node_mover import NodeMover

_LAMP_M, _DIRECTION = (2.2, 2.6, 5.6), (-2.2, -2.3, -5.2)  # from above the usual camera, onto both robots of a twin
_LEASH_M = 0.5  # the lamp lights a circle of some 3 m
_STEP_M = 0.02  # of the lamp: no shadow is seen to jump


class Light:
    """Viser's lights are put out and our own put on.

    Viser's default room, which metal mirrors, goes too: a page drawn in software took three times as long to its first
    picture with it, and nothing here mirrors.

    Args:
        server: whose scene to light.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        scene = server.scene
        scene.configure_default_lights(enabled=False)
        scene.configure_environment_map(None)
        scene.add_light_hemisphere("/light/sky", sky_color=(255, 255, 255), ground_color=(168, 166, 162), intensity=2.6)
        self._lamp = scene.add_light_spot(
            "/light/lamp",
            position=_LAMP_M,
            direction=_DIRECTION,
            intensity=85.0,
            distance=0.0,
            angle=0.5,
            penumbra=0.6,
            decay=2.0,
            cast_shadow=True,
        )
        self._leash, self._mover = Leash(_LEASH_M), NodeMover()

    def follow(self, robot: np.ndarray) -> None:
        """Shine on the robot, whose centre of mass is there (3,) [m]."""
        if np.isfinite(robot).all():
            self._leash.follow(robot[:2])
            self._mover.set(self._lamp, "position", np.array(_LAMP_M) + (*self._leash.point, 0.0), _STEP_M)
