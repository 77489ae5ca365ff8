"""Widgets that show what the session does, without taking a person's own change out of their hands."""

from typing import Any

_PATIENCE = 15  # calls of ``show``, 6 a second: so long a change may take to be obeyed, or is taken back


class Follower:
    """Keeps one widget equal to a value of the session.

    Between a person's change and the first picture that knows of it the session still says the old value. Written
    back, it would reset a slider under the person's hand, and a choice made meanwhile from what the browser still
    shows would be no change at all, and lost. A person's change is recognised by the widget itself: it holds what was
    not put there. (A callback comes too late to know it: it waits for a free thread, and would then read what has been
    written back.)

    Args:
        handle: a widget with a value, which nobody else writes.
    """

    def __init__(self, handle: Any) -> None:
        self._handle, self._known, self._left = handle, handle.value, 0

    def show(self, value: Any) -> None:
        """The value at work now."""
        held = self._handle.value
        if not _same(held, self._known):  # a person's doing
            self._known, self._left = held, _PATIENCE
        if _same(held, value):
            self._left = 0
        elif self._left > 0:
            self._left -= 1
        else:
            self._handle.value = value
            self._known = self._handle.value  # as the widget rounds it


def _same(shown: Any, value: Any) -> bool:
    if isinstance(shown, float | int) and isinstance(value, float | int):
        return abs(shown - value) <= 1e-9 or (shown != shown and value != value)  # a NaN is the same as itself
    return shown == value
