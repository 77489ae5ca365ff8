"""A thread that does one thing again and again until it is told to stop."""

import threading
import traceback
from collections.abc import Callable

from surefoot.dashboard.engine.thread_priority import prefer

_STOPPED_WITHIN_S = 5.0
_AFTER_ERROR_S = 1.0


class LoopThread:
    """Calls a step, waits, calls it again. What a step raises is printed and does not end the thread.

    Args:
        name: of the thread.
        step: does one round, and returns how long to wait before the next [s]; not above 0: not at all.
        level: of ``thread_priority``, asked for by the thread; None: as usual.
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
