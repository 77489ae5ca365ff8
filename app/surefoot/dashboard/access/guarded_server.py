"""Viser's server behind the gate: every request is looked at first, and whoever is refused is told why."""

import http
from collections import OrderedDict
from collections.abc import Callable
from html import escape
from typing import Any

import viser
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import MultipleValuesError
from websockets.http11 import Request, Response

from surefoot.dashboard.access.frame_report import is_report, read_report
from surefoot.dashboard.access.gate import Gate, Refusal
from surefoot.dashboard.access.link_handoff import LinkHandoff
from surefoot.dashboard.access.login_page import (
    is_page,
    login_form,
    redirect_logged_in,
    refresh_redirect,
    token_in,
    without_token,
)
from surefoot.dashboard.access.paced_messages import PacedMessages
from surefoot.dashboard.access.peer_noise import connection_logger, quieten
from surefoot.dashboard.access.plain_page import plain_page, plain_text
from surefoot.dashboard.access.served_page import PageScripts, add_headers, origin_asked
from surefoot.dashboard.access.token_throttle import TokenThrottle, guesser
from surefoot.dashboard.access.watched_connection import WatchedConnection
from surefoot.errors import InvalidInput

LARGEST_MESSAGE = 16 * 2**20  # bytes; a picture of the scene, the largest that a page sends, has about 9 MB at most
_MOST_REMEMBERED, _LONGEST_ORIGIN = 100, 300


def guarded_server(
    host: str, port: int, gate: Gate, links: LinkHandoff | None = None, paces: PacedMessages | None = None
) -> viser.ViserServer:
    """Viser's server behind the gate. Its own ``serve`` has no room for one, so it is wrapped while it starts."""
    serve = websockets.asyncio.server.serve

    def guarded_serve(*args: Any, process_request: Callable[..., Any], **rest: Any) -> Any:
        rest |= {"max_size": LARGEST_MESSAGE, "logger": connection_logger(), "server_header": None}
        rest |= {"create_connection": WatchedConnection}
        return serve(*args, process_request=RequestGuard(gate, links, process_request, paces).answer, **rest)

    websockets.asyncio.server.serve = guarded_serve  # type: ignore[assignment,misc]
    try:
        server = viser.ViserServer(host=host, port=port, verbose=False)
    finally:
        websockets.asyncio.server.serve = serve  # type: ignore[misc]
    quieten(server.get_event_loop())
    if paces is not None:
        paces.connect(server)
    server.request_share_url = _no_tunnel  # type: ignore[method-assign]
    return server


