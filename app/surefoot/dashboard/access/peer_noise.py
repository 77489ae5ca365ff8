"""What the other side of a connection does wrong is no error of ours: a line for those who look for it, no traceback.

A port probe, a load balancer, a browser that speaks TLS, a request cut off: websockets and viser print a traceback for
each.
"""

import asyncio
import logging
from collections.abc import Iterator
from types import TracebackType
from typing import Any

from websockets.exceptions import WebSocketException

_NOISE = logging.getLogger("surefoot.dashboard.connections")
_READS = "_message_consumer"  # viser's, a message
_HANDLES = ("_handle_incoming_message", "guarded")  # viser's and ours: what a message asks for
_OURS_ON_THE_WAY = "surefoot.dashboard.access.client_context"


def connection_logger() -> logging.Logger:
    """The logger for websockets.

    It never writes requests down, whatever a program around it has asked for: tokens are in them.
    """
    logger = logging.getLogger("surefoot.dashboard.websockets")
    logger.setLevel(logging.WARNING)
    if not any(isinstance(known, _PeerNoise) for known in logger.filters):
        logger.addFilter(_PeerNoise())
    return logger


def quieten(loop: asyncio.AbstractEventLoop) -> None:
    """Make one debug line of what a nonsensical message breaks in the tasks of an event loop."""

    def handle(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        error = context.get("exception")
        if is_of_peer(error):
            _note(str(context.get("message", "")), error)
        else:
            loop.default_exception_handler(context)

    loop.call_soon_threadsafe(loop.set_exception_handler, handle)


def is_of_peer(error: BaseException | None) -> bool:
    """Whether the other side of a connection is to blame: it went away, or what it sent is no request or message."""
    if error is None or isinstance(error, WebSocketException | EOFError | ConnectionError | TimeoutError):
        return error is not None
    frames = list(_frames(error.__traceback__))
    if any(function == _READS for _, function in frames):
        return True
    ours = [module for module, _ in frames if module.startswith("surefoot") and module != _OURS_ON_THE_WAY]
    return any(function in _HANDLES for _, function in frames) and not ours  # viser could make nothing of it


class _PeerNoise(logging.Filter):
    """Makes one debug line of what is of the peer, and lets all else pass."""

    def filter(self, record: logging.LogRecord) -> bool:
        error = record.exc_info[1] if record.exc_info else None
        if not is_of_peer(error):
            return True
        _note(record.getMessage(), error)
        return False


def _note(what: str, error: BaseException | None) -> None:
    cause = error.__cause__ if error is not None and error.__cause__ is not None else error
    _NOISE.debug("%s: %s", what, type(cause).__name__)  # not its text, which may quote what was sent


def _frames(traceback: TracebackType | None) -> Iterator[tuple[str, str]]:
    """Module and function, outermost first."""
    while traceback is not None:
        frame = traceback.tb_frame
        yield str(frame.f_globals.get("__name__", "")), frame.f_code.co_name
        traceback = traceback.tb_next
