"""Runs that come as links: from the address of a page that was opened to the command that starts it.

The address is seen when the page is asked for, but nothing happens then: any page of the web could make a browser do
that. It gets a ticket, a cookie good for once, and only the page itself brings that back, with its websocket, which the
gate grants to our own origin alone. Then the run is started and the person is told what was.
"""

import secrets
from collections import OrderedDict, deque
from collections.abc import Callable
from http.cookies import CookieError, SimpleCookie
from urllib.parse import urlsplit

import viser

from surefoot.dashboard.messages.commands import Command, OpenLink
from surefoot.dashboard.messages.run_link import asks_for_run, link_text, read_link
from surefoot.errors import InvalidInput

_COOKIE = "surefoot_link"
_MOST_WAITING = 100
_LONGEST = 8000


class LinkHandoff:
    """Takes addresses in and starts what they ask for, once each."""

    def __init__(self) -> None:
        self._tickets: OrderedDict[str, str] = OrderedDict()
        self._arrived: deque[tuple[str, int | None]] = deque(maxlen=_MOST_WAITING)
        self._send: Callable[[Command], None] | None = None
        self._driver: Callable[[], int | None] = lambda: None

    def connect(
        self, server: viser.ViserServer, send: Callable[[Command], None], driver: Callable[[], int | None]
    ) -> None:
        """Say where commands go, and let newcomers be told what their link has started.

        Args:
            server: whose newcomers.
            send: takes the commands.
            driver: which visitor drives alone, so that nobody else's link starts anything; None: everybody may.
        """
        self._send, self._driver = send, driver

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            if self._arrived:
                title, text, good = _message(*self._arrived.popleft())
                colour = "green" if good else "red"
                client.add_notification(title, text, color=colour, auto_close_seconds=20.0)

    def issue_cookie(self, path: str, destination: str) -> str | None:
        """The cookie for a page that is being opened with a run in its address; None where there is none.

        Args:
            path: of the request, with the query.
            destination: its Sec-Fetch-Dest header; empty from programs that send none.
        """
        query = urlsplit(path[:_LONGEST]).query
        if destination not in ("document", "") or not asks_for_run(query):
            return None
        number = secrets.token_hex(16)
        self._tickets[number] = query
        while len(self._tickets) > _MOST_WAITING:
            self._tickets.popitem(last=False)
        return f"{_COOKIE}={number}; HttpOnly; SameSite=Strict; Path=/; Max-Age=120"

    def start_from_cookie(self, cookies: str) -> None:
        """Start what a page that connects has a ticket for.

        Args:
            cookies: Cookie header of its websocket.
        """
        try:
            morsel = SimpleCookie(cookies).get(_COOKIE)
        except CookieError:
            return
        query = self._tickets.pop(morsel.value, None) if morsel is not None else None
        if query is not None and self._send is not None:
            driver = self._driver()
            self._arrived.append((query, driver))
            if driver is None:
                self._send(OpenLink(query))


def _message(query: str, driver: int | None) -> tuple[str, str, bool]:
    if driver is not None:
        return "The link was not started", f"Visitor {driver} drives. Take control, then open the link again.", False
    try:
        return "Started from the link", link_text(read_link(query)), True
    except InvalidInput as error:
        return "The link could not be used", str(error), False
