"""What differs from the defaults, and the way back: undo, redo."""

from html import escape

import viser

from surefoot.control.settings import settings_differences
from surefoot.dashboard.messages.commands import RedoSettings, UndoSettings
from surefoot.dashboard.messages.snapshot import SettingsChange, Snapshot
from surefoot.dashboard.panels.panel import PageContext
from surefoot.dashboard.ui.setting_labels import change_text, difference_text
from surefoot.dashboard.ui.synced_widget import set_changed

_SHOWN = 4
_UNDO_HINT = "the last change of controller or settings, whoever made it; a slider's drag is one. Key: ctrl Z"
_REDO_HINT = "make the change again that was undone. Key: ctrl shift Z"


class UndoPanel:
    """A line and two buttons; there may be several, they all say the same.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._line = gui.add_html(defaults_html(first))
        self._undo = gui.add_button("Nothing to undo", hint=_UNDO_HINT, color="gray", disabled=True)
        self._redo = gui.add_button("Nothing to redo", hint=_REDO_HINT, color="gray", visible=False)
        self._undo.on_click(lambda _: send(UndoSettings()))
        self._redo.on_click(lambda _: send(RedoSettings()))
        self.show(first)

    def show(self, snapshot: Snapshot) -> None:
        """Say what can be undone now."""
        tuning = snapshot.tuning
        set_changed(self._line, content=defaults_html(snapshot))
        _say(self._undo, "Undo", tuning.undo, _UNDO_HINT)
        _say(self._redo, "Redo", tuning.redo, _REDO_HINT)
        set_changed(self._undo, disabled=tuning.undo is None)
        set_changed(self._redo, visible=tuning.redo is not None)


def add_undo_keys(context: PageContext) -> None:
    """Add ctrl Z and ctrl shift Z."""
    gui, send = context.gui, context.send
    undo = gui.add_command("Undo settings", description=_UNDO_HINT, hotkey="Z", modifier="cmd/ctrl")
    redo = gui.add_command("Redo settings", description=_REDO_HINT, hotkey="Z", modifier="cmd/ctrl+shift")
    undo.on_trigger(lambda _: send(UndoSettings()))
    redo.on_trigger(lambda _: send(RedoSettings()))


def defaults_html(snapshot: Snapshot) -> str:
    """How many settings differ from those of scenario and controller, and which."""
    changed = settings_differences(snapshot.tuning.defaults, snapshot.settings)
    if not changed:
        text, everything = f"All settings are the defaults of {escape(snapshot.controller)}.", ""
    else:
        how_many = "1 setting</b> differs" if len(changed) == 1 else f"{len(changed)} settings</b> differ"
        names = ", ".join(escape(difference_text(*difference)) for difference in changed[:_SHOWN])
        more = f" and {len(changed) - _SHOWN} more" if len(changed) > _SHOWN else ""
        text = f"<b>{how_many} from the defaults: {names}{more}"
        everything = escape("; ".join(difference_text(*difference, unit=True) for difference in changed))
    return (
        f'<div role="status" aria-label="Changed settings" title="{everything}" '
        f'style="padding:2px 10px 4px;font-size:12px;line-height:1.35;color:inherit">{text}</div>'
    )


def _say(button: viser.GuiButtonHandle, verb: str, change: SettingsChange | None, hint: str) -> None:
    label = f"{verb}: {change_text(change)}" if change else f"Nothing to {verb.lower()}"
    if button.label != label:
        button.label = label
        button.hint = f"{verb} {change_text(change, 40)}. {hint[0].upper()}{hint[1:]}" if change else hint
