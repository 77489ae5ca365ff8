"""Where a page comes from: its origin, the host that it asks for, and those that are allowed besides our own."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from urllib.parse import urlsplit

from surefoot.errors import InvalidInput

LOOPBACK = ("127.0.0.1", "localhost", "::1")
_DEFAULT_PORTS = {"http": 80, "https": 443}
_HOST = re.compile(r"[a-z0-9]([a-z0-9._-]*[a-z0-9])?|[0-9a-f:.]*:[0-9a-f:.]*")
_EXAMPLES = ("https://robot.example.org", "http://192.168.1.5:9000")


@dataclass(frozen=True)
class Origin:
    """What a browser calls the origin of a page.

    Attributes:
        scheme: http or https.
        host: in small letters; an IPv6 address without its brackets.
        port: the scheme's own where the address names none.
    """

    scheme: str
    host: str
    port: int

    def __str__(self) -> str:
        """As a browser writes it."""
        shown = f"[{self.host}]" if ":" in self.host else self.host
        port = "" if self.port == _DEFAULT_PORTS[self.scheme] else f":{self.port}"
        return f"{self.scheme}://{shown}{port}"


def read_origin(text: str) -> Origin | None:
    """The origin in an Origin header; None for ``null`` and whatever is no page of the web."""
    try:
        parts = urlsplit(text)
        port = parts.port
    except ValueError:
        return None
    if parts.scheme not in _DEFAULT_PORTS or parts.hostname is None:
        return None
    return Origin(parts.scheme, parts.hostname, _DEFAULT_PORTS[parts.scheme] if port is None else port)


def allowed_origins(texts: Iterable[str]) -> frozenset[Origin]:
    """The origins that ``--allow-origin`` names.

    Raises:
        InvalidInput: one is not scheme, name and perhaps a port, and nothing else.
    """
    return frozenset(_allowed_origin(text) for text in texts)


def host_name(host: str) -> str:
    """The name in a Host header, without the port; empty where there is none."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


def is_same_place(origin: Origin, host: str) -> bool:
    """Whether a page's origin is the server that it talks to; this machine's own names are one.

    Args:
        origin: of the page.
        host: Host header of its request.
    """
    try:
        asked = urlsplit(f"//{host}")
        port = _DEFAULT_PORTS[origin.scheme] if asked.port is None else asked.port
    except ValueError:
        return False
    if port != origin.port:
        return False
    return origin.host == asked.hostname or (origin.host in LOOPBACK and asked.hostname in LOOPBACK)


def _allowed_origin(text: str) -> Origin:
    given = text.strip()
    try:
        given = given.encode("ascii").decode()
    except UnicodeEncodeError:  # a browser sends a name with other letters in its ASCII form
        try:
            scheme, mark, rest = given.partition("://")
            given = f"{scheme}{mark}{rest.encode('idna').decode()}"
        except UnicodeError:
            given = ""
    origin = read_origin(given)
    if origin is None or not _HOST.fullmatch(origin.host) or _beside_origin(given):
        reason = "must be scheme and name, as the browser's address bar has them before the path"
        raise InvalidInput("--allow-origin", text, reason, _EXAMPLES)
    return origin


def _beside_origin(text: str) -> bool:
    """Whether an address says more than an origin does."""
    parts = urlsplit(text)
    return bool(parts.path.strip("/") or parts.query or parts.fragment or "@" in parts.netloc)
