"""Gains, delta_P reference, margin and weights: sliders made from the settings' own description."""

from surefoot.dashboard.messages.commands import ResetSettings
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.page_context import PageContext
from surefoot.dashboard.panels.panel import Panel
from surefoot.dashboard.panels.tuning.delta_range import bias_html
from surefoot.dashboard.panels.tuning.preset_files import shipped_presets
from surefoot.dashboard.panels.tuning.presets import PresetPanel
from surefoot.dashboard.panels.tuning.undo import UndoPanel
from surefoot.dashboard.ui.setting_labels import label_of, watched
from surefoot.dashboard.ui.setting_widgets import SettingWidgets, fields_of
from surefoot.dashboard.ui.widget_updates import set_changed

_TUNED = ("gains", "delta", "weights")


class GainsPanel(Panel):
    """Sliders of what can be tuned, the way back, and presets.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, send, first = context.gui, context.send, context.newest()
        self._undo = UndoPanel(context)
        reset = gui.add_button("Reset to defaults", hint="settings of scenario and controller again", color="gray")
        reset.on_click(lambda _: send(ResetSettings()))
        with gui.add_folder("Presets and files", expand_by_default=False):
            self._presets = PresetPanel(context, shipped_presets())
        self._bias = gui.add_html("")
        self._groups = [SettingWidgets(gui, "delta", first.settings, send)]
        with gui.add_folder("Gains: stiffness K_P, damping K_D"):
            self._groups.append(SettingWidgets(gui, "gains", first.settings, send))
        with gui.add_folder("Weights and solver", expand_by_default=False):
            self._groups.append(SettingWidgets(gui, "weights", first.settings, send))
        with gui.add_folder("What does it do?", expand_by_default=False):
            gui.add_markdown(effects_table())

    def show(self, snapshot: Snapshot) -> None:
        """Take over the active settings."""
        self._undo.show(snapshot)
        self._presets.show(snapshot)
        set_changed(self._bias, content=bias_html(snapshot.bias))
        for group in self._groups:
            group.show(snapshot.settings)


def effects_table() -> str:
    """Gain, what raising it does, which plots show it: markdown, from the settings' own description."""
    rows = ["| Raise this | and you get | Watch |", "|---|---|---|"]
    for group in _TUNED:
        for field in fields_of(group):
            if field.metadata.get("raised"):
                rows.append(f"| {label_of(field)} | {field.metadata['raised']} | {'; '.join(watched(field))} |")
    return "\n".join(rows)
