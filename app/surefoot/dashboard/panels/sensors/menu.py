"""A menu that acts at once, and shows what is at work."""

from collections.abc import Callable, Sequence

import viser

from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget


def add_menu(
    gui: viser.GuiApi, label: str, choices: Sequence[str], value: str, hint: str, act: Callable[[str], None]
) -> SyncedWidget:
    """Add it; ``act`` gets what a person has chosen."""
    menu = gui.add_dropdown(label, tuple(choices), initial_value=value, hint=hint)

    @menu.on_update
    def _(event: viser.GuiEvent) -> None:
        if from_browser(event):
            act(event.target.value)

    return SyncedWidget(menu)
