"""Everybody's own camera: the places to look from, and that they go with a robot that walks."""

import threading
import time
from collections.abc import Callable

import numpy as np
import viser

from surefoot.dashboard.scene.following_camera import FollowingCamera
from surefoot.dashboard.scene.scene import WHOLE_ROBOT
from surefoot.dashboard.ui.mobile_layout import Place, placed_for


class Cameras:
    """The cameras of all who look at a scene.

    Args:
        server: whose clients.
        rest_s: pause that a client needs after each thing sent [s]: its number -> pause.
    """

    def __init__(self, server: viser.ViserServer, rest_s: Callable[[int], float] = lambda client_id: 0.0) -> None:
        self._server, self._rest_s = server, rest_s
        self._cameras: dict[int, FollowingCamera] = {}
        self._sent_s: dict[int, float] = {}
        self._robot, self._run, self._scale = np.zeros(2), -1, 1.0
        self._lock = threading.Lock()  # buttons are pressed in viser's threads

        @server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:  # async: coming and leaving stay in order
            with self._lock:
                camera = self._cameras[client.client_id] = FollowingCamera()
                camera.told(_says(client))  # where it says to be until it is placed
                self._place(client, camera, WHOLE_ROBOT)

        @server.on_client_disconnect
        async def _(client: viser.ClientHandle) -> None:
            with self._lock:
                self._cameras.pop(client.client_id, None)
                self._sent_s.pop(client.client_id, None)

    def suit(self, scale: float) -> None:
        """Go nearer to a smaller robot: places are meant for Bip. Everybody then looks at the whole of it.

        Args:
            scale: how large it is, as a ratio to Bip.
        """
        clients = self._server.get_clients()
        with self._lock:
            changed, self._scale = scale != self._scale, scale
            for client_id, camera in self._cameras.items():
                if changed and (client := clients.get(client_id)) is not None:
                    self._place(client, camera, WHOLE_ROBOT)

    def look_from(self, client: viser.ClientHandle, place: Place) -> None:
        """Move one person's camera to a place that is meant for Bip at the origin: to where the robot is now."""
        with self._lock:
            if (camera := self._cameras.get(client.client_id)) is not None:
                self._place(client, camera, place)

    def set_follows(self, client: viser.ClientHandle, follows: bool) -> None:
        """Let one person's camera follow the robot, or no more."""
        with self._lock:
            if (camera := self._cameras.get(client.client_id)) is not None:
                camera.set_follows(follows, self._robot)

    def update(self, robot: np.ndarray, run: int = 0) -> None:
        """Follow.

        Args:
            robot: its centre of mass (3,) [m].
            run: counts how often it was put to its start.
        """
        if not np.isfinite(robot).all():
            return
        clients = self._server.get_clients()
        with self._lock:
            self._robot, restarted = robot[:2].copy(), run != self._run
            self._run = run
            for client_id, camera in self._cameras.items():
                if (client := clients.get(client_id)) is not None:
                    self._update(client, camera, restarted)

    def _place(self, client: viser.ClientHandle, camera: FollowingCamera, place: Place) -> None:
        scaled = placed_for(place, float(client.camera.aspect))
        position, target = (self._scale * np.array(point) for point in scaled)
        _put(client, camera.place((tuple(position.tolist()), tuple(target.tolist())), self._robot))

    def _update(self, client: viser.ClientHandle, camera: FollowingCamera, restarted: bool) -> None:
        says = _says(client)
        first = self._server.initial_camera
        if camera.has_returned(says, np.stack((first.position, first.look_at))):
            self._place(client, camera, WHOLE_ROBOT)
        dragging = any(key[0] == client.client_id for key in tuple(self._server.scene._active_drag_handles))
        pose = camera.update(self._robot, says, restarted=restarted, dragging=dragging)
        now = time.monotonic()
        if pose is not None and now - self._sent_s.get(client.client_id, -np.inf) >= self._rest_s(client.client_id):
            self._sent_s[client.client_id] = now
            camera.told(pose)
            _put(client, pose)


def _says(client: viser.ClientHandle) -> np.ndarray:
    state = client.camera._state  # at once: viser puts a new one there whenever the camera says where it is
    return np.stack((state.position, state.look_at))


def _put(client: viser.ClientHandle, pose: np.ndarray) -> None:
    with client.atomic():
        client.camera.position, client.camera.look_at = pose
    client.flush()
