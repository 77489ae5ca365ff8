"""How the robot knows its state: sensors by preset or figure by figure, and the estimator that reads them."""

from surefoot.dashboard.messages.commands import ChangeSensing
from surefoot.dashboard.messages.sensing import Sensing, own_figures
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.sensors.figures import Figures
from surefoot.dashboard.panels.sensors.menu import add_menu
from surefoot.dashboard.ui.synced_widget import set_changed
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
    "seed": "Seed",
}


class SensorsPanel(Panel):
    """Menus, which act at once, and figures, which wait for their button.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, self._send, sensing = context.gui, context.send, context.newest().sensing
        kinds = estimators()
        hint = "; ".join(f"{name}: {entry.help}" for name, entry in kinds.items())
        self._menus = (
            add_menu(gui, "Sensors", PRESETS, sensing.sensors.preset, PRESET_HELP, self._take_preset),
            add_menu(gui, "Estimator", tuple(kinds), sensing.estimator, hint, self._take_estimator),
        )
        self._story = gui.add_html(sensing_html(sensing))
        self._figures = Figures(
            gui,
            "Figures of the sensors",
            _FIGURES,
            (SensorSettings,),
            _values(sensing),
            button="Start with these figures",
            start=lambda moved: self._send(ChangeSensing(moved)),
        )

    def show(self, snapshot: Snapshot) -> None:
        """Take over what is at work."""
        sensing = snapshot.sensing
        for menu, value in zip(self._menus, (sensing.sensors.preset, sensing.estimator), strict=True):
            menu.show(value)
        set_changed(self._story, content=sensing_html(sensing))
        self._figures.show(_values(sensing))

    def _take_preset(self, preset: str) -> None:
        self._send(ChangeSensing({"preset": preset}))

    def _take_estimator(self, name: str) -> None:
        self._send(ChangeSensing(estimator=name))


def _values(sensing: Sensing) -> dict[str, float]:
    return {name: getattr(sensing.sensors, name) for name in _FIGURES}


def sensing_html(sensing: Sensing) -> str:
    """Who knows what, in words."""
    own = own_figures(sensing.sensors)
    if sensing.estimating:
        story = (
            f"Controller and gait get what <b>{sensing.estimator}</b> makes of the sensors; falls, plots and the solid "
            "robot are the truth. The cyan ghost is the robot as it is believed to be."
        )
    elif sensing.sensors.preset != PERFECT or own:
        story = "<b>Nobody reads these sensors</b>: choose an estimator. Controller and gait get the true state."
    else:
        story = "Controller and gait get the true state, which no robot has."
    figures = ", ".join(f"{_FIGURES.get(name, name)} {value:g}" for name, value in own.items())
    changed = f"<div>Other than in the preset: {figures}.</div>" if own else ""
    return (
        f'<div style="padding:4px 10px;font-size:12px;line-height:1.5"><div>{story}</div>{changed}'
        '<div style="opacity:0.7">A change starts the scenario again: biases are drawn once for a run.</div></div>'
    )
