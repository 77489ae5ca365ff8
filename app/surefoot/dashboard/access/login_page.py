"""What a browser without the token is shown: a form that asks for it, and the way in once it is right."""

import asyncio
import http
from collections import Counter
from html import escape
from urllib.parse import parse_qsl, unquote_plus

from websockets.datastructures import Headers
from websockets.http11 import Response

_LONGEST, _MOST_FIELDS = 8000, 100
_PAUSE_S, _MOST_WAITING = 1.0, 8
_HEADERS = (
    ("Cache-Control", "no-store"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Frame-Options", "DENY"),
    ("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; base-uri 'none'"),
)
_STYLE = """
:root { color-scheme: light dark; font: 15px/1.45 system-ui, sans-serif; }
body { margin: 0; min-height: 100vh; display: grid; place-items: center; }
main { width: min(22em, 88vw); }
h1 { font-size: 1.5em; margin: 0 0 .4em; }
label { display: block; font-weight: 600; margin: 1em 0 .3em; }
input[type=password], button { box-sizing: border-box; width: 100%; padding: .55em .7em; font: inherit;
  border: 1px solid #8888; border-radius: 6px; }
button { margin-top: .8em; background: #1c7ed6; border-color: #1c7ed6; color: #fff; font-weight: 600; cursor: pointer; }
[role=alert] { border-left: 4px solid #d55e00; padding-left: .7em; }
small { opacity: .75; }
code { white-space: nowrap; }
"""


class TokenThrottle:
    """Wrong tokens cost time: each waits, and of one address only so many may wait at once. Nobody else is held up.

    Args:
        pause_s: how long each waits.
        most: of one address at once.
    """

    def __init__(self, pause_s: float = _PAUSE_S, most: int = _MOST_WAITING) -> None:
        self._pause_s, self._most = pause_s, most
        self._waiting: Counter[str] = Counter()

    def too_many(self, address: str) -> bool:
        """Whether an address guesses so much that its next guess is not even looked at."""
        return self._waiting[address] >= self._most

    async def pay(self, address: str) -> None:
        """Wait for a wrong one."""
        self._waiting[address] += 1
        try:
            await asyncio.sleep(self._pause_s)
        finally:
            self._waiting[address] -= 1
            self._waiting += Counter()  # forgets addresses with none


def is_page(path: str, upgrade: str) -> bool:
    """Whether a request asks for the page itself, not for a file of it or a websocket."""
    return not upgrade and path.partition("?")[0] in ("/", "/index.html")


def token_in(path: str) -> str | None:
    """The token in an address, None where there is none."""
    return dict(_fields(path)).get("token")


def without_token(path: str) -> str:
    """The page's address with the rest of the query as it was."""
    query = path[:_LONGEST].partition("?")[2]
    kept = "&".join(part for part in query.split("&") if part and unquote_plus(part.partition("=")[0]) != "token")
    return f"/?{kept}" if kept else "/"


def login_form(path: str, *, wrong: bool) -> Response:
    """The form; what else the address asks for comes along.

    Args:
        path: of the request, with the query.
        wrong: whether a token was given, and it was wrong.
    """
    hidden = "".join(
        f'<input type="hidden" name="{escape(name)}" value="{escape(value)}">'
        for name, value in _fields(path)
        if name != "token"
    )
    alert = '<p role="alert">That was not the token of this dashboard. Try again.</p>' if wrong else ""
    return _html(
        http.HTTPStatus.FORBIDDEN,
        f"<main><h1>Surefoot</h1><p>This robot is driven only by people who have its token.</p>{alert}"
        f'<form method="get" action="/">{hidden}<label for="token">Token</label>'
        '<input id="token" name="token" type="password" autocomplete="current-password" autofocus required>'
        "<button>Open the dashboard</button></form>"
        "<p><small>Whoever started the dashboard chose it with <code>--token</code>.</small></p></main>",
    )


def redirect_logged_in(path: str, cookie: str | None, site: str) -> Response:
    """To the address without the token, so that it stays in no history and no referrer; with the cookie.

    A strict cookie does not go along with a redirect that another site has begun, so such a browser gets a page that
    sends it on: that way it comes from here.

    Args:
        path: of the request, with the query.
        cookie: Set-Cookie header, if any.
        site: its Sec-Fetch-Site header; empty where the browser tells none.
    """
    place = without_token(path)
    if site in ("none", "same-origin"):
        response = Response(
            http.HTTPStatus.SEE_OTHER, "See Other", Headers([("Location", place), ("Content-Length", "0"), *_HEADERS])
        )
    else:
        response = refresh_redirect(place)
    if cookie is not None:
        response.headers["Set-Cookie"] = cookie
    return response


def refresh_redirect(place: str) -> Response:
    """A page that goes to another place of this server at once."""
    where = escape(place)
    return _html(
        http.HTTPStatus.OK,
        f'<main><p>Opening <a href="{where}">the dashboard</a> ...</p></main>',
        head=f'<meta http-equiv="refresh" content="0;url={where}">',
    )


def _fields(path: str) -> list[tuple[str, str]]:
    try:
        return parse_qsl(path[:_LONGEST].partition("?")[2], keep_blank_values=True, max_num_fields=_MOST_FIELDS)
    except ValueError:
        return []


def _html(status: http.HTTPStatus, body: str, head: str = "") -> Response:
    text = (
        f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Surefoot</title>{head}'
        f'<meta name="viewport" content="width=device-width"><style>{_STYLE}</style></head><body>{body}</body></html>'
    ).encode()
    kind = ("Content-Type", "text/html; charset=utf-8")
    return Response(status, status.phrase, Headers([kind, ("Content-Length", str(len(text))), *_HEADERS]), text)
