"""Sliders and switches made from the settings' own description.

Gains, weights, the delta_P reference with its admissible range, and the switches of what the paper leaves open.
"""

from surefoot.dashboard.messages.commands import ResetSettings
from surefoot.dashboard.messages.shown_robot import ShownRobot
from surefoot.dashboard.messages.snapshot import BiasView, Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.tuning.presets import PresetPanel, shipped_presets
from surefoot.dashboard.panels.tuning.undo import UndoPanel
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.setting_labels import FIELDS, label_of, watched
from surefoot.dashboard.ui.setting_widgets import SettingWidgets, fields_of, range_shown
from surefoot.dashboard.ui.synced_widget import set_changed
from surefoot.number_text import figure

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
        self._robot = ""

    def show(self, snapshot: Snapshot) -> None:
        """Take over the active settings."""
        self._undo.show(snapshot)
        self._presets.show(snapshot)
        if snapshot.robot.key != self._robot:
            self._robot = snapshot.robot.key
            for group in self._groups:
                group.suit(snapshot.robot)
        set_changed(self._bias, content=bias_html(snapshot.bias, snapshot.robot))
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


def bias_html(bias: BiasView, robot: ShownRobot) -> str:
    """Two bars over the sliders' whole range: green where admissible, with a mark at the value, and the prediction."""
    frontal, sagittal = bias.reference_nm
    forward, left = bias.displacement_mm
    return (
        '<div style="padding:4px 10px;font-size:12px;line-height:1.6;color:inherit">'
        f"{_bar('sagittal', sagittal, bias.sagittal_nm, robot)}"
        f"{_bar('frontal', frontal, bias.frontal_nm, robot)}"
        f'<div title="where the CoM comes to rest, from gains and the whole body\'s inertia">predicted CoM shift: '
        f"forward {forward:+.1f} mm, left {left:+.1f} mm</div></div>"
    )


def _bar(name: str, value: float, interval: tuple[float, float] | None, robot: ShownRobot) -> str:
    low, high, _ = range_shown(FIELDS[f"delta_ref_{name}_nm"], robot)

    def place(x: float) -> float:
        return 100.0 * (min(max(x, low), high) - low) / (high - low)

    if interval is None:
        return f"<div>δ_P ref {name}: no admissible range in this posture</div>"
    start, end = place(interval[0]), place(interval[1])
    inside = interval[0] <= value <= interval[1]
    mark = palette.GOOD if inside else palette.BAD
    return (
        f"<div>δ_P ref {name}: admissible {figure(interval[0])} to {figure(interval[1])} N·m</div>"
        f'<div style="position:relative;height:8px;border-radius:4px;background:{palette.BAD}55">'
        f'<div style="position:absolute;left:{start:.1f}%;width:{end - start:.1f}%;height:8px;'
        f'background:{palette.GOOD}99"></div>'
        f'<div style="position:absolute;left:calc({place(value):.1f}% - 2px);top:-2px;width:4px;height:12px;'
        f'background:{mark};border:1px solid #fff"></div></div>'
    )


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
