"""What the robot is other than its controller counts on: its motors, and errors of the model."""

from collections.abc import Mapping

from surefoot.dashboard.messages.commands import ChangeSensing
from surefoot.dashboard.messages.sensing import Sensing
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.dashboard.panels.panel import PageContext, Panel
from surefoot.dashboard.panels.sensors.figures import Figures
from surefoot.dashboard.panels.sensors.menu import add_menu
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.presets import PRESET_HELP, PRESETS

_DELAY = "control_delay_s"
_MOTORS = {
    "bandwidth_hz": "Torque bandwidth",
    "coulomb_share": "Dry friction",
    "viscous_nms_rad": "Viscous friction",
    "no_load_speed_rad_s": "No-load speed",
}
_MODEL = {
    "mass": "Masses ±",
    "inertia": "Inertias ±",
    "com_m": "Mass centres ±",
    "length": "Lengths ±",
    "sole_m": "Soles ±",
    "friction": "Ground friction ±",
    "seed": "Seed of the model",
}


class PlantPanel(Panel):
    """Menus of presets, which act at once, and figures, which wait for their button.

    Args:
        context: of the page.
    """

    def __init__(self, context: PageContext) -> None:
        gui, self._send, sensing = context.gui, context.send, context.newest().sensing
        self._menus = (
            add_menu(gui, "Motors", PRESETS, sensing.motors.preset, PRESET_HELP, self._take_motors),
            add_menu(gui, "Model error", PRESETS, sensing.model_error.preset, PRESET_HELP, self._take_model),
        )
        self._figures = Figures(
            gui,
            "Figures of motors and model",
            {**_MOTORS, _DELAY: "Torque delay", **_MODEL},
            (sensing.motors, sensing.model_error, PhysicsSettings),
            _values(sensing),
            button="Start with this robot",
            start=self._start,
        )

    def show(self, snapshot: Snapshot) -> None:
        """Take over what is at work."""
        sensing = snapshot.sensing
        for menu, value in zip(self._menus, (sensing.motors.preset, sensing.model_error.preset), strict=True):
            menu.show(value)
        self._figures.show(_values(sensing))

    def _take_motors(self, preset: str) -> None:
        self._send(ChangeSensing(motors={"preset": preset}))

    def _take_model(self, preset: str) -> None:
        self._send(ChangeSensing(model_error={"preset": preset}))

    def _start(self, moved: Mapping[str, float]) -> None:
        motors, model = ({name: moved[name] for name in names if name in moved} for names in (_MOTORS, _MODEL))
        self._send(ChangeSensing(motors=motors, model_error=model, control_delay_s=moved.get(_DELAY)))


def _values(sensing: Sensing) -> dict[str, float]:
    motors = {name: getattr(sensing.motors, name) for name in _MOTORS}
    return motors | {_DELAY: sensing.control_delay_s} | {name: getattr(sensing.model_error, name) for name in _MODEL}
