"""Real-time threads before drawing: what must be on time asks for it, where the system grants that.

A simulation that follows the clock is a real-time task like a robot's controller, and asks for the real-time scheduler
as one does. Chromium raises the priority of its drawing process wherever it may (as root in a container, say), and
then a browser that draws in software on the same cores starves everything else. Without the right to ask (a usual
desktop) nothing changes, and the browser has none either. ``SUREFOOT_REAL_TIME=0`` asks for nothing, niceness
included: for machines where several dashboards, or more important things, share the cores.
"""

import contextlib
import os
import threading
from collections.abc import Iterable
from pathlib import Path

SWITCH = "SUREFOOT_REAL_TIME"
SIMULATES, SHOWS = 2, 1  # real-time priorities: the page may wait for the simulation, not the other way round
_NICENESS = -10  # where there is no real-time scheduler; Chromium's drawing process asks for -8


def _asks() -> bool:
    return os.environ.get(SWITCH) != "0"


def prefer_session() -> None:
    """Ask for priority for the calling process, which simulates and leads a session of its own.

    Linux may share the cores between sessions first (autogroups); then a thread's niceness counts inside its session
    only, and the session has one too.
    """
    if not prefer(SIMULATES) and _asks():
        with contextlib.suppress(OSError):
            Path("/proc/self/autogroup").write_text(f"{_NICENESS}\n")


def prefer(level: int, threads: Iterable[threading.Thread] | None = None) -> bool:
    """Ask for priority for some threads, or for the calling one: whether all are real-time threads now."""
    if threads is None:
        chosen = [threading.get_native_id()]
    else:
        chosen = [thread.native_id for thread in threads if thread.native_id is not None]
    return all([_real_time(native_id, level) or _nice(native_id) for native_id in chosen])


def _real_time(native_id: int, level: int) -> bool:
    """Threads of one level take turns.

    What a thread that shows starts is one too: Python runs one thread at a time, and one that waits for a core while
    it has its turn holds up all the others. What a simulating thread starts is as usual.
    """
    if not _asks() or not hasattr(os, "SCHED_RESET_ON_FORK"):
        return False
    policy = os.SCHED_RR | (os.SCHED_RESET_ON_FORK if level == SIMULATES else 0)
    try:
        os.sched_setscheduler(native_id, policy, os.sched_param(level))
    except OSError:  # not allowed, or the thread is gone: nothing is lost
        return False
    return True


def _nice(native_id: int) -> bool:
    if _asks() and hasattr(os, "setpriority"):
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, native_id, _NICENESS)
    return False
