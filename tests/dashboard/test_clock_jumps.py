"""The clock jumps: a machine that was asleep, a program that was stopped, somebody who sets the wall clock.

The wall clock is read nowhere. The clocks that only go forward may have gone on by an hour.
"""

import re
import time
from concurrent.futures import Future
from types import SimpleNamespace

import pytest

from surefoot.dashboard.access.driver_lock import IDLE_S, ONE, DriverLock
from surefoot.dashboard.access.link_handoff import LinkHandoff
from surefoot.dashboard.engine import frame_clock, session
from surefoot.dashboard.engine.frame_clock import FrameClock
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.messages.commands import ChangeSettings
from surefoot.dashboard.panels.export import export
from surefoot.dashboard.panels.export.export import ExportPanel
from surefoot.dashboard.replay import replay_page
from surefoot.dashboard.replay.replay_page import start_replay
from tests.support.cli import ROOT
from tests.support.waiting import wait_for

HOUR_S = 3600.0
READS_WALL_CLOCK = r"\btime\.time(_ns)?\b|\bdatetime\b|from time import .*\btime\b|Date\.now|new Date"


class Clock:
    """Stands in for the module ``time``."""

    def __init__(self) -> None:
        self.now = 100.0
        self.sleep = time.sleep

    def perf_counter(self) -> float:
        return self.now

    monotonic = perf_counter


@pytest.fixture
def clock(monkeypatch):
    made = Clock()
    for module in (session, frame_clock, replay_page):
        monkeypatch.setattr(module, "time", made)
    return made


def test_nothing_reads_the_wall_clock():
    files = [*ROOT.glob("app/surefoot/**/*.py"), *ROOT.glob("static/page/*.js")]
    assert len(files) > 100
    assert [file for file in files if re.search(READS_WALL_CLOCK, file.read_text())] == []


def test_a_run_goes_on_where_it_was_and_catches_up_a_quarter_of_a_second(clock, playback):
    running = Session(playback)

    def pass_seconds(seconds):
        for _ in range(round(seconds / 0.02)):
            clock.now += 0.02
            running._round()

    pass_seconds(0.3)
    before = running.snapshot
    clock.now += HOUR_S
    pass_seconds(0.5)
    after = running.snapshot
    assert 0.5 < after.time_s - before.time_s <= 0.75 + 1e-9
    pass_seconds(2.1)  # the figure is of the last second
    assert running.snapshot.real_time_factor == pytest.approx(1.0, abs=0.1)
    assert running.statistics().errors == 0


def test_a_change_of_settings_after_it_is_another_one_to_undo(clock, playback):
    running = Session(playback)
    for value in (70.0, 80.0):
        running.send(ChangeSettings({"com_stiffness": value}))
        for _ in range(10):  # a dragged slider's changes are gathered for some milliseconds of the run
            clock.now += 0.02
            running._round()
        clock.now += HOUR_S
    assert running.snapshot.settings.com_stiffness == 80.0
    assert running.snapshot.tuning.undo.values == (("com_stiffness", 70.0, 80.0),)


def test_the_page_draws_its_next_frame_at_once_and_then_as_before(clock):
    frames = FrameClock()
    clock.now += HOUR_S
    assert frames.drawn(clock.now, 0.02) == 0.0
    clock.now += 0.005
    assert frames.drawn(clock.now - 0.005, 0.02) == pytest.approx(0.015)


def test_a_replay_goes_on_where_it_was(clock, playback):
    for _ in range(1000):
        playback.tick()
    _, player, server = start_replay(playback.saved_run(), host="127.0.0.1", port=0, token=None)
    try:
        player.stop()
        player.playing = True
        before = player.time_s
        clock.now += HOUR_S
        player._follow()
        assert (player.playing, player.time_s - before) == (True, pytest.approx(0.5))
    finally:
        server.stop()


def test_who_asks_after_it_gets_control_for_the_driver_was_away():
    clock, sent = Clock(), []
    lock = DriverLock(sent.append, lambda: 1, clock.perf_counter)
    for client in (1, 2):
        lock.enter(client)
    lock.set_mode(1, ONE)
    assert lock.accepts(1) and not lock.request_control(2)
    clock.now += HOUR_S
    assert HOUR_S > IDLE_S and lock.grant_if_idle()
    assert lock.accepts(2) and not lock.accepts(1)


def test_a_link_is_waited_for_by_looking_not_by_the_clock(monkeypatch, playback):
    """The machine slept between a link and its run, which is started all the same."""
    clock, running, handoff, told, looks = Clock(), Session(playback), LinkHandoff(), [], []

    def newest():
        clock.now += HOUR_S
        looks.append(clock.now)
        if len(looks) > 2:
            running._round()
        return running.snapshot

    monkeypatch.setattr("surefoot.dashboard.access.link_handoff.time", clock)
    newcomers = SimpleNamespace(on_client_connect=lambda greet: setattr(newcomers, "let_in", greet))
    handoff.connect(newcomers, running.send, lambda: None, newest)
    handoff.start_from_cookie(handoff.issue_cookie("/?scenario=push_left", "document").partition(";")[0])
    newcomers.let_in(SimpleNamespace(add_notification=lambda title, text, **_: told.append(title)))
    assert told == ["Started from the link"]


def test_a_file_that_was_waited_for_too_long_is_told_in_words(monkeypatch):
    monkeypatch.setattr(export, "_PATIENCE_S", 0.0)
    panel, told = ExportPanel.__new__(ExportPanel), []
    panel._ask = Future
    client = SimpleNamespace(add_notification=lambda title, text, **_: told.append((title, text)))
    panel._give(SimpleNamespace(client=client), "npz")
    assert told == [("Nothing was saved", "The simulation did not answer: try again.")]


def test_a_wall_clock_that_jumps_back_and_forth_stops_nothing(dashboard, monkeypatch):
    """Viser and the websockets' library have it in their hands."""
    real, jumps = time.time, iter(range(10**9))
    monkeypatch.setattr(time, "time", lambda: real() + (HOUR_S if next(jumps) % 2 else -HOUR_S))
    before = dashboard.session.snapshot.time_s
    dashboard.session.send(ChangeSettings({"com_stiffness": 61.0}))
    wait_for(lambda: dashboard.session.snapshot.settings.com_stiffness == 61.0)
    wait_for(lambda: dashboard.page.shown.time_s > before + 0.2)
    assert dashboard.session.statistics().errors == 0
