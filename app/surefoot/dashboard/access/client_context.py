"""Whose callback is running, and which of the page's widgets a visitor may move.

Viser runs callbacks in its event loop (``async``) or in threads of a pool, and shows every visitor's move of a widget
to all others before any callback is asked. It has no place where either can be known or refused, so its two doors are
wrapped here: the one through which messages come in, and the one through which callbacks go to threads.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import viser
from viser import _messages

from surefoot.dashboard.access.uploads import UploadLimit

_CLIENT: ContextVar[int | None] = ContextVar("client", default=None)


def current_client() -> int | None:
    """The client whose callback is running, None outside of any."""
    return _CLIENT.get()


@contextmanager
def as_client(client_id: int | None) -> Iterator[None]:
    """What runs in here runs for that client."""
    before = _CLIENT.set(client_id)
    try:
        yield
    finally:
        _CLIENT.reset(before)


class ClientGuard:
    """Knows which client calls a server, and lets only some move widgets.

    Args:
        server: whose messages and callbacks; made before the page's widgets.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._free: set[str] = set()
        self.accepts: Callable[[int], bool] = lambda client_id: True
        self._uploads = UploadLimit(server)
        self._name_callbacks()
        self._guard_messages()

    @contextmanager
    def free(self) -> Iterator[None]:
        """Widgets that are made in here can be moved by everybody: they change what is looked at, not the run."""
        known = self._server.gui._gui_input_handle_from_uuid
        before = set(known)
        yield
        self._free |= set(known) - before

    def _name_callbacks(self) -> None:
        pool = self._server._thread_executor
        submit = pool.submit

        def named(function: Callable[..., Any], /, *args: Any, **rest: Any) -> Any:
            client_id = getattr(args[0], "client_id", None) if args else None

            def run() -> Any:
                with as_client(client_id):
                    return function(*args, **rest)

            return submit(run)

        pool.submit = named  # type: ignore[method-assign]

    def _guard_messages(self) -> None:
        doors = self._server._websock_server
        come_in = doors._handle_incoming_message

        async def guarded(client_id: Any, message: Any) -> None:
            if isinstance(message, _messages.GuiUpdateMessage) and not self._may_move(client_id, message.uuid):
                self._put_back(client_id, message.uuid)
                return
            if (refused := self._uploads.refusal(client_id, message)) is not None:
                self._tell(client_id, "The file was not loaded", refused)
                return
            with as_client(client_id):
                await come_in(client_id, message)

        doors._handle_incoming_message = guarded  # type: ignore[method-assign]

    def _tell(self, client_id: int, title: str, text: str) -> None:
        client = self._server.get_clients().get(client_id)
        if client is not None:
            client.add_notification(title, text, color="red")

    def _may_move(self, client_id: int, uuid: str) -> bool:
        return uuid in self._free or uuid not in self._server.gui._gui_input_handle_from_uuid or self.accepts(client_id)

    def _put_back(self, client_id: int, uuid: str) -> None:
        """Show who moved a widget in vain what it really says."""
        handle = self._server.gui._gui_input_handle_from_uuid.get(uuid)
        client = self._server.get_clients().get(client_id)
        if handle is None or client is None or handle._impl.is_button:
            return
        client._websock_connection.queue_message(_messages.GuiUpdateMessage(uuid, {"value": handle._impl.value}))
