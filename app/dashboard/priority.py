"""Real-time threads before drawing: what must be on time asks for it, where the system grants that.

Chromium raises the priority of its drawing process wherever it may (as root in a container, say), and then a browser
that draws in software on the same cores starves everything else. Without the right to do so nothing changes, and the
browser has none either.
"""

import contextlib
import os
import threading
from collections.abc import Iterable
from pathlib import Path

_NICENESS = -10  # Chromium's drawing process asks for -8


def prefer_session() -> None:
    """Ask for priority for the calling process, which leads a session of its own.

    Linux may share the cores between sessions first (autogroups); then a thread's niceness counts inside its session
    only, and the session has one too.
    """
    prefer()
    with contextlib.suppress(OSError):
        Path("/proc/self/autogroup").write_text(f"{_NICENESS}\n")


def prefer(threads: Iterable[threading.Thread] | None = None) -> None:
    """Ask for priority for some threads, or for the calling one."""
    if not hasattr(os, "setpriority"):
        return
    if threads is None:
        chosen = [threading.get_native_id()]
    else:
        chosen = [thread.native_id for thread in threads if thread.native_id is not None]
    for native_id in chosen:
        try:
            os.setpriority(os.PRIO_PROCESS, native_id, _NICENESS)
        except OSError:  # not allowed, or the thread is gone: nothing is lost
            return
