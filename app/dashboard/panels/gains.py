"""Gains, delta_P reference, margin and weights: sliders made from the settings' own description."""

import viser

from app.control.settings import ControllerSettings
from app.dashboard.commands import ResetSettings
from app.dashboard.panels.bias import bias_html
from app.dashboard.panels.fields import Send, SettingWidgets
from app.dashboard.snapshot import Snapshot


class GainsPanel:
    """Sliders of what can be tuned.

    Args:
        gui: where to add them.
        send: takes the commands.
        settings: what they show first.
        effects: markdown table gain -> effect -> plot to watch.
    """

    def __init__(self, gui: viser.GuiApi, send: Send, settings: ControllerSettings, effects: str) -> None:
        reset = gui.add_button("Reset to defaults", hint="settings of scenario and controller again")
        reset.on_click(lambda _: send(ResetSettings()))
        self._bias = gui.add_html("")
        self._groups = [SettingWidgets(gui, "delta", settings, send)]
        with gui.add_folder("Gains: stiffness K_P, damping K_D"):
            self._groups.append(SettingWidgets(gui, "gains", settings, send))
        with gui.add_folder("Weights and solver", expand_by_default=False):
            self._groups.append(SettingWidgets(gui, "weights", settings, send))
        with gui.add_folder("What does it do?", expand_by_default=False):
            gui.add_markdown(effects)

    def show(self, snapshot: Snapshot) -> None:
        """Take over the settings at work."""
        text = bias_html(snapshot.bias)
        if self._bias.content != text:
            self._bias.content = text
        for group in self._groups:
            group.show(snapshot.settings)
