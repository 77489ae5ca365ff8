"""HTTP requests to a dashboard, without a browser."""

import gzip
import http.client
from email.message import Message


def ask(running, path: str = "/", **headers: str) -> tuple[int, Message, str]:
    """One request, no redirect followed: status, headers, text.

    Args:
        running: the dashboard.
        path: with the query.
        headers: names with ``_`` for ``-``.
    """
    line = http.client.HTTPConnection("127.0.0.1", running.server.get_port(), timeout=60)
    line.request("GET", path, headers={name.replace("_", "-"): value for name, value in headers.items()})
    answer = line.getresponse()
    body = answer.read()
    line.close()
    assert answer.headers["Content-Length"] in (str(len(body)), None)  # a handshake has none
    text = gzip.decompress(body) if answer.headers["Content-Encoding"] == "gzip" else body
    return answer.status, answer.headers, text.decode(errors="replace")
