"""Threads that do one thing again and again, and real-time threads before drawing.

A simulation that follows the clock is a real-time task like a robot's controller, and asks for the real-time scheduler
as one does. Chromium raises the priority of its drawing process wherever it may (as root in a container, say), and
then a browser that draws in software on the same cores starves everything else. Without the right to ask (a usual
desktop) nothing changes, and the browser has none either. ``SUREFOOT_REAL_TIME=0`` asks for nothing, niceness
included: for machines where several dashboards, or more important things, share the cores.
"""

import contextlib
import os
import threading
import traceback
from collections.abc import Callable, Iterable
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


_STOPPED_WITHIN_S = 5.0
_AFTER_ERROR_S = 1.0


class LoopThread:
    """Calls a step, waits, calls it again. What a step raises is printed and does not end the thread.

    Args:
        name: of the thread.
        step: does one round, and returns how long to wait before the next [s]; not above 0: not at all.
        level: ``SIMULATES`` or ``SHOWS``, asked for by the thread; None: as usual.
    """

    def __init__(self, name: str, step: Callable[[], float], *, level: int | None = None) -> None:
        self._step, self._level = step, level
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def stop(self) -> None:
        """End it after the step that is under way, and wait for that; it need not have been started."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(timeout=_STOPPED_WITHIN_S)

    def _run(self) -> None:
        if self._level is not None:
            prefer(self._level)
        while not self._stop.is_set():
            try:
                pause_s = self._step()
            except Exception:  # a bug must not freeze the page
                traceback.print_exc()
                pause_s = _AFTER_ERROR_S
            if pause_s > 0.0:
                self._stop.wait(pause_s)
