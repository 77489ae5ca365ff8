"""Who may talk to the page: no foreign origin, no stranger without the token, no public tunnel."""

import hmac
import http
from collections.abc import Callable
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import urlsplit

import viser
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

from surefoot.dashboard.access.link_handoff import LinkHandoff
from surefoot.dashboard.access.login_page import (
    TokenThrottle,
    is_page,
    login_form,
    redirect_logged_in,
    refresh_redirect,
    token_in,
    without_token,
)
from surefoot.errors import InvalidInput

LOOPBACK = ("127.0.0.1", "localhost", "::1")
LEAST_TOKEN = 16
_COOKIE = "surefoot_token"


def check_listening(host: str, token: str | None) -> None:
    """Listening on other addresses than this machine's own needs a token. Raises InvalidInput."""
    if token is not None and (len(token) < LEAST_TOKEN or not token.isascii() or not token.isalnum()):
        raise InvalidInput("--token", "...", "must be letters and digits", [f"{LEAST_TOKEN} or more of them"])
    if host not in LOOPBACK and token is None:
        raise InvalidInput("--host", host, "anyone there could drive the robot: give a --token too", LOOPBACK)


class Gate:
    """Looks at every request before viser does.

    Args:
        token: what strangers must bring; None when only this machine may connect.
    """

    def __init__(self, token: str | None) -> None:
        self._token = token

    def refusal(self, host: str, origin: str | None, path: str, cookies: str) -> str | None:
        """Why a request is refused, or None.

        Args:
            host: its Host header.
            origin: its Origin header; browsers always send one with a websocket, other programs none.
            path: with the query.
            cookies: its Cookie header.
        """
        if (reason := self.foreign(host, origin)) is not None:
            return reason
        return None if self.knows(path, cookies) else "open the page with ?token=..."

    def foreign(self, host: str, origin: str | None) -> str | None:
        """Why a request from that place is refused whatever it brings, or None."""
        if self._token is None and _name(host) not in LOOPBACK:
            return "this page answers to this machine's own names only"  # a rebound foreign name
        if origin is not None and not _same_place(origin, host):
            return "a page from another place may not drive this robot"
        return None

    def knows(self, path: str, cookies: str) -> bool:
        """Whether a request brings the token, in its address or as the cookie; true where none is needed."""
        return self._token is None or self._is_token(token_in(path)) or self._is_token(_cookie_in(cookies))

    def guesses(self, path: str, cookies: str) -> bool:
        """Whether a request brings a token, but a wrong one."""
        return not self.knows(path, cookies) and (token_in(path) or _cookie_in(cookies)) is not None

    def new_cookie(self, path: str) -> str | None:
        """The cookie for a browser that came with the token in its address."""
        if not self._is_token(token_in(path)):
            return None
        return f"{_COOKIE}={self._token}; HttpOnly; SameSite=Strict; Path=/"

    def _is_token(self, given: str | None) -> bool:
        if self._token is None or given is None:
            return False
        return hmac.compare_digest(given.encode(errors="replace"), self._token.encode())


def guarded_server(host: str, port: int, token: str | None, links: LinkHandoff | None = None) -> viser.ViserServer:
    """Viser's server behind the gate. Its own ``serve`` has no room for one, so it is wrapped while it starts."""
    gate, guesses, serve = Gate(token), TokenThrottle(), websockets.asyncio.server.serve

    def guarded_serve(*args: Any, process_request: Callable[..., Any], **rest: Any) -> Any:
        async def look(connection: ServerConnection, request: Request) -> Response | None:
            headers, path = request.headers, request.path
            if (reason := gate.foreign(headers.get("Host", ""), headers.get("Origin"))) is not None:
                return connection.respond(http.HTTPStatus.FORBIDDEN, reason + "\n")
            if token is not None and (response := await _token_asked(gate, guesses, connection, request)) is not None:
                return response
            response = process_request(connection, request)
            if links is not None and response is None:  # a websocket
                links.start_from_cookie(headers.get("Cookie", ""))
            if response is not None:
                if links is not None and (cookie := links.issue_cookie(path, headers.get("Sec-Fetch-Dest", ""))):
                    response.headers["Set-Cookie"] = cookie
                response.headers["X-Frame-Options"] = "SAMEORIGIN"
            return response

        return serve(*args, process_request=look, **rest)

    websockets.asyncio.server.serve = guarded_serve  # type: ignore[assignment,misc]
    try:
        server = viser.ViserServer(host=host, port=port, verbose=False)
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]
    server.request_share_url = _no_tunnel  # type: ignore[method-assign]
    return server


async def _token_asked(
    gate: Gate, guesses: TokenThrottle, connection: ServerConnection, request: Request
) -> Response | None:
    """What a request is told that does not simply bring the token as a cookie; None: let it pass."""
    headers, path = request.headers, request.path
    page, site = is_page(path, headers.get("Upgrade", "")), headers.get("Sec-Fetch-Site", "")
    cookies, address = headers.get("Cookie", ""), str((connection.remote_address or ("",))[0])
    if gate.guesses("", cookies) or token_in(path) is not None:
        if guesses.too_many(address):
            return connection.respond(http.HTTPStatus.TOO_MANY_REQUESTS, "too many wrong tokens at once, wait\n")
        if gate.guesses(path, cookies):
            await guesses.pay(address)
    if gate.knows(path, cookies):
        return redirect_logged_in(path, gate.new_cookie(path), site) if page and token_in(path) is not None else None
    if not page:
        return connection.respond(http.HTTPStatus.FORBIDDEN, "open the page, it asks for the token\n")
    wrong = token_in(path) is not None
    if site == "cross-site" and not wrong:  # a link was followed: the strict cookie comes with requests from here only
        return refresh_redirect(without_token(path))
    return login_form(path, wrong=wrong)


def _no_tunnel(verbose: bool = True) -> None:
    """Any client could ask for a public address; it gets none."""


def _cookie_in(cookies: str) -> str | None:
    try:
        morsel = SimpleCookie(cookies).get(_COOKIE)
    except CookieError:
        return None
    return None if morsel is None else morsel.value


def _name(host: str) -> str:
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""


def _same_place(origin: str, host: str) -> bool:
    """Whether a page's origin is the server that it talks to; this machine's own names are one."""
    try:
        theirs, ours = urlsplit(origin), urlsplit(f"//{host}")
        same_port = (theirs.port or 80) == (ours.port or 80)
    except ValueError:
        return False
    if theirs.scheme not in ("http", "https") or theirs.hostname is None:
        return False
    if theirs.hostname == ours.hostname:
        return theirs.netloc == ours.netloc
    return same_port and theirs.hostname in LOOPBACK and ours.hostname in LOOPBACK
