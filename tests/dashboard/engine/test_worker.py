"""A worker in a process of its own plays what one in this process plays, and its end is told."""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from surefoot.dashboard.engine.process_worker import ProcessWorker
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.engine.wire_format import TableDelta, table_delta
from surefoot.dashboard.engine.worker import InlineWorker, Request, RunSpec, WorkerLostError
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.signals import TRACE_COLUMNS
from surefoot.errors import SurefootError
from surefoot.experiments.scenario.scenario import load_scenario
from tests.support.waiting import PATIENCE_S, wait_for

SPEC = RunSpec(load_scenario("stand_left"), "two-part", {"com_stiffness": 65.0}, 0.8)


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def play(worker, request):
    worker.begin(request)
    return worker.finish()


@pytest.fixture
def worker():
    running = ProcessWorker()
    yield running
    running.close()


@pytest.fixture
def spawned():
    """The workers that the session has started itself."""
    return []


@pytest.fixture
def session(worker, spawned):
    def spawn():
        spawned.append(ProcessWorker())
        return spawned[-1]

    play(worker, Request(start=SPEC))
    running = Session(worker, spawn=spawn, paced=False)
    running.start()
    yield running
    running.stop()


def test_the_same_bits_here_and_in_another_process(worker):
    local = InlineWorker()
    repeats = [i for i, name in enumerate(TRACE_COLUMNS) if name != "tick_us"]  # what is not measured by a clock
    requests = [
        Request(start=SPEC, ticks=40, snapshot=True),
        Request(commands=(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.01, size_m=0.06),), ticks=150, rows=True),
        Request(commands=(cmd.SetController("soft-qp"), cmd.Step(7)), snapshot=True, rows=True),
        Request(
            commands=(cmd.Play(), cmd.PushNow(direction_deg=0.0, impulse_ns=5.0)), ticks=60, snapshot=True, rows=True
        ),
    ]
    for request in requests:
        here, there = play(local, request), play(worker, request)
        for name in ("ticks_done", "time_s", "run", "playing", "speed", "ended", "errors", "new_events", "spec"):
            assert getattr(there, name) == getattr(here, name), name
        if request.rows:
            assert here.rows.tobytes() == there.rows.tobytes()
        if request.snapshot:
            one, two = here.snapshot, there.snapshot
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
    packed = table_delta(before, now)
    assert isinstance(packed, TableDelta) == grown
    if grown:
        assert len(packed.added) == max(last - 5, 0)
        assert packed.applied(before).tobytes() == now.tobytes()
    changed = now + (0.0, 1.0)
    assert table_delta(before, changed) is changed


def test_what_cannot_be_adopted_is_said_in_one_line_and_the_process_stays(worker):
    with pytest.raises(SurefootError, match="no such controller"):
        play(worker, Request(start=RunSpec(SPEC.scenario, "no-such-controller")))
    assert play(worker, Request(start=SPEC, ticks=3)).ticks_done == 3


def test_closing_ends_the_process_and_it_cannot_be_asked_again(worker):
    wait_for(worker.ready)
    assert alive(worker.pid)
    worker.close()
    assert not alive(worker.pid)
    with pytest.raises(WorkerLostError):
        play(worker, Request())


def test_it_does_not_outlive_whoever_started_it():
    begin = "import os; from surefoot.dashboard.engine.process_worker import ProcessWorker; p = ProcessWorker()"
    script = f"{begin}; print(p.pid, flush=True); os._exit(1)"
    said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=PATIENCE_S)
    wait_for(lambda: not alive(int(said.stdout)))


def test_a_killed_performer_is_told_and_restarted(session, worker):
    session.send(cmd.SetController("soft-qp"))
    wait_for(lambda: session.snapshot.time_s > 0.05 and session.snapshot.controller == "soft-qp")
    run = session.snapshot.run
    os.kill(worker.pid, signal.SIGKILL)
    wait_for(lambda: session.snapshot.run > run)
    snapshot = session.snapshot
    assert "signal 9" in snapshot.events[0].text
    assert snapshot.events[0].kind == "error"
    assert (snapshot.controller, snapshot.settings.com_stiffness, snapshot.friction) == ("soft-qp", 65.0, 0.8)
    assert (snapshot.playing, snapshot.time_s, session.statistics().errors) == (False, 0.0, 1)
    session.send(cmd.Play())
    wait_for(lambda: session.snapshot.time_s > 0.05)


def test_a_killed_twin_is_told_and_both_begin_anew(session, worker, spawned):
    session.send(cmd.StartTwin("soft-qp"))
    wait_for(lambda: session.snapshot.twin is not None and session.snapshot.twin.other is not None)
    wait_for(lambda: session.snapshot.time_s > 0.05)
    os.kill(spawned[0].pid, signal.SIGKILL)
    wait_for(lambda: any("signal 9" in event.text for event in session.snapshot.events))
    wait_for(lambda: session.snapshot.twin.other is not None and session.snapshot.time_s > 0.05)
    snapshot = session.snapshot
    assert (snapshot.controller, snapshot.twin.other.controller) == ("two-part", "soft-qp")
    assert snapshot.twin.other.settings.com_stiffness == 65.0
    pids = [worker.pid, spawned[-1].pid]
    assert all(alive(pid) for pid in pids)
    session.stop()
    assert not any(alive(pid) for pid in pids)
    assert np.isfinite(snapshot.geometry.qpos).all()
