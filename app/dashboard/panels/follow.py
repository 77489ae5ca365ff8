"""Widgets that show what the session does, without taking a person's own change out of their hands."""

from typing import Any

import viser

_PATIENCE = 15  # calls of ``show``, 6 a second: so long a change may take to be obeyed, or is taken back


class Follower:
    """Keeps one widget equal to a value of the session.

    Between a person's change and the first picture that knows of it the session still says the old value. Written
    back, it would reset a slider under the person's hand, and a choice made meanwhile from what the browser still
    shows would be no change at all, and lost.

    Args:
        handle: a widget with a value.
    """

    def __init__(self, handle: Any) -> None:
        self._handle, self._left = handle, 0

        @handle.on_update
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:  # a person, not the page itself
                self._left = _PATIENCE

    def show(self, value: Any) -> None:
        """The value at work now."""
        if _same(self._handle.value, value):
            self._left = 0
        elif self._left > 0:
            self._left -= 1
        else:
            self._handle.value = value


def _same(shown: Any, value: Any) -> bool:
    if isinstance(shown, float | int) and isinstance(value, float | int):
        return abs(shown - value) <= 1e-9
    return shown == value
