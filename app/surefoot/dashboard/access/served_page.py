"""Viser's page as it is served: with scripts of our own, and headers that keep it to itself.

Viser's client says "connecting" for ever when its websocket is refused, and a browser tells no script why. A page that
a proxy hands on often brings no trace of that either: only the page knows its own origin. So a script of the page asks
the server. Another one holds back what is typed into a number box until it is finished, a third tells how late the page
is drawn, and a fourth stands in for WebGL in a browser that has none.
"""

import gzip
import re
from collections.abc import Iterable
from urllib.parse import parse_qs, quote

from websockets.http11 import Response

from surefoot.resources import resource_folder

QUESTION = "/why-refused"
# Viser's client is one file that unpacks itself: inline scripts and styles, WebAssembly, workers and pictures made of
# blobs; a module of it makes functions out of text. It talks to where it comes from (data: and blob: are in itself),
# and nothing may come from, or go, elsewhere.
_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:",
        "worker-src 'self' blob: data:",
        "style-src 'self' 'unsafe-inline'",
        "img-src 'self' data: blob:",
        "font-src 'self' data:",
        "media-src 'self' data: blob:",
        "form-action 'none'",
        "base-uri 'none'",
        "object-src 'none'",
        "frame-ancestors 'self'",
    )
)
_HOST = re.compile(r"[A-Za-z0-9._-]+(:\d+)?")  # IPv6 addresses cannot stand in a policy
_HEADERS = {
    "X-Frame-Options": "SAMEORIGIN",
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
}
# in ``static/page``
_SCRIPTS = ("why_refused.js", "number_boxes.js", "frame_lateness.js", "without_webgl.js")


def question_url(origin: str) -> str:
    """What the page of an origin asks for."""
    return f"{QUESTION}?origin={quote(origin, safe='')}"


def origin_asked(path: str) -> str | None:
    """The origin that the page asks about; None for any other request."""
    place, _, query = path[:1000].partition("?")
    return parse_qs(query).get("origin", [""])[0] if place == QUESTION else None


def add_headers(response: Response, hosts: Iterable[str] = ()) -> Response:
    """A response with the headers that every one has; those that it brings stay.

    Args:
        response: is changed.
        hosts: with ports, by which the page may reach this server; not every browser counts a websocket as "self".
    """
    sockets = "".join(f" ws://{host} wss://{host}" for host in hosts if _HOST.fullmatch(host))
    policy = f"{_POLICY}; connect-src 'self' data: blob:{sockets}"
    for name, value in {"Content-Security-Policy": policy, **_HEADERS}.items():
        if name not in response.headers:
            response.headers[name] = value
    return response


class PageScripts:
    """Puts the scripts into the page, once for each encoding in which it is served."""

    def __init__(self) -> None:
        self._made: dict[tuple[str, int], bytes] = {}

    def put_into(self, response: Response) -> None:
        """Change viser's response to a request for the page.

        Args:
            response: body plain, or packed by gzip as its header says.
        """
        encoding = response.headers.get("Content-Encoding", "identity")
        key = encoding, len(response.body)
        if key not in self._made:
            self._made = {**self._made, key: _with_scripts(bytes(response.body), packed=encoding == "gzip")}
        response.body = self._made[key]
        del response.headers["Content-Length"]
        response.headers["Content-Length"] = str(len(response.body))
        response.headers["Cache-Control"] = "no-cache"


def _with_scripts(body: bytes, *, packed: bool) -> bytes:
    html = gzip.decompress(body) if packed else body
    head, mark, rest = html.partition(b"<head>")
    html = head + mark + b"".join(map(_script, _SCRIPTS)) + rest if mark else html
    return gzip.compress(html) if packed else html


def _script(name: str) -> bytes:
    return b"<script>" + (resource_folder("static") / "page" / name).read_bytes() + b"</script>"
