"""A performer in a process of its own plays what one in this process plays, and its end is told."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from surefoot.dashboard.engine.process_worker import ProcessPerformer
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.wire_format import Growth, growth
from surefoot.dashboard.engine.worker import Batch, LocalPerformer, LostPerformerError, Recipe
from surefoot.dashboard.messages import commands as ask
from surefoot.dashboard.messages.snapshot import TRACE_COLUMNS
from surefoot.errors import SurefootError
from surefoot.experiments.scenario.scenario import load_scenario

PATIENCE_S = 60.0
RECIPE = Recipe(load_scenario("stand_left"), "two-part", {"com_stiffness": 65.0}, 0.8)


def wait_for(condition):
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.01)


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def play(performer, batch):
    performer.begin(batch)
    return performer.finish()


@pytest.fixture
def performer():
    running = ProcessPerformer()
    yield running
    running.close()


@pytest.fixture
def session(performer):
    play(performer, Batch(adopt=RECIPE))
    running = Session(performer, hire=ProcessPerformer, paced=False)
    running.start()
    yield running
    running.stop()


def test_the_same_bits_here_and_in_another_process(performer):
    local = LocalPerformer()
    repeats = [i for i, name in enumerate(TRACE_COLUMNS) if name != "tick_us"]  # what is not measured by a clock
    batches = [
        Batch(adopt=RECIPE, ticks=40, picture=True),
        Batch(commands=(ask.PlaceStoneAtSole(place="outer edge", height_m=0.01, size_m=0.06),), ticks=150, rows=True),
        Batch(commands=(ask.SetController("soft-qp"), ask.Step(7)), picture=True, rows=True),
        Batch(commands=(ask.Play(), ask.PushNow(direction_deg=0.0, impulse_ns=5.0)), ticks=60, picture=True, rows=True),
    ]
    for batch in batches:
        here, there = play(local, batch), play(performer, batch)
        for name in ("made", "time_s", "run", "playing", "speed", "ended", "errors", "news", "recipe"):
            assert getattr(there, name) == getattr(here, name), name
        if batch.rows:
            assert here.rows.tobytes() == there.rows.tobytes()
        if batch.picture:
            one, two = here.picture, there.picture
            assert one.geometry.qpos.tobytes() == two.geometry.qpos.tobytes()
            assert one.traces[:, repeats].tobytes() == two.traces[:, repeats].tobytes()
            assert (one.settings, one.events, one.controller) == (two.settings, two.events, two.controller)
    assert len(here.rows) == 60


@pytest.mark.parametrize(
    ("first", "last", "grown"), [(0, 5, True), (3, 9, True), (0, 8, True), (5, 9, False), (0, 4, False)]
)
def test_of_a_table_that_grew_only_the_new_rows_travel(first, last, grown):
    rows = np.column_stack((np.arange(9.0), np.where(np.arange(9) == 4, np.nan, 7.0)))
    before, now = rows[:5], rows[first:last]
    packed = growth(before, now)
    assert isinstance(packed, Growth) == grown
    if grown:
        assert len(packed.added) == max(last - 5, 0)
        assert packed.applied(before).tobytes() == now.tobytes()
    changed = now + (0.0, 1.0)
    assert growth(before, changed) is changed


def test_what_cannot_be_adopted_is_said_in_one_line_and_the_process_stays(performer):
    with pytest.raises(SurefootError, match="no such controller"):
        play(performer, Batch(adopt=Recipe(RECIPE.scenario, "no-such-controller")))
    assert play(performer, Batch(adopt=RECIPE, ticks=3)).made == 3


def test_closing_ends_the_process_and_it_cannot_be_asked_again(performer):
    wait_for(performer.ready)
    assert alive(performer.pid)
    performer.close()
    assert not alive(performer.pid)
    with pytest.raises(LostPerformerError):
        play(performer, Batch())


def test_it_does_not_outlive_whoever_started_it():
    begin = "import os; from surefoot.dashboard.engine.process_worker import ProcessPerformer; p = ProcessPerformer()"
    script = f"{begin}; print(p.pid, flush=True); os._exit(1)"
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=PATIENCE_S)
    wait_for(lambda: not alive(int(said.stdout)))


def test_a_killed_performer_is_told_and_restarted(session, performer):
    session.send(ask.SetController("soft-qp"))
    wait_for(lambda: session.snapshot.time_s > 0.05 and session.snapshot.controller == "soft-qp")
    run = session.snapshot.run
    os.kill(performer.pid, signal.SIGKILL)
    wait_for(lambda: session.snapshot.run > run)
    snapshot = session.snapshot
    assert "signal 9" in snapshot.events[0].text
    assert snapshot.events[0].kind == "error"
    assert (snapshot.controller, snapshot.settings.com_stiffness, snapshot.friction) == ("soft-qp", 65.0, 0.8)
    assert (snapshot.playing, snapshot.time_s, session.statistics().errors) == (False, 0.0, 1)
    session.send(ask.Play())
    wait_for(lambda: session.snapshot.time_s > 0.05)


def test_a_killed_twin_is_told_and_both_begin_anew(session):
    session.send(ask.StartTwin("soft-qp"))
    wait_for(lambda: session.snapshot.twin is not None and session.snapshot.twin.other is not None)
    twin = session._conductor._ensemble._twin
    wait_for(lambda: session.snapshot.time_s > 0.05)
    os.kill(twin.pid, signal.SIGKILL)
    wait_for(lambda: any("signal 9" in event.text for event in session.snapshot.events))
    wait_for(lambda: session.snapshot.twin.other is not None and session.snapshot.time_s > 0.05)
    snapshot = session.snapshot
    assert (snapshot.controller, snapshot.twin.other.controller) == ("two-part", "soft-qp")
    assert snapshot.twin.other.settings.com_stiffness == 65.0
    pids = [session._conductor._ensemble._first.pid, session._conductor._ensemble._twin.pid]
    assert all(alive(pid) for pid in pids)
    session.stop()
    assert not any(alive(pid) for pid in pids)
    assert np.isfinite(snapshot.geometry.qpos).all()
