"""The keys, listed from the commands that the page has really registered: who adds one needs to tell nobody."""

from html import escape

import viser

from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.synced_widget import set_changed

Row = tuple[str, str, str]  # keys, what they do, more about it

CAMERA_KEYS: tuple[Row, ...] = (
    ("W A S D Q E", "move the camera", "hold: forward, left, back, right, down, up"),
    ("← → ↑ ↓", "turn the camera", "hold"),
    ("Ctrl+K", "find any command", "Cmd+K on a Mac"),
)
_NAMES = {
    **{"space": "Space", "cmd/ctrl": "Ctrl", "shift": "Shift", "alt": "Alt"},
    **{"pageup": "PgUp", "pagedown": "PgDn", "home": "Home", "end": "End"},
}


class KeysPanel(Panel):
    """The list, in a folder.

    Args:
        context: of the page whose commands they are.
    """

    def __init__(self, context: PageContext) -> None:
        self._gui = context.gui
        with self._gui.add_folder("Keyboard", expand_by_default=False):
            self._html = self._gui.add_html(keys_html(registered(self._gui)))

    def show(self, snapshot: Snapshot) -> None:
        """Take over commands that have come since."""
        set_changed(self._html, content=keys_html(registered(self._gui)))


def registered(gui: viser.GuiApi) -> list[Row]:
    """Every command of the page that has a key, in the order in which they were registered."""
    handles = tuple(gui._command_handle_from_uuid.values())  # viser has no public list of them
    return [
        (_shown(handle.hotkey, handle.modifier), handle.label, handle.description or "")
        for handle in handles
        if handle.hotkey is not None and not handle.disabled
    ]


def keys_html(rows: list[Row]) -> str:
    """The table, with viser's own keys below ours."""
    cell = "padding:2px 4px;vertical-align:top"
    lines = "".join(
        f'<tr><td style="{cell};width:64px">{_caps(keys)}</td><td style="{cell}"><span>{escape(label)}</span>'
        + (f'<div style="opacity:0.7;font-size:11px">{escape(more)}</div>' if more else "")
        + "</td></tr>"
        for keys, label, more in (*rows, *CAMERA_KEYS)
    )
    return (
        '<div data-keys style="padding:2px 8px;font-size:12px;line-height:1.3">They work unless you are typing in a '
        f'text or number field.<table style="border-collapse:collapse;width:100%">{lines}</table></div>'
    )


def _shown(key: str, modifier: str | None) -> str:
    parts = [*(modifier.split("+") if modifier else []), key]
    return "+".join(key_name(part) for part in parts)


def key_name(key: str) -> str:
    """What stands on a key that viser calls by that name."""
    return _NAMES.get(key, key)


def _caps(keys: str) -> str:
    style = (
        "display:inline-block;border:1px solid #8888;border-radius:4px;padding:0 5px;font-size:11px;font-family:inherit"
    )
    return " ".join(f'<kbd style="{style}">{escape(key)}</kbd>' for key in keys.split(" "))
