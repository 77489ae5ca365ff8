"""Where a page listens, and the address to open it at."""

import socket
import sys

from surefoot.errors import InvalidInput

_FIRST_PORT = 8080
_PORTS_TRIED = 100
_EVERY_INTERFACE = ("0.0.0.0", "::", "")  # hosts to listen at, but none to open


def page_address(host: str, port: int, token: str | None = None) -> str:
    """What to open in a browser; without a path where no token is asked for.

    Args:
        host: where the server listens; an IPv6 address gets its brackets.
        port: at which it listens.
        token: asked of strangers; becomes part of the address.
    """
    shown = "localhost" if host in _EVERY_INTERFACE else host
    query = f"/?token={token}" if token else ""
    return f"http://{f'[{shown}]' if ':' in shown else shown}:{port}{query}"


def printed_address(address: str) -> str:
    """A page's address as it is printed: with the token on a terminal only, for whatever else reads may keep it."""
    return address if sys.stdout.isatty() else address.partition("/?token=")[0]


def free_port(host: str, port: int | None) -> int:
    """A given port, checked to be free, or the first free one from 8080.

    Args:
        host: where to listen.
        port: 0 for any, None for the first free one.

    Raises:
        InvalidInput: no such port, or taken, or none is free.
    """
    if port is not None:
        if not 0 <= port <= 65535:
            raise InvalidInput("--port", port, "no such port", ["0 to 65535"])
        if not _is_free(host, port):
            raise InvalidInput("--port", port, f"cannot be listened on at {host}: taken or not allowed")
        return port
    for candidate in range(_FIRST_PORT, _FIRST_PORT + _PORTS_TRIED):
        if _is_free(host, candidate):
            return candidate
    raise InvalidInput("--host", host, f"no free port from {_FIRST_PORT} to {_FIRST_PORT + _PORTS_TRIED - 1}")


def _is_free(host: str, port: int) -> bool:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
    except OSError:
        return False
    return True
