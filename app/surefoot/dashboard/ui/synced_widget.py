"""Widgets that show what the session does, without taking a person's own change out of their hands."""

from typing import Any


def set_changed(handle: Any, **values: Any) -> None:
    """Set properties of a widget that differ from what it holds.

    Args:
        handle: of a widget, folder or panel.
        values: property -> what it should be, such as ``content``, ``visible``, ``label``.
    """
    for name, value in values.items():
        if getattr(handle, name) != value:
            setattr(handle, name, value)


_PATIENCE = 15  # calls of ``show``, 6 a second: so long a change may take to be obeyed, or is taken back


class Shared:
    """A widget that the page writes and a person changes: it tells the two apart.

    A person's change is recognised by the widget itself: it holds what was not put there. A callback comes too late to
    know it: it waits for a free thread, and would then read what has been written back meanwhile.

    Args:
        handle: a widget with a value, which nobody else writes.
    """

    def __init__(self, handle: Any) -> None:
        self._handle, self._known = handle, handle.value

    @property
    def value(self) -> Any:
        """What it holds."""
        return self._handle.value

    def changed(self) -> bool:
        """Whether a person has changed it since it was written or this was asked."""
        held = self._handle.value
        changed, self._known = not same(held, self._known), held
        return changed

    def put(self, value: Any) -> None:
        """Write it, if that changes anything, and no change of a person has come since ``changed`` was asked."""
        held = self._handle.value
        if not same(held, value) and same(held, self._known):
            self._handle.value = value
            self._known = self._handle.value  # as the widget rounds it


class SyncedWidget:
    """Keeps one widget equal to a value of the session.

    Between a person's change and the first picture that knows of it the session still says the old value. Written
    back, it would reset a slider under the person's hand, and a choice made meanwhile from what the browser still
    shows would be no change at all, and lost.

    Args:
        handle: a widget with a value, which nobody else writes.
    """

    def __init__(self, handle: Any) -> None:
        self._widget, self._left = Shared(handle), 0

    def show(self, value: Any) -> None:
        """The value active now."""
        if self._widget.changed():
            self._left = _PATIENCE
        if same(self._widget.value, value):
            self._left = 0
        elif self._left > 0:
            self._left -= 1
        else:
            self._widget.put(value)


def same(one: Any, other: Any) -> bool:
    """Whether two values of a widget are equal, numbers to 1e-9; a NaN equals itself."""
    if isinstance(one, float | int) and isinstance(other, float | int):
        return abs(one - other) <= 1e-9 or (one != one and other != other)
    return one == other
