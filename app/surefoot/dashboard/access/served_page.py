"""Viser's page as it is served: with a script that tells why it cannot connect, and headers that keep it to itself.

Viser's client says "connecting" for ever when its websocket is refused, and a browser tells no script why. A page that
a proxy hands on often brings no trace of that either: only the page knows its own origin. So it asks the server.
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
# Asks at once, when viser's first tries are through, and from time to time: a server may come back with another token.
_SCRIPT = """<script>(() => {
  const bar = document.createElement("div");
  bar.setAttribute("role", "alert");
  bar.setAttribute("aria-label", "Why this page cannot connect");
  bar.style.cssText = "position:fixed;inset:0 0 auto 0;z-index:100000;padding:12px 16px;font:15px/1.45 system-ui," +
    "sans-serif;background:#fff4e6;color:#1a1b1e;border-bottom:3px solid #d55e00;overflow-wrap:anywhere";
  const waits = [3, 7];
  const ask = async () => {
    try {
      const answer = await fetch("QUESTION?origin=" + encodeURIComponent(location.origin), {cache: "no-store"});
      const kind = answer.headers.get("Content-Type") || "";
      const text = answer.ok && kind.startsWith("text/plain") ? (await answer.text()).trim() : "";
      bar.textContent = text;
      if (text) document.body.append(bar); else bar.remove();
    } catch { /* the server is gone: viser's client says that itself */ }
    setTimeout(ask, 1000 * (waits.shift() || 30));
  };
  if (document.body) ask(); else document.addEventListener("DOMContentLoaded", ask);
})()</script>""".replace("QUESTION", QUESTION.lstrip("/"))


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


class PageScript:
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
            self._made = {**self._made, key: _with_script(bytes(response.body), packed=encoding == "gzip")}
        response.body = self._made[key]
        del response.headers["Content-Length"]
        response.headers["Content-Length"] = str(len(response.body))
        response.headers["Cache-Control"] = "no-cache"


def _with_script(body: bytes, *, packed: bool) -> bytes:
    html = gzip.decompress(body) if packed else body
    head, mark, rest = html.partition(b"<head>")
    html = head + mark + _SCRIPT.encode() + _number_boxes() + rest if mark else html
    return gzip.compress(html) if packed else html


def _number_boxes() -> bytes:
    """The script that lets numbers be typed in peace."""
    return b"<script>" + (resource_folder("static") / "page" / "number_boxes.js").read_bytes() + b"</script>"
