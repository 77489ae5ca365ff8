"""The switches of what the paper leaves open, each with a line of help and its equation."""

import viser

from app.control.settings import ControllerSettings
from app.dashboard.panels.fields import Send, SettingWidgets
from app.dashboard.snapshot import Snapshot


class EquationsPanel:
    """Switches and choices.

    Args:
        gui: where to add them.
        send: takes the commands.
        settings: what they show first.
    """

    def __init__(self, gui: viser.GuiApi, send: Send, settings: ControllerSettings) -> None:
        self._widgets = SettingWidgets(gui, "equations", settings, send, explain=True)

    def show(self, snapshot: Snapshot) -> None:
        """Take over the settings at work."""
        self._widgets.show(snapshot.settings)
