"""On the page a controller that fails stops its robot and is named; another one, or a reset, goes on."""

import numpy as np
import pytest

from surefoot.dashboard.engine.coordinator import Coordinator
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.worker import InlineWorker
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.messages.signals import TRACE_COLUMNS
from tests.support.playback import bits, recorded_ticks, texts, ticks
from tests.support.plug_ins import FAILING, FAILS_AT_S, installed, put_failing_controllers
from tests.support.waiting import wait_for

TICKS = round(FAILS_AT_S / 1e-3)


@pytest.fixture(autouse=True)
def site(tmp_path):
    put_failing_controllers(tmp_path)
    with installed(tmp_path):
        yield


def until_it_fails(playback):
    """Tick until it pauses."""
    while playback.playing:
        playback.tick()


@pytest.mark.parametrize("name", ["raises", "givestoofew", "givesnan"])
def test_it_pauses_and_the_log_names_it(name):
    playback = Playback("stand_left", name)
    until_it_fails(playback)
    assert playback.live.simulation.time_s == pytest.approx(FAILS_AT_S)
    (fall,) = texts(playback, EventKind.FALL)
    assert "by controller_error" in fall
    assert f"controller {name}: {FAILING[name]}" in fall
    assert "another controller" in playback.live.log.events[0].text
    balance = playback.snapshot().balance
    assert (balance.fall_cause, balance.fall_text, balance.ended) == ("controller_error", fall, True)
    playback.apply(cmd.Play())
    assert not playback.playing
    assert "another controller" in playback.live.log.events[0].text


def test_another_controller_goes_on_from_there():
    playback = Playback("stand_left", "raises")
    until_it_fails(playback)
    playback.apply(cmd.SetController("two-part"))
    playback.apply(cmd.Play())
    ticks(playback, 100)
    snapshot = playback.snapshot()
    assert (snapshot.playing, snapshot.balance.fall_cause, snapshot.balance.status) == (True, None, "solved")
    assert snapshot.time_s == pytest.approx(FAILS_AT_S + 0.1)
    assert snapshot.timeline.now_s == pytest.approx(snapshot.time_s)


def test_what_followed_comes_again_to_the_bit():
    playback = Playback("stand_left", "raises")
    until_it_fails(playback)
    failed = bits(playback)
    playback.apply(cmd.SetController("two-part"))
    playback.apply(cmd.Play())
    seen = recorded_ticks(playback, 150)
    traces = playback.snapshot().traces
    for _ in range(2):
        playback.apply(cmd.Seek(FAILS_AT_S - 0.010))
        assert playback.live.controller == "raises"
        ticks(playback, 10)
        assert bits(playback) == failed
        assert playback.live.controller == "two-part"
        assert recorded_ticks(playback, 150) == seen
    again = playback.snapshot().traces
    repeats = [i for i, name in enumerate(TRACE_COLUMNS) if name != "tick_us"]
    assert again[: len(traces), repeats].tobytes() == traces[:, repeats].tobytes()


def test_a_reset_starts_again():
    playback = Playback("stand_left", "raises")
    until_it_fails(playback)
    playback.apply(cmd.Reset())
    assert (playback.playing, playback.live.simulation.time_s, playback.live.simulation.error) == (True, 0.0, None)
    until_it_fails(playback)
    assert len(texts(playback, EventKind.FALL)) == 2


@pytest.mark.parametrize(
    ("name", "reason"), [("unready", "cannot be built (KeyError"), ("stubborn", "cannot take over (RuntimeError")]
)
def test_one_that_cannot_take_over_leaves_the_driver_alone(playback, name, reason):
    ticks(playback, 10)
    playback.apply(cmd.SetController(name))
    assert playback.live.log.events[0].kind is EventKind.ERROR
    assert f"controller {name}: {reason}" in playback.live.log.events[0].text
    assert (playback.live.controller, playback.playing) == ("two-part", True)
    assert ticks(playback, 10).fall_cause is None


def test_one_that_fails_on_the_ground_is_told_and_paused_too():
    playback = Playback("stand_left", "raises")
    playback.live.simulation.fallen, playback.live.simulation.fall_time_s = "pelvis_low", 0.0
    until_it_fails(playback)
    assert playback.live.simulation.time_s == pytest.approx(FAILS_AT_S)
    assert any(FAILING["raises"] in text for text in texts(playback, EventKind.ERROR))


def test_of_two_robots_the_other_goes_on():
    coordinator = Coordinator(InlineWorker(Playback("stand_left", "two-part")), InlineWorker)
    coordinator.turn([cmd.StartTwin("raises")], 0, snapshot=True)
    for _ in range(10):
        coordinator.turn((), 16, snapshot=True)
    snapshot = coordinator.snapshot(1, 1.0)
    assert (snapshot.playing, snapshot.balance.fall_cause) == (True, None)
    assert snapshot.time_s == pytest.approx(0.160)
    assert snapshot.twin.other.balance.fall_cause == "controller_error"
    assert snapshot.twin.other.time_s == pytest.approx(FAILS_AT_S)
    assert any(event.text.startswith("twin: FALL") and FAILING["raises"] in event.text for event in snapshot.events)
    coordinator.turn([cmd.SetTwinController("two-part"), cmd.Reset()], 0, snapshot=True)
    for _ in range(5):
        coordinator.turn((), 16, snapshot=True)
    snapshot = coordinator.snapshot(2, 1.0)
    assert snapshot.time_s == snapshot.twin.other.time_s == pytest.approx(0.080)


def test_a_slow_one_slows_the_run_and_the_page_still_obeys():
    session = Session(Playback("stand_left", "slow"))
    session.start()
    try:
        wait_for(lambda: session.snapshot.time_s > 0.0)
        session.send(cmd.SetController("two-part"))
        wait_for(lambda: session.snapshot.controller == "two-part" and session.snapshot.time_s > 0.1)
    finally:
        session.stop()
    assert session.statistics().errors == 0
    assert session.snapshot.balance.fall_cause is None


def test_an_infinity_of_a_controller_is_a_gap_in_the_plots(playback, monkeypatch):
    live = playback.live
    decide = live.simulation.controller.tick

    def tick(*given):
        output = decide(*given)
        output.zmp_commanded_in_world = np.array([np.inf, -np.inf])
        output.delta_commanded = np.full(3, np.inf)
        return output

    monkeypatch.setattr(live.simulation.controller, "tick", tick)
    ticks(playback, 70)
    table = playback.snapshot().traces
    assert not np.isinf(table).any()
    assert np.isnan(table[:, TRACE_COLUMNS.index("zmp_commanded_x_mm")]).all()
    assert np.isfinite(table[:, TRACE_COLUMNS.index("com_x_mm")]).all()
