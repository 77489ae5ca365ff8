"""Short pages that the server itself shows: what they look like, without a script or anything from elsewhere."""

import http

from websockets.datastructures import Headers
from websockets.http11 import Response

NOT_KEPT = ("Cache-Control", "no-store")
_POLICY = (
    "Content-Security-Policy",
    "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'",
)
_STYLE = """
:root { color-scheme: light dark; font: 15px/1.45 system-ui, sans-serif; }
body { margin: 0; min-height: 100vh; display: grid; place-items: center; }
main { width: min(26em, 88vw); }
h1 { font-size: 1.5em; margin: 0 0 .4em; }
label { display: block; font-weight: 600; margin: 1em 0 .3em; }
input[type=password], button { box-sizing: border-box; width: 100%; padding: .55em .7em; font: inherit;
  border: 1px solid #8888; border-radius: 6px; }
button { margin-top: .8em; background: #1c7ed6; border-color: #1c7ed6; color: #fff; font-weight: 600; cursor: pointer; }
[role=alert] { border-left: 4px solid #d55e00; padding-left: .7em; }
small { opacity: .75; }
code { overflow-wrap: anywhere; }
"""


def plain_page(status: http.HTTPStatus, body: str, head: str = "") -> Response:
    """A page of its own.

    Args:
        status: of the response.
        body: HTML, whatever came from outside escaped.
        head: more HTML for its head.
    """
    text = (
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Surefoot</title>{head}'
        f'<meta name="viewport" content="width=device-width"><style>{_STYLE}</style></head>'
        f"<body><main>{body}</main></body></html>"
    ).encode()
    headers = Headers(
        [("Content-Type", "text/html; charset=utf-8"), ("Content-Length", str(len(text))), NOT_KEPT, _POLICY]
    )
    return Response(status, status.phrase, headers, text)


def plain_text(status: http.HTTPStatus, text: str) -> Response:
    """A line for whoever asked for no page."""
    content = text.encode()
    headers = Headers([("Content-Type", "text/plain; charset=utf-8"), ("Content-Length", str(len(content))), NOT_KEPT])
    return Response(status, status.phrase, headers, content)
