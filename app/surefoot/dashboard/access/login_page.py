"""What a browser without the token is shown: a form that asks for it, and the way in once it is right."""

import http
from html import escape
from urllib.parse import parse_qsl, unquote_plus

from websockets.datastructures import Headers
from websockets.http11 import Response

from surefoot.dashboard.access.plain_page import NOT_KEPT, plain_page

_LONGEST, _MOST_FIELDS = 8000, 100


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
    return plain_page(
        http.HTTPStatus.FORBIDDEN,
        f"<h1>Surefoot</h1><p>This robot is driven only by people who have its token.</p>{alert}"
        f'<form method="get" action="/">{hidden}<label for="token">Token</label>'
        '<input id="token" name="token" type="password" autocomplete="current-password" autofocus required>'
        "<button>Open the dashboard</button></form>"
        "<p><small>Whoever started the dashboard chose it with <code>--token</code>.</small></p>",
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
            http.HTTPStatus.SEE_OTHER, "See Other", Headers([("Location", place), ("Content-Length", "0"), NOT_KEPT])
        )
    else:
        response = refresh_redirect(place)
    if cookie is not None:
        response.headers["Set-Cookie"] = cookie
    return response


def refresh_redirect(place: str) -> Response:
    """A page that goes to another place of this server at once."""
    where = escape(place)
    return plain_page(
        http.HTTPStatus.OK,
        f'<p>Opening <a href="{where}">the dashboard</a> ...</p>',
        head=f'<meta http-equiv="refresh" content="0;url={where}">',
    )


def _fields(path: str) -> list[tuple[str, str]]:
    try:
        return parse_qsl(path[:_LONGEST].partition("?")[2], keep_blank_values=True, max_num_fields=_MOST_FIELDS)
    except ValueError:
        return []
