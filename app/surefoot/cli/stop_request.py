"""Ctrl-C as a request: the first one lets a command end in order."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class StopRequest:
    """Whether the person, or the system, wants the command to end.

    Attributes:
        signal: with which signal; 0 while nobody does.
    """

    def __init__(self) -> None:
        self.signal = 0

    def __call__(self) -> bool:
        """Whether somebody does."""
        return self.signal != 0

    @property
    def exit_code(self) -> int:
        """As a shell reports a command that the signal has ended."""
        return 128 + self.signal


@contextmanager
def stop_request() -> Iterator[StopRequest]:
    """Within, a first Ctrl-C (or SIGTERM) is noted; a second one ends the program as usual."""
    request = StopRequest()
    if threading.current_thread() is not threading.main_thread():  # only the main one gets signals
        yield request
        return
    before = {name: signal.getsignal(name) for name in (signal.SIGINT, signal.SIGTERM)}

    def as_before() -> None:
        for name, handler in before.items():
            signal.signal(name, handler)

    def note(number: int, _: FrameType | None) -> None:
        request.signal = number
        as_before()

    for name in before:
        signal.signal(name, note)
    try:
        yield request
    finally:
        as_before()
