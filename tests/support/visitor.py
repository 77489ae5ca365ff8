"""A visitor without a browser: a websocket that says what viser's client says, and reads only when it is told to."""

import contextlib
import socket
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import msgspec
import viser
import zstandard
from viser import _messages
from websockets.sync.client import connect

from tests.support.waiting import wait_for

_CAMERA = _messages.ViewerCameraMessage(
    wxyz=(1.0, 0.0, 0.0, 0.0),
    position=(3.0, 0.0, 1.0),
    fov=0.8,
    near=0.01,
    far=100.0,
    image_height=300,
    image_width=400,
    look_at=(0.0, 0.0, 1.0),
    up_direction=(0.0, 0.0, 1.0),
)


class Visitor:
    """Comes, and leaves when it is closed.

    Args:
        running: the dashboard.
        room: for how many bytes that were not read yet; None: for many.
        greets: says how its camera stands, by which viser counts it as come.

    Attributes:
        client_id: the number under which the server knows the connection.
    """

    def __init__(self, running, room: int | None = None, *, greets: bool = True) -> None:
        self._server = server = running.server
        there = server._websock_server._live_connections
        known = set(there)
        port, line = server.get_port(), socket.socket()
        if room is not None:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, room)
        line.connect(("127.0.0.1", port))
        protocol = [f"viser-v{viser.__version__}"]
        self._line = connect(
            f"ws://127.0.0.1:{port}/", sock=line, subprotocols=protocol, max_size=None, max_queue=room and 1
        )
        wait_for(lambda: set(there) - known)
        (self.client_id,) = set(there) - known
        if greets:
            self.say(_CAMERA)
            wait_for(lambda: self.client_id in server.get_clients())

    def say(self, message: _messages.Message) -> None:
        """Send a message of the client's."""
        self._line.send(msgspec.msgpack.encode(message.as_serializable_dict([])))

    def look(self, position: Sequence[float], look_at: Sequence[float]) -> None:
        """Say that the camera stands there and looks there [m], and wait until the server has heard it."""
        at, target = (tuple(map(float, point)) for point in (position, look_at))
        self.say(replace(_CAMERA, position=at, look_at=target))
        camera = self._server.get_clients()[self.client_id].camera
        wait_for(lambda: tuple(camera._state.position) == at and tuple(camera._state.look_at) == target)

    def hear(self) -> list[dict[str, Any]]:
        """The next messages."""
        return window(self._line.recv(timeout=300.0))

    def leave(self) -> None:
        """Close the page."""
        self._line.close()

    def break_off(self) -> None:
        """Go without a word."""
        with contextlib.suppress(OSError):
            self._line.socket.shutdown(socket.SHUT_RDWR)


def window(sent: bytes) -> list[dict[str, Any]]:
    """What viser packs into one message of a websocket: lengths, then MessagePack under zstd, then arrays."""
    size, packed = (int.from_bytes(sent[i : i + 8], "little") for i in (0, 8))
    text = zstandard.ZstdDecompressor().decompress(sent[16 : 16 + packed], max_output_size=size)
    return msgspec.msgpack.decode(text)["messages"]
