"""Writing into widgets only what is new.

Viser drops most writes of an equal value by itself, but parses markdown anew, and refuses any write to the widget of a
visitor who has just left.
"""

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
