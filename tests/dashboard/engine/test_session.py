"""The thread: it obeys, publishes and survives."""

import pytest

from surefoot.dashboard.engine.pacing import Pacer
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from tests.support.waiting import wait_for


@pytest.fixture
def playback():
    return Playback("stand_left", "two-part")


@pytest.fixture
def session(playback):
    running = Session(playback, paced=False)
    running.start()
    yield running
    running.stop()


def test_it_ticks_and_publishes(session):
    wait_for(lambda: session.snapshot.time_s > 0.05)
    snapshot = session.snapshot
    assert snapshot.balance.status == "solved"
    assert snapshot.geometry.support_polygon.shape == (4, 3)
    assert snapshot.geometry.contacts[:, 5].sum() == pytest.approx(105 * 9.81, rel=0.05)
    assert session.statistics().ticks > 0


def test_it_obeys_in_order(session):
    session.send(cmd.Pause())
    wait_for(lambda: not session.snapshot.playing)
    session.send(cmd.SetController("optimization"))
    session.send(cmd.ChangeSettings({"com_stiffness": 70.0}))
    session.send(cmd.ChangeSettings({"com_stiffness": 80.0, "com_damping": 15.0}))
    session.send(cmd.Reset(play=False))
    wait_for(lambda: session.snapshot.run == 2)
    snapshot = session.snapshot
    assert (snapshot.controller, snapshot.time_s, snapshot.playing) == ("optimization", 0.0, False)
    assert (snapshot.settings.com_stiffness, snapshot.settings.com_damping) == (80.0, 15.0)


def test_an_internal_error_pauses_and_a_reset_goes_on(session, playback, monkeypatch, capsys):
    wait_for(lambda: session.snapshot.time_s > 0.0)

    def explode():
        raise RuntimeError("a bug")

    monkeypatch.setattr(playback.live.simulation, "tick", explode)
    wait_for(lambda: not session.snapshot.playing)
    assert session.statistics().errors == 1
    assert "internal error" in session.snapshot.events[0].text
    assert "a bug" in capsys.readouterr().err
    session.send(cmd.Reset())
    wait_for(lambda: session.snapshot.run == 2 and session.snapshot.time_s > 0.0)


def test_pacing_gives_up_what_it_cannot_catch_up():
    pacer = Pacer(0.0)
    assert pacer.due(0.010, 1.0, playing=True) == 10
    pacer.advanced(4, 0.010)
    assert pacer.due(0.010, 1.0, playing=True) == 6
    assert pacer.due(100.0, 1.0, playing=True) == 250
    pacer.advanced(250, 100.0)
    assert pacer.due(100.010, 0.5, playing=True) == 5
    assert pacer.due(100.020, 1.0, playing=False) == 0


def test_pacing_measures_the_real_time_factor():
    pacer = Pacer(0.0)
    pacer.advanced(500, 0.5)
    pacer.advanced(400, 1.0)
    assert pacer.real_time_factor == pytest.approx(0.9)


def test_what_makes_no_sense_is_told_and_the_run_goes_on(session):
    """Settings are gathered before anybody obeys them: what is no table must not get so far."""
    session.send(cmd.ChangeSettings([1]))
    session.send(cmd.Seek("yesterday"))
    session.send(cmd.StartTwin("optimization", changes=[1]))
    wait_for(lambda: sum("must be" in event.text for event in session.snapshot.events) == 3)
    seen = session.snapshot.time_s
    wait_for(lambda: session.snapshot.time_s > seen + 0.05)
    assert session.statistics().errors == 0
