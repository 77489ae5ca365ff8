"""How the robot knows its state: sensors by preset or figure by figure, and the estimator that reads them."""

import dataclasses
from collections.abc import Mapping
from typing import Any

import viser

from surefoot.dashboard.messages.commands import ChangeSensing
from surefoot.dashboard.messages.sensing import Sensing
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.ui.setting_widgets import from_browser
from surefoot.dashboard.ui.sliders import add_number, add_slider
from surefoot.dashboard.ui.synced_widget import SyncedWidget, same, set_changed
from surefoot.estimation.registry import estimators
from surefoot.simulation.presets import PERFECT, PRESET_HELP, PRESETS
from surefoot.simulation.sensors.settings import SensorSettings

_FIGURES = {
    "gyro_noise_rad_s": "Gyro noise",
    "gyro_bias_rad_s": "Gyro bias",
    "accelerometer_noise_m_s2": "Accelerometer noise",
    "accelerometer_bias_m_s2": "Accelerometer bias",
    "encoder_noise_rad": "Encoder noise",
    "velocity_noise_rad_s": "Joint velocity noise",
    "foot_force_noise_n": "Foot force noise",
    "foot_force_bias_n": "Foot force bias",
    "foot_moment_bias_nm": "Foot moment bias",
    "imu_latency_s": "IMU latency",
    "encoder_latency_s": "Encoder latency",
    "foot_latency_s": "Foot latency",
}
_UNITS = {"m/s2": "m/s²", "N m": "N·m"}
_SEED, _DIGITS = "seed", 9  # a slider's sum of steps has dust in its last digits


class SensorsPanel(Panel):
    """Menus, which act at once, and figures, which wait for their button.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, self._send = context.gui, context.send
        self._shown = context.newest().sensing
        preset = gui.add_dropdown("Sensors", PRESETS, initial_value=self._shown.sensors.preset, hint=PRESET_HELP)
        kinds = estimators()
        hint = "; ".join(f"{name}: {entry.help}" for name, entry in kinds.items())
        estimator = gui.add_dropdown("Estimator", tuple(kinds), initial_value=self._shown.estimator, hint=hint)
        self._story = gui.add_html("")
        with gui.add_folder("Figures of the sensors", expand_by_default=False):
            self._figures = {name: _widget(gui, name, self._shown) for name in (*_FIGURES, _SEED)}
            start = gui.add_button("Start with these figures", hint="the scenario begins again", color="gray")
        self._menus = SyncedWidget(preset), SyncedWidget(estimator)

        @preset.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                self._send(ChangeSensing({"preset": event.target.value}))

        @estimator.on_update
        def _(event: viser.GuiEvent) -> None:
            if from_browser(event):
                self._send(ChangeSensing(estimator=event.target.value))

        start.on_click(lambda _: self._send(ChangeSensing(self._changes())))
        self.show(context.newest())

    def show(self, snapshot: Snapshot) -> None:
        """Take over what is at work: figures only where that has changed, they may be under a person's hand."""
        sensing = snapshot.sensing
        for menu, value in zip(self._menus, (sensing.sensors.preset, sensing.estimator), strict=True):
            menu.show(value)
        set_changed(self._story, content=sensing_html(sensing))
        if sensing != self._shown:
            self._shown = sensing
            for name, widget in self._figures.items():
                set_changed(widget, value=float(getattr(sensing.sensors, name)))

    def _changes(self) -> Mapping[str, Any]:
        """Only what a person has moved: what a slider rounds is to stay as it was."""
        held = {name: round(widget.value, _DIGITS) for name, widget in self._figures.items()}
        now = {name: getattr(self._shown.sensors, name) for name in held}
        return {name: value for name, value in held.items() if not same(value, now[name])}


def sensing_html(sensing: Sensing) -> str:
    """Who knows what, in words."""
    if sensing.estimating:
        story = (
            f"Controller and gait get what <b>{sensing.estimator}</b> makes of the sensors; falls, plots and the solid "
            "robot are the truth. The cyan ghost is the robot as it is believed to be."
        )
    elif sensing.sensors.preset != PERFECT or sensing.own_figures:
        story = "<b>Nobody reads these sensors</b>: choose an estimator. Controller and gait get the true state."
    else:
        story = "Controller and gait get the true state, which no robot has."
    own = ", ".join(f"{_FIGURES.get(name, name)} {value:g}" for name, value in sensing.own_figures.items())
    changed = f"<div>Other than in the preset: {own}.</div>" if own else ""
    return (
        f'<div style="padding:4px 10px;font-size:12px;line-height:1.5"><div>{story}</div>{changed}'
        '<div style="opacity:0.7">A change starts the scenario again: biases are drawn once for a run.</div></div>'
    )


def _widget(gui: viser.GuiApi, name: str, sensing: Sensing) -> Any:
    """As the field of the sensors is described: range, step and help."""
    meta = next(field.metadata for field in dataclasses.fields(SensorSettings) if field.name == name)
    value = getattr(sensing.sensors, name)
    if name == _SEED:
        return add_number(gui, "Seed", value, 1.0, meta["help"])
    label = f"{_FIGURES[name]} [{_UNITS.get(meta['unit'], meta['unit'])}]"
    return add_slider(gui, label, meta["low"], meta["high"], meta["step"], value, hint=meta["help"])
