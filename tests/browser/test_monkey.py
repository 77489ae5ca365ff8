"""Random actions in a real browser leave no exception, no NaN, no thread and no memory behind."""

import gc
import threading
from pathlib import Path

import numpy as np
import pytest

from tests.browser.monkey import Monkey

pytestmark = pytest.mark.browser

GROWTH_MB = 50.0
WARM_UP = 250  # actions: by then every panel, view and past has been made once


def megabytes(pid: int | str) -> float:
    """Resident memory of a process."""
    gc.collect()
    line = next(line for line in Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith("VmRSS"))
    return float(line.split()[1]) / 1024.0


def fill_the_past(screen) -> None:
    """Stand alone and run until the past is as long as it ever gets."""
    from app.dashboard.commands import ClearStones, LoadScenario, Play, SetSpeed, StopTwin
    from app.dashboard.history import HISTORY_TICKS

    session = screen.dashboard.session
    for command in (StopTwin(), LoadScenario("stand_left"), ClearStones(), SetSpeed(2.0), Play()):
        session.send(command)
    screen.wait_for(lambda: session.snapshot.scenario == "stand_left" and session.snapshot.twin is None)
    screen.wait_for(lambda: session.snapshot.time_s > 1.1e-3 * HISTORY_TICKS)


def finite(snapshot) -> bool:
    """Whether what is drawn and what is set are numbers."""
    geometry = snapshot.geometry
    settings = [value for value in vars(snapshot.settings).values() if isinstance(value, float)]
    return bool(np.isfinite(geometry.qpos).all() and np.isfinite(settings).all() and np.isfinite(snapshot.time_s))


def threads() -> set[str]:
    """Names of threads that live, without those of viser's pool, which grows to its size and stays."""
    return {thread.name for thread in threading.enumerate() if not thread.name.startswith("ThreadPoolExecutor")}


@pytest.mark.parametrize(("actions", "seed"), [
    pytest.param(60, 1, id="some"), pytest.param(1000, 2, id="thousand", marks=pytest.mark.slow),
])  # fmt: skip
def test_random_actions_leave_nothing_behind(screen, actions, seed, capfd):
    session, mishaps, monkey = screen.dashboard.session, [], Monkey(screen, seed)
    screen.page.on("pageerror", lambda error: mishaps.append(str(error)))
    before, memory = threads(), None
    for number in range(actions):
        monkey.act()
        assert finite(session.snapshot), monkey.done[-3:]
        assert session.statistics().errors == 0, monkey.done[-3:]
        if number == WARM_UP:
            fill_the_past(screen)
            memory = megabytes("self")
    ticks = session.statistics().ticks
    if memory is not None:
        fill_the_past(screen)
        grown = megabytes("self") - memory
        print(f"{actions} actions: {grown:+.1f} MB, {len(monkey.done)} done")
        assert grown < GROWTH_MB
    session.send(_anew())
    screen.wait_for(lambda: session.statistics().ticks > ticks + 100)  # it still runs
    assert mishaps == []
    assert threads() <= before
    printed = capfd.readouterr()
    assert "Traceback" not in printed.out + printed.err, printed.err[-3000:]


def _anew():
    from app.dashboard.commands import LoadScenario

    return LoadScenario("stand_left")
