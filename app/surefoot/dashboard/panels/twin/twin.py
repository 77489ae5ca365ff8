"""Twin run: a second robot with another controller or other settings, under the same disturbances at the same ticks.

Its settings have the same widgets as the first robot's, there while a twin runs.
"""

import viser

from surefoot.dashboard.messages.commands import (
    ChangeSettings,
    ChangeTwinSettings,
    Command,
    SetTwinController,
    StartTwin,
    StopTwin,
)
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.twin.twin_strip import strip_html
from surefoot.dashboard.scene.twin_scene import ARRANGEMENTS
from surefoot.dashboard.ui.setting_widgets import SettingWidgets, from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget, set_changed


class TwinPanel(Panel):
    """Start, stop, arrangement and timeline.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first, controllers = context.gui, context.send, context.newest(), list(context.controllers)
        others = [name for name in ("optimization", *controllers) if name in controllers and name != first.controller]
        self._choice = gui.add_dropdown(
            "Twin's controller",
            controllers,
            initial_value=others[0] if others else first.controller,
            hint="who drives the second robot; stones, pushes, friction, pace and scenario are those of the first",
        )
        shown = gui.add_dropdown("Twin shown as", ARRANGEMENTS, hint="the choice holds for every viewer")
        self._start = gui.add_button(
            "Start twin run",
            hint="both robots begin at the start of the scenario, so that nothing but controller and "
            "settings tells them apart",
        )
        self._stop = gui.add_button("Stop twin run", visible=False, hint="take the second robot away")
        self._strip = gui.add_html(strip_html(first))

        @self._choice.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event) and self._stop.visible:
                send(SetTwinController(event.target.value))

        @shown.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                context.arrange_twin(event.target.value, event.client)

        self._arrangement = context.twin_arrangement
        self._follower, self._follows_arrangement = SyncedWidget(self._choice), SyncedWidget(shown)
        self._start.on_click(lambda _: send(StartTwin(self._choice.value)))
        self._stop.on_click(lambda _: send(StopTwin()))

    def show(self, snapshot: Snapshot) -> None:
        """Say how the two compare."""
        self._follows_arrangement.show(self._arrangement())
        set_changed(self._strip, content=strip_html(snapshot))
        on = snapshot.twin is not None
        set_changed(self._stop, visible=on)
        set_changed(self._start, visible=not on)
        if snapshot.twin is not None and snapshot.twin.other is not None:
            self._follower.show(snapshot.twin.other.controller)


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
