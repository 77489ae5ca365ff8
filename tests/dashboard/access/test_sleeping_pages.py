"""A page that is asleep, and one whose connection died without a word: neither costs the others anything."""

import asyncio
import re
import socket
from collections import deque
from types import SimpleNamespace

import pytest

from surefoot.dashboard.access.driver_lock import EVERYBODY, ONE
from surefoot.dashboard.access.watched_connection import WatchedConnection
from surefoot.dashboard.messages.commands import Pause, Play
from tests.support.visitor import Visitor
from tests.support.waiting import wait_for

MORE = 20  # things that may have come to be shown meanwhile


@pytest.fixture
def awake(dashboard):
    visitor = Visitor(dashboard)
    connection(dashboard, visitor).patience_s = 300.0
    yield visitor
    visitor.leave()


@pytest.fixture
def asleep(dashboard, awake, monkeypatch):
    """A visitor who does not read, and whose line holds little."""
    monkeypatch.setattr(WatchedConnection, "patience_s", 2.0)
    visitor = Visitor(dashboard, room=4096)
    line = connection(dashboard, visitor).transport.get_extra_info("socket")
    line.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
    yield visitor
    visitor.break_off()


def connection(running, visitor):
    return running.server._websock_server._live_connections[visitor.client_id]


def kept(running):
    """How many messages are kept, for all and for each."""
    server = running.server._websock_server
    own = [state.message_buffer for state in tuple(server._client_state_from_id.values())]
    return sum(len(buffer.message_from_id) for buffer in (server._broadcast_buffer, *own))


def hear_of(visitor, text):
    """Listen until a text is among what is said."""
    wait_for(lambda: text in str(visitor.hear()))


def times_shown(visitor):
    """Listen; the times of the run that are shown [s]."""
    return [float(found) for found in re.findall(r"(\d+\.\d) s</span>", str(visitor.hear()))]


def test_a_page_that_does_not_read_is_let_go_and_the_others_go_on(dashboard, asleep, awake):
    lock = dashboard.page.driver_lock
    lock.set_mode(asleep.client_id, ONE)
    assert lock.accepts(asleep.client_id) and not lock.accepts(awake.client_id)
    before, sizes, note = kept(dashboard), [], dashboard.server.gui.add_html("")

    def let_go():
        note.content = f"{len(sizes)} {'x' * 100_000}"
        hear_of(awake, f"{len(sizes)} x")
        sizes.append(kept(dashboard))
        return asleep.client_id not in dashboard.server.get_clients()

    wait_for(let_go)
    note.remove()
    assert len(sizes) > 3 and max(sizes) < before + MORE
    assert lock.holder() is None and lock.accepts(awake.client_id)
    lock.set_mode(awake.client_id, EVERYBODY)
    now = dashboard.page.shown.time_s
    wait_for(lambda: max(times_shown(awake), default=0.0) > now + 0.2)


def test_a_page_that_wakes_up_sees_the_present(dashboard):
    dashboard.session.send(Pause())
    wait_for(lambda: not dashboard.page.shown.playing)
    again = Visitor(dashboard)
    hear_of(again, f"paused · {dashboard.page.shown.time_s:.1f} s</span>")
    again.leave()
    dashboard.session.send(Play())


def test_a_slow_line_is_not_a_dead_one(monkeypatch):
    """As long as something leaves, the page stays."""
    monkeypatch.setattr(WatchedConnection, "patience_s", 0.01)
    waiting = [90, 60, 60, 20, 20, 20]  # bytes before and after a while, three times

    async def wait():
        line = WatchedConnection.__new__(WatchedConnection)
        line.loop, line.paused, line.drain_waiters = asyncio.get_running_loop(), True, deque()
        line.transport = SimpleNamespace(is_closing=lambda: False, get_write_buffer_size=lambda: waiting.pop(0))
        await line.drain()

    with pytest.raises(TimeoutError):
        asyncio.run(wait())
    assert waiting == []
