"""Sends each page no more than its pace: viser shares one stream of messages between all of them.

Viser keeps only the newest message of each kind for each thing, so a page that is sent nothing for a while misses only
what has been replaced. So here a slow page's share of the stream rests; of plots the newest data are kept back until
they are due, and seen.
"""

import asyncio
import contextlib
import secrets
import time
from collections.abc import AsyncGenerator, Iterable, Iterator, Sequence
from typing import Any

import viser
from viser import _messages
from viser._gui_handles import GuiUplotHandle

from surefoot.dashboard.access.client_pace import ClientPace
from surefoot.dashboard.access.frame_report import FrameReport

_LOOK_AGAIN_S = 0.1  # after plots were kept back, when nothing else is sent


class HeldPlots:
    """Newest data of plots that one page has not been sent yet.

    Args:
        pace: of the page.
        tabs: a plot's uuid -> label of the tab in which it stands.
    """

    def __init__(self, pace: ClientPace, tabs: dict[str, str]) -> None:
        self._pace, self._tabs = pace, tabs
        self._held: dict[str, Any] = {}
        self._sent_s: dict[str, float] = {}

    def __bool__(self) -> bool:
        """Whether any are held."""
        return bool(self._held)

    def keep(self, messages: Iterable[Any]) -> list[Any]:
        """Keep data of plots; returns all other messages."""
        others = []
        for message in messages:
            if isinstance(message, _messages.GuiUpdateMessage) and message.uuid in self._tabs and _is_data(message):
                self._held[message.uuid] = message
            else:
                others.append(message)
        return others

    def due(self, now_s: float) -> list[Any]:
        """Those that are seen and due now [s]; they are held no longer."""
        ready = [
            uuid
            for uuid in self._held
            if self._pace.sees(self._tabs[uuid]) and now_s - self._sent_s.get(uuid, -1e9) >= self._pace.plots_s
        ]
        self._sent_s |= dict.fromkeys(ready, now_s)
        return [self._held.pop(uuid) for uuid in ready]


class PacedMessages:
    """The paces of all pages of a server.

    Attributes:
        paces: number of the client -> how much its page is sent.
    """

    def __init__(self) -> None:
        self.paces: dict[int, ClientPace] = {}
        self._client_from_key: dict[str, int] = {}
        self._tabs: dict[str, str] = {}

    def connect(self, server: viser.ViserServer) -> None:
        """Pace what a server sends, before any page has come."""
        server.on_client_connect(self._give_key)
        server.on_client_disconnect(self._forget)
        buffer = server._websock_server._broadcast_buffer
        self._windows = buffer.window_generator
        buffer.window_generator = self._paced_windows  # type: ignore[method-assign]

    def watch(self, label: str, tab: Any) -> None:
        """Pace the plots that stand in a tab with this label."""
        self._tabs |= {chart: label for chart in _charts(tab)}

    def report(self, report: FrameReport) -> bool:
        """Take a page's report; False when no page has its key."""
        client_id = self._client_from_key.get(report.key)
        pace = None if client_id is None else self.paces.get(client_id)
        if pace is not None:
            pace.take(report, time.monotonic())
        return pace is not None

    def rest_s(self, client_id: int) -> float:
        """Pause that a page needs after each thing sent [s]."""
        pace = self.paces.get(client_id)
        return 0.0 if pace is None else pace.rest_s

    async def _give_key(self, client: viser.ClientHandle) -> None:  # async: coming and leaving stay in order
        key = secrets.token_urlsafe(12)
        self._client_from_key[key] = client.client_id
        client.gui.add_html(f'<i hidden data-surefoot-client="{key}"></i>')

    async def _forget(self, client: viser.ClientHandle) -> None:
        for key in [key for key, client_id in self._client_from_key.items() if client_id == client.client_id]:
            del self._client_from_key[key]

    def _paced_windows(self, client_id: int, backlog_done_message: Any = None) -> AsyncGenerator[Sequence[Any], None]:
        windows = self._windows(client_id, backlog_done_message)  # at once: it notes what is there already
        return self._until_it_goes(client_id, windows)

    async def _until_it_goes(
        self, client_id: int, windows: AsyncGenerator[Sequence[Any], None]
    ) -> AsyncGenerator[Sequence[Any], None]:
        """Paced windows; the pace is kept as long as they are asked for.

        Viser tells of no leaving before a page has said how its camera stands.
        """
        pace = self.paces[client_id] = ClientPace()
        try:
            async with contextlib.aclosing(paced(windows, pace, HeldPlots(pace, self._tabs))) as sent:
                async for window in sent:
                    yield window
        finally:
            self.paces.pop(client_id, None)


async def paced(
    windows: AsyncGenerator[Sequence[Any], None], pace: ClientPace, plots: HeldPlots
) -> AsyncGenerator[Sequence[Any], None]:
    """Windows of messages, as one page is to be sent them."""
    coming: asyncio.Future[Sequence[Any]] | None = None
    try:
        while True:
            coming = coming or asyncio.ensure_future(anext(windows))
            await asyncio.wait({coming}, timeout=_LOOK_AGAIN_S if plots else None)
            others: list[Any] = []
            if coming.done():
                try:
                    others = plots.keep(coming.result())
                except StopAsyncIteration:
                    return
                coming = None
            if window := others + plots.due(time.monotonic()):
                yield window
                if pace.rest_s:
                    await asyncio.sleep(pace.rest_s)
    finally:
        if coming is not None:
            coming.cancel()
            await asyncio.gather(coming, return_exceptions=True)
        await windows.aclose()


def _is_data(message: Any) -> bool:
    return set(message.updates) == {"data"}


def _charts(container: Any) -> Iterator[str]:
    for uuid, child in container._children.items():
        if isinstance(child, GuiUplotHandle):
            yield uuid
        elif hasattr(child, "_children"):
            yield from _charts(child)
