"""Random actions in a real browser leave no exception, no NaN, no thread and no memory behind.

An hour of them: ``SUREFOOT_SOAK_MINUTES=60 ./scripts/test -m slow tests/browser/test_monkey.py``.
"""

import gc
import os
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from surefoot.dashboard.live.rewind.history import HISTORY_TICKS
from surefoot.dashboard.messages.commands import OpenLink, Play, SetSpeed, StopTwin
from tests.browser.monkey import Monkey

pytestmark = pytest.mark.browser

GROWTH_MB = 50.0
FAST = 2.0  # times real time
FULL_PAST_S = 1.1e-3 * HISTORY_TICKS  # by then the past is as long as it ever gets
WARM_UP = 250  # actions: by then every panel, view and past has been made once
SOAK_MINUTES = float(os.environ.get("SUREFOOT_SOAK_MINUTES", "0"))


def megabytes() -> float:
    """Resident memory of this process and of those that simulate for it."""
    gc.collect()
    found = 0.0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = dict(line.split(":\t", 1) for line in (folder / "status").read_text().splitlines() if ":\t" in line)
            simulates = b"surefoot.dashboard.engine.process_worker" in (folder / "cmdline").read_bytes()
        except OSError:
            continue
        if folder.name == str(os.getpid()) or (simulates and words["PPid"] == str(os.getpid())):
            found += float(words["VmRSS"].split()[0]) / 1024.0
    return found


def settle(screen, until_s: float, acted: list[str]) -> None:
    """Stand alone with the settings of a first visit, and run until then.

    It is asked for again as long as it is not so: an action may still be under way, and come after it.
    """
    session = screen.dashboard.session

    def stands() -> bool:
        now = session.snapshot
        wanted = now.scenario, now.controller, now.settings, now.speed, now.playing, now.twin
        if wanted == ("stand_left", "two-part", now.tuning.defaults, FAST, True, None) and not now.geometry.stones:
            return True
        for command in (StopTwin(), OpenLink("scenario=stand_left&controller=two-part"), SetSpeed(FAST), Play()):
            session.send(command)
        screen.page.wait_for_timeout(500)  # before it is asked for once more
        return False

    def progress() -> str:
        now = session.snapshot
        events = [event.text for event in now.events[:6]]
        return f"{now.time_s} s of {now.scenario}, playing {now.playing}: {events} after {acted[-12:]}"

    session.send(OpenLink("scenario=stand_left&controller=two-part"))
    screen.wait_for(lambda: stands() and session.snapshot.time_s > until_s, progress)


def finite(snapshot) -> bool:
    """Whether what is drawn and what is set are numbers."""
    settings = [getattr(snapshot.settings, name) for name in type(snapshot.settings).__dataclass_fields__]
    numbers = [value for value in settings if isinstance(value, float)]
    return bool(np.isfinite([*snapshot.geometry.qpos, *numbers, snapshot.time_s, snapshot.speed]).all())


def threads() -> set[str]:
    """Names of threads that live, without those of viser's pool, which grows to its size and stays."""
    return {thread.name for thread in threading.enumerate() if not thread.name.startswith("ThreadPoolExecutor")}


def complaints(said: str) -> list[str]:
    """What was printed about an exception, each with the lines that follow."""
    lines = said.splitlines()
    return ["\n".join(lines[i : i + 40]) for i, line in enumerate(lines) if "Traceback" in line or "Error" in line]


def let_loose(screen, seed: int, goes_on, capfd) -> None:
    """Act as long as ``goes_on(actions done)``, and look at what is left behind."""
    session, mishaps, monkey = screen.dashboard.session, [], Monkey(screen, seed)
    screen.page.on("pageerror", lambda error: mishaps.append(str(error)))
    before, memory = threads(), None
    while goes_on(len(monkey.done)):
        monkey.act()
        assert finite(session.snapshot), monkey.done[-3:]
        assert session.statistics().errors == 0, monkey.done[-3:]
        if len(monkey.done) == WARM_UP:
            settle(screen, FULL_PAST_S, monkey.done)
            memory = megabytes()
    settle(screen, 0.2 if memory is None else FULL_PAST_S, monkey.done)
    grown = megabytes() - memory if memory is not None else 0.0
    mishaps.extend(complaints("".join(capfd.readouterr())))
    print(f"{len(monkey.done)} actions: {grown:+.1f} MB; {len(threads())} threads of {len(before)} at first; {mishaps}")
    assert mishaps == []
    assert threads() <= before
    assert grown < GROWTH_MB


@pytest.mark.parametrize(("actions", "seed"), [
    pytest.param(40, 1, id="some"), pytest.param(1000, 2, id="thousand", marks=pytest.mark.slow),
])  # fmt: skip
def test_random_actions_leave_nothing_behind(screen, actions, seed, capfd):
    let_loose(screen, seed, lambda done: done < actions, capfd)


@pytest.mark.slow
@pytest.mark.skipif(SOAK_MINUTES <= 0.0, reason="SUREFOOT_SOAK_MINUTES says for how long")
def test_a_long_soak_leaves_nothing_behind(screen, capfd):
    began = time.monotonic()
    let_loose(screen, 3, lambda _: time.monotonic() - began < 60.0 * SOAK_MINUTES, capfd)
