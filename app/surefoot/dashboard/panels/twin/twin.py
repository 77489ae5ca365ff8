"""Twin run: a second robot with another controller or other settings, under the same disturbances at the same ticks."""

from collections.abc import Callable, Sequence

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
from surefoot.dashboard.panels.twin.twin_plots import TwinPlots
from surefoot.dashboard.panels.twin.twin_strip import strip_html
from surefoot.dashboard.ui.setting_widgets import Send, SettingWidgets, from_browser
from surefoot.dashboard.ui.synced_widget import SyncedWidget
from surefoot.dashboard.ui.widget_updates import set_changed

_GROUPS = (("Twin's gains", "gains"), ("Twin's δ_P reference and margin", "delta"), ("Twin's equations", "equations"))


class TwinPanel:
    """Start, stop, arrangement, timeline, difference plots, and the twin's own settings.

    Args:
        gui: where to add it.
        send: takes the commands.
        controllers: their names.
        first: the snapshot to show first.
        arrangements: how the twin can be shown.
        arrange: called with one of them, and who asked.
    """

    def __init__(
        self, gui: viser.GuiApi, send: Send, controllers: Sequence[str], first: Snapshot,
        arrangements: Sequence[str], arrange: Callable[[str, viser.ClientHandle | None], None],
    ) -> None:  # fmt: skip
        others = [name for name in ("optimization", *controllers) if name in controllers and name != first.controller]
        self._choice = gui.add_dropdown(
            "Twin's controller", list(controllers), initial_value=others[0] if others else first.controller,
            hint="who drives the second robot; stones, pushes, friction, pace and scenario are those of the first",
        )  # fmt: skip
        shown = gui.add_dropdown("Twin shown as", tuple(arrangements), hint="the choice holds for every viewer")
        self._start = gui.add_button(
            "Start twin run", hint="both robots begin at the start of the scenario, so that nothing but controller and "
            "settings tells them apart",
        )  # fmt: skip
        self._stop = gui.add_button("Stop twin run", visible=False, hint="take the second robot away")
        self._strip = gui.add_html(strip_html(first))
        self._plots = TwinPlots(gui, height=96)
        self._settings: list[SettingWidgets] = []
        self._folders = []
        for label, group in _GROUPS:
            folder = gui.add_folder(label, expand_by_default=False, visible=False)
            with folder:
                self._settings.append(SettingWidgets(gui, group, first.settings, lambda c: send(_for_twin(c))))
            self._folders.append(folder)

        @self._choice.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event) and self._stop.visible:
                send(SetTwinController(event.target.value))

        @shown.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                arrange(event.target.value, event.client)

        self._follower = SyncedWidget(self._choice)
        self._start.on_click(lambda _: send(StartTwin(self._choice.value)))
        self._stop.on_click(lambda _: send(StopTwin()))

    def show(self, snapshot: Snapshot) -> None:
        """Say how the two compare."""
        set_changed(self._strip, content=strip_html(snapshot))
        on = snapshot.twin is not None
        set_changed(self._stop, visible=on)
        set_changed(self._start, visible=not on)
        other = snapshot.twin.other if snapshot.twin else None
        for folder in self._folders:
            set_changed(folder, visible=other is not None)
        if other is None:
            return
        self._follower.show(other.controller)
        for widgets in self._settings:
            widgets.show(other.settings)

    def plot(self, snapshot: Snapshot) -> None:
        """Draw the differences of the last seconds."""
        if snapshot.twin is not None:
            self._plots.show(snapshot.twin.table)


def _for_twin(command: Command) -> Command:
    return ChangeTwinSettings(command.changes) if isinstance(command, ChangeSettings) else command
