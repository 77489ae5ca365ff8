"""Runs that come as links: from the address of a page that was opened to the command that starts it.

The address is seen when the page is asked for, but nothing happens then: any page of the web could make a browser do
that. It gets a ticket, a cookie good for once, and only the page itself brings that back, with its websocket, which the
gate grants to our own origin alone. Then the run is asked for, and the person is told what has become of that.
"""

import secrets
import time
from collections import OrderedDict, deque
from collections.abc import Callable
from dataclasses import dataclass
from http.cookies import CookieError, SimpleCookie
from urllib.parse import urlsplit

import viser

from surefoot.dashboard.messages.commands import Command, OpenLink
from surefoot.dashboard.messages.run_link import asks_for_run, link_text, read_link
from surefoot.dashboard.messages.snapshot import Snapshot

_COOKIE = "surefoot_link"
_MOST_WAITING = 100
_LONGEST = 8000
_LOOK_EVERY_S = 0.05
_LOOKS = 1200  # for a minute: a process that simulates may have to be started again first


@dataclass(frozen=True)
class _Arrival:
    """A link whose page has connected.

    Attributes:
        query: of the link.
        ticket: of the command that asked for it.
        driver: the visitor who drives alone, so that nothing was asked for.
    """

    query: str
    ticket: str
    driver: int | None


class LinkHandoff:
    """Takes addresses in and starts what they ask for, once each."""

    def __init__(self) -> None:
        self._tickets: OrderedDict[str, str] = OrderedDict()
        self._arrived: deque[_Arrival] = deque(maxlen=_MOST_WAITING)
        self._send: Callable[[Command], None] | None = None
        self._driver: Callable[[], int | None] = lambda: None

    def connect(
        self,
        server: viser.ViserServer,
        send: Callable[[Command], None],
        driver: Callable[[], int | None],
        newest: Callable[[], Snapshot],
    ) -> None:
        """Say where commands go, and let newcomers be told what has become of their link.

        Args:
            server: whose newcomers.
            send: takes the commands.
            driver: which visitor drives alone, so that nobody else's link starts anything; None: everybody may.
            newest: gives the newest snapshot, which says what became of links.
        """
        self._send, self._driver = send, driver

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            if self._arrived:
                title, text, good = _outcome(self._arrived.popleft(), newest)
                colour = "green" if good else "red"
                client.add_notification(title, text, color=colour, auto_close_seconds=20.0 if good else None)

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
            arrival = _Arrival(query, secrets.token_hex(8), self._driver())
            self._arrived.append(arrival)
            if arrival.driver is None:
                self._send(OpenLink(query, arrival.ticket))


def _outcome(arrival: _Arrival, newest: Callable[[], Snapshot]) -> tuple[str, str, bool]:
    """Title and text of what a person is told of a link, and whether it was started; waits until that is known."""
    if arrival.driver is not None:
        text = f"Visitor {arrival.driver} drives. Take control, then open the link again."
        return "The link was not started", text, False
    for _ in range(_LOOKS):  # counted, for a machine that was asleep meanwhile has not looked
        for outcome in newest().links:
            if outcome.ticket == arrival.ticket:
                if outcome.refused is not None:
                    return "The link could not be used", outcome.refused, False
                return "Started from the link", link_text(read_link(arrival.query)), True
        time.sleep(_LOOK_EVERY_S)
    return "The link was not started", "The simulation did not answer.", False
