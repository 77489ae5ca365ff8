"""A loop goes on after an error, waits as long as its step says, and ends when it is told to."""

import threading

from surefoot.dashboard.engine.threads import LoopThread

PATIENCE_S = 20.0


def test_it_repeats_its_step_until_it_is_stopped():
    often, rounds = threading.Event(), []

    def step():
        rounds.append(threading.current_thread().name)
        if len(rounds) == 5:
            often.set()
        return 0.001

    loop = LoopThread("steps", step)
    loop.start()
    assert often.wait(PATIENCE_S)
    loop.stop()
    assert set(rounds) == {"steps"}
    assert not [thread for thread in threading.enumerate() if thread.name == "steps"]


def test_an_error_is_told_and_does_not_end_it(capsys, monkeypatch):
    monkeypatch.setattr("surefoot.dashboard.engine.threads._AFTER_ERROR_S", 0.001)
    again, rounds = threading.Event(), []

    def step():
        rounds.append(None)
        if len(rounds) == 1:
            raise ValueError("a bug")
        again.set()
        return 1.0

    loop = LoopThread("fails once", step)
    loop.start()
    assert again.wait(PATIENCE_S)
    loop.stop()
    assert "a bug" in capsys.readouterr().err


def test_a_long_wait_does_not_delay_its_end_and_one_never_started_can_be_stopped():
    waits = threading.Event()
    loop = LoopThread("waits", lambda: waits.set() or 3600.0)
    loop.start()
    assert waits.wait(PATIENCE_S)
    loop.stop()
    assert not [thread for thread in threading.enumerate() if thread.name == "waits"]
    LoopThread("never", lambda: 0.0).stop()
