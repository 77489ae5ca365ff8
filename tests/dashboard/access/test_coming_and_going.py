"""A page that is opened and closed a hundred times leaves nothing behind: no thread, no state, no object."""

import gc
import threading
from collections import Counter

from surefoot.dashboard.messages.commands import Pause
from surefoot.dashboard.panels.header.visitors import VisitorsPanel
from tests.support.visitor import Visitor
from tests.support.waiting import wait_for

VISITS, AT_FIRST = 100, 10  # by then everything has been made once


def visit(running, number):
    """Come, or only look in at the door, listen or not, and leave in order or without a word."""
    visitor = Visitor(running, greets=number % 5 > 0)
    if number % 2:
        visitor.hear()
    (visitor.leave if number % 3 else visitor.break_off)()
    wait_for(lambda: visitor.client_id not in running.server._websock_server._live_connections, every_s=0.002)


def objects():
    """How many objects there are, by type."""
    gc.collect()
    return Counter(f"{type(thing).__module__}.{type(thing).__qualname__}" for thing in gc.get_objects())


def threads():
    """How many threads live, without those of viser's pool, which grows to its size and stays."""
    return sum(not thread.name.startswith("ThreadPoolExecutor") for thread in threading.enumerate())


def states(running):
    """How many visitors are remembered, by everybody who remembers any."""
    doors, page = running.server._websock_server, running.page
    (seats,) = (panel._seats for panel in page._panels if isinstance(panel, VisitorsPanel))
    return [
        len(running.server._connected_clients),
        len(doors._client_state_from_id),
        len(doors._live_connections),
        len(doors._broadcast_buffer.generator_cursors),
        len(page.driver_lock.view().visitors),
        len(seats),
        len(page._cameras._cameras),
        len(page._cameras._sent_s),
        len(page.paces.paces),
        len(page.paces._client_from_key),
        len(running.server.gui._current_file_upload_states),
    ]


def test_a_hundred_visits_leave_nothing_behind(dashboard):
    dashboard.session.send(Pause())  # a run that goes on makes objects of its own
    wait_for(lambda: not dashboard.page.shown.playing)
    for number in range(AT_FIRST):
        visit(dashboard, number)
    wait_for(lambda: not any(states(dashboard)))
    before, lived, sent = objects(), threads(), len(dashboard.server._websock_server._broadcast_buffer.message_from_id)
    for number in range(VISITS):
        visit(dashboard, number)
    wait_for(lambda: not any(states(dashboard)))

    def grown():
        return {kind: more for kind, more in (objects() - before).items() if more >= VISITS // 2}

    wait_for(lambda: not grown())  # what a thread or task still holds is gone soon
    assert threads() <= lived
    assert len(dashboard.server._websock_server._broadcast_buffer.message_from_id) <= sent + VISITS // 10
