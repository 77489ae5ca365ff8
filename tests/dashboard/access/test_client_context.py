"""Whose callback runs is known, and who does not drive moves no widget that belongs to driving."""

import asyncio
from types import SimpleNamespace

import pytest
from viser import _messages

from surefoot.dashboard.access.client_context import as_client, current_client
from surefoot.dashboard.access.driver_lock import EVERYBODY, ONE
from surefoot.dashboard.messages.commands import MoveStone

DRIVER, OTHER = 1001, 1002


@pytest.fixture
def driver_lock(dashboard):
    """Control of a dashboard, held by one of two."""
    driver_lock = dashboard.page.driver_lock
    for who in (DRIVER, OTHER):
        driver_lock.enter(who)
    driver_lock.set_mode(DRIVER, ONE)
    yield driver_lock
    driver_lock.set_mode(DRIVER, EVERYBODY)
    for who in (DRIVER, OTHER):
        driver_lock.leave(who)


def come_in(dashboard, who, message):
    """Let a message in as if that client had sent it."""
    server = dashboard.server
    arrived = server._websock_server._handle_incoming_message(who, message)
    asyncio.run_coroutine_threadsafe(arrived, server._event_loop).result(timeout=60)


def widget(dashboard, label):
    handles = dashboard.server.gui._gui_input_handle_from_uuid.values()
    return next(handle for handle in handles if getattr(handle, "label", None) == label)


def test_a_callback_in_a_thread_knows_its_client(dashboard):
    pool = dashboard.server._thread_executor
    assert pool.submit(lambda event: current_client(), SimpleNamespace(client_id=5)).result() == 5
    assert pool.submit(current_client).result() is None
    with as_client(7):
        assert current_client() == 7
    assert current_client() is None


def test_a_handler_in_the_event_loop_knows_its_client(dashboard):
    heard = []

    async def hear(who, message):
        heard.append((who, current_client()))

    doors, kind = dashboard.server._websock_server, _messages.ShareUrlDisconnect
    before = doors._incoming_handlers.pop(kind)
    doors.register_handler(kind, hear)
    come_in(dashboard, 11, kind())
    doors._incoming_handlers[kind] = before
    assert heard == [(11, 11)]


@pytest.mark.parametrize("label", ["Stone height [mm]", "Speed [×]", "Twin's controller", "CoM K_P [1/s²]"])
def test_only_the_driver_moves_what_belongs_to_driving(dashboard, driver_lock, label):
    handle = widget(dashboard, label)
    before = handle.value
    wanted = before + 1 if not isinstance(before, str) else "soft-qp"
    update = _messages.GuiUpdateMessage(handle._impl.uuid, {"value": wanted})
    come_in(dashboard, OTHER, update)
    assert handle.value == before
    come_in(dashboard, DRIVER, update)
    assert handle.value == wanted
    handle.value = before


@pytest.mark.parametrize("label", ["Hold the plots", "Dark page", "Window [s]"])
def test_everybody_moves_what_only_changes_the_view(dashboard, driver_lock, label):
    handle = widget(dashboard, label)
    before = handle.value
    wanted = 5.0 if isinstance(before, float) else not before
    come_in(dashboard, OTHER, _messages.GuiUpdateMessage(handle._impl.uuid, {"value": wanted}))
    assert handle.value == wanted
    handle.value = before


def test_a_stone_that_another_drags_stays_where_it_is(dashboard, driver_lock):
    refused = []
    on_refusal, driver_lock.on_refusal = driver_lock.on_refusal, refused.append
    with as_client(OTHER):
        driver_lock.send(MoveStone(number=0, x_m=0.0, y_m=0.0))
    driver_lock.on_refusal = on_refusal
    assert refused == [OTHER]
