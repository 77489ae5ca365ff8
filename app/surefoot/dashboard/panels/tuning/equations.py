"""The switches of what the paper leaves open, each with a line of help and its equation."""

from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.panels.tuning.undo import UndoPanel
from surefoot.dashboard.ui.setting_widgets import SettingWidgets


class EquationsPanel(Panel):
    """Switches and choices.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._undo = UndoPanel(context)
        settings = context.newest().settings
        self._widgets = SettingWidgets(context.gui, "equations", settings, context.send, explain=True)

    def show(self, snapshot: Snapshot) -> None:
        """Take over the active settings."""
        self._undo.show(snapshot)
        self._widgets.show(snapshot.settings)