class RequestGuard:
    """Answers requests, or lets them pass to the server behind.

    Args:
        gate: decides who may pass.
        links: takes the runs that addresses ask for; None to take none.
        behind: answers requests that pass; None from it means a websocket.
        paces: takes what pages say about their frames; None to take nothing.
    """

    def __init__(
        self,
        gate: Gate,
        links: LinkHandoff | None,
        behind: Callable[[ServerConnection, Request], Response | None],
        paces: PacedMessages | None = None,
    ) -> None:
        self._gate, self._links, self._behind, self._paces = gate, links, behind, paces
        self._guesses, self._scripts = TokenThrottle(), PageScripts()
        self._cut_off: OrderedDict[str, None] = OrderedDict()  # origins whose websockets arrive as plain requests

    async def answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """What a request is answered; None: it is a websocket, and let in."""
        try:
            response = await self._answer(connection, request)
        except MultipleValuesError as error:  # which of the two would a proxy before us have looked at?
            response = plain_text(http.HTTPStatus.BAD_REQUEST, f"more than one header {error}\n")
        hosts = (request.headers.get_all("Host")[:1] or [""])[0], *self._gate.allowed_hosts
        return None if response is None else add_headers(response, hosts)

    async def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        headers, path = request.headers, request.path
        host, origin = headers.get("Host", ""), headers.get("Origin")
        page, scheme = is_page(path, headers.get("Upgrade", "")), headers.get("X-Forwarded-Proto", "")
        if (refusal := self._gate.foreign(host, origin, scheme)) is not None:
            return _refusal_page(refusal) if page else plain_text(http.HTTPStatus.FORBIDDEN, f"{refusal}\n")
        if (asked := origin_asked(path)) is not None:
            return plain_text(http.HTTPStatus.OK, self._why_refused(host, asked, headers.get("Cookie", "")))
        if self._gate.needs_token and (response := await self._ask_token(connection, request, page)) is not None:
            return response
        if self._paces is not None and is_report(path):
            return _take_report(self._paces, path)
        if (response := self._odd_websocket(request)) is not None:
            return response
        try:
            response = self._behind(connection, request)
        except OSError:  # a name that no file could have
            response = plain_text(http.HTTPStatus.NOT_FOUND, "no such file\n")
        if response is None:
            if self._links is not None:
                self._links.start_from_cookie(headers.get("Cookie", ""))
            return None
        if page and response.status_code == http.HTTPStatus.OK:
            self._scripts.put_into(response)
        if self._links is not None and (cookie := self._links.issue_cookie(path, headers.get("Sec-Fetch-Dest", ""))):
            response.headers["Set-Cookie"] = cookie
        return response

    def _why_refused(self, host: str, origin: str, cookies: str) -> str:
        """Why a page of that origin cannot connect; empty when it can."""
        if (refusal := self._gate.foreign(host, origin)) is not None:
            return str(refusal)
        if not self._gate.knows("", cookies):
            return "This dashboard asks for its token: load the page again to give it."
        if origin in self._cut_off:
            return (
                f"The proxy at {origin} does not hand websockets on: it must pass the headers Upgrade and Connection. "
                "The help of the dashboard shows how."
            )
        return ""

    def _odd_websocket(self, request: Request) -> Response | None:
        """What a websocket is told that viser's client did not open, or a proxy has cut; None for all else."""
        headers = request.headers
        origin, key = headers.get("Origin", ""), headers.get("Sec-WebSocket-Key")
        if headers.get("Upgrade") != "websocket":
            if key is None:
                return None
            self._cut_off[origin[:_LONGEST_ORIGIN]] = None
            while len(self._cut_off) > _MOST_REMEMBERED:
                self._cut_off.popitem(last=False)
            return plain_text(http.HTTPStatus.UPGRADE_REQUIRED, "a proxy has taken the header Upgrade away\n")
        self._cut_off.pop(origin, None)
        if "viser-v" not in headers.get("Sec-WebSocket-Protocol", ""):
            return plain_text(http.HTTPStatus.BAD_REQUEST, "only the dashboard's own page may connect\n")
        return None

    async def _ask_token(self, connection: ServerConnection, request: Request, page: bool) -> Response | None:
        """What a request is told that does not simply bring the token as a cookie; None: let it pass."""
        gate, guesses, headers, path = self._gate, self._guesses, request.headers, request.path
        site, cookies = headers.get("Sec-Fetch-Site", ""), headers.get("Cookie", "")
        if gate.guesses("", cookies) or token_in(path) is not None:
            peer, forwarded = str((connection.remote_address or ("",))[0]), headers.get("X-Forwarded-For", "")
            address = guesser(peer, forwarded, behind_proxy=gate.behind_proxy)
            if guesses.too_many(address):
                return plain_text(http.HTTPStatus.TOO_MANY_REQUESTS, "too many wrong tokens at once, wait\n")
            if gate.guesses(path, cookies):
                await guesses.pay(address)
        if gate.knows(path, cookies):
            return (
                redirect_logged_in(path, gate.new_cookie(path), site) if page and token_in(path) is not None else None
            )
        if not page:
            return plain_text(http.HTTPStatus.FORBIDDEN, "open the page, it asks for the token\n")
        wrong = token_in(path) is not None
        if site == "cross-site" and not wrong:  # a link was followed: the strict cookie comes with our requests only
            return refresh_redirect(without_token(path))
        return login_form(path, wrong=wrong)


def _refusal_page(refusal: Refusal) -> Response:
    flag = f"<p><code>surefoot dashboard {escape(refusal.flag)}</code></p>" if refusal.flag else ""
    return plain_page(
        http.HTTPStatus.FORBIDDEN,
        f'<h1>Surefoot</h1><p role="alert">{escape(refusal.what)}</p><p>{escape(refusal.remedy)}</p>{flag}',
    )


def _take_report(paces: PacedMessages, path: str) -> Response:
    try:
        known = paces.report(read_report(path))
    except InvalidInput as error:
        return plain_text(http.HTTPStatus.BAD_REQUEST, f"{error}\n")
    if not known:
        return plain_text(http.HTTPStatus.NOT_FOUND, "no page that is open has this key\n")
    return plain_text(http.HTTPStatus.OK, "")


def _no_tunnel(verbose: bool = True) -> None:
    """Any client could ask for a public address; it gets none."""
