"""The twin's own settings: the same widgets as the first robot's, there while a twin runs."""

from surefoot.dashboard.messages.commands import ChangeSettings, ChangeTwinSettings, Command
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.ui.setting_widgets import SettingWidgets
from surefoot.dashboard.ui.widget_updates import set_changed

_GROUPS = (("Twin's gains", "gains"), ("Twin's δ_P reference and margin", "delta"), ("Twin's equations", "equations"))


class TwinSettingsPanel(Panel):
    """A folder for each group of settings.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._widgets: list[SettingWidgets] = []
        self._folders = []
        for label, group in _GROUPS:
            folder = gui.add_folder(label, expand_by_default=False, visible=False)
            with folder:
                self._widgets.append(SettingWidgets(gui, group, first.settings, lambda c: send(_for_twin(c))))
            self._folders.append(folder)

    def show(self, snapshot: Snapshot) -> None:
        """Take over the twin's settings, or hide when there is none."""
        other = snapshot.twin.other if snapshot.twin else None
        for folder in self._folders:
            set_changed(folder, visible=other is not None)
        if other is not None:
            for widgets in self._widgets:
                widgets.show(other.settings)


def _for_twin(command: Command) -> Command:
    return ChangeTwinSettings(command.changes) if isinstance(command, ChangeSettings) else command
