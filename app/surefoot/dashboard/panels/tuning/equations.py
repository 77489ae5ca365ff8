"""The switches of what the paper leaves open, each with a line of help and its equation."""

import viser

from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.tuning.undo import UndoPanel
from surefoot.dashboard.ui.setting_widgets import Send, SettingWidgets


class EquationsPanel:
    """Switches and choices.

    Args:
        gui: where to add them.
        send: takes the commands.
        first: the snapshot to show first.
    """

    def __init__(self, gui: viser.GuiApi, send: Send, first: Snapshot) -> None:
        self._undo = UndoPanel(gui, send, first)
        self._widgets = SettingWidgets(gui, "equations", first.settings, send, explain=True)

    def show(self, snapshot: Snapshot) -> None:
        """Take over the active settings."""
        self._undo.show(snapshot)
        self._widgets.show(snapshot.settings)
