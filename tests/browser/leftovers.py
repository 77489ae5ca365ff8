"""What random actions may leave behind: memory, threads, numbers that are none, words on the terminal."""

import gc
import os
import threading
from pathlib import Path

import numpy as np

from surefoot.dashboard.live.rewind.history import HISTORY_TICKS
from surefoot.dashboard.messages.commands import OpenLink, Play, SetSpeed, StopTwin

GROWTH_MB = 50.0
FULL_PAST_S = 1.1e-3 * HISTORY_TICKS  # by then the past is as long as it ever gets
WARM_UP = 250  # actions: by then every panel, view and past has been made once
_FAST = 2.0  # times real time


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
        if wanted == ("stand_left", "two-part", now.tuning.defaults, _FAST, True, None) and not now.geometry.stones:
            return True
        for command in (StopTwin(), OpenLink("scenario=stand_left&controller=two-part"), SetSpeed(_FAST), Play()):
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
