"""What sets the robot of a run apart from the one its controller counts on: what it knows, its motors, its model."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any, TypeVar

from surefoot.dashboard.messages.playback_commands import ChangeSensing
from surefoot.estimation.registry import TRUTH
from surefoot.estimation.settings import EstimatorSettings
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.field_metadata import from_mapping
from surefoot.simulation.model_error import ModelErrorSettings
from surefoot.simulation.motors import MotorSettings
from surefoot.simulation.sensors.settings import SensorSettings

PresetSettings = SensorSettings | MotorSettings | ModelErrorSettings
_Settings = TypeVar("_Settings", SensorSettings, MotorSettings, ModelErrorSettings)
_NOT_OF_A_PRESET = ("preset", "seed", "imu_body")


@dataclass(frozen=True, kw_only=True)
class Sensing:
    """Sensors, estimator, motors and errors of the model of a run; constant while it goes on.

    Attributes:
        sensors: how good they are.
        estimation: who reads them; ``TRUTH``: nobody does.
        motors: how good they are.
        model_error: how far the plant is from the nominal robot.
        control_delay_s: from the controller to the motors [s].
    """

    sensors: SensorSettings = field(default_factory=SensorSettings)
    estimation: EstimatorSettings = field(default_factory=EstimatorSettings)
    motors: MotorSettings = field(default_factory=MotorSettings)
    model_error: ModelErrorSettings = field(default_factory=ModelErrorSettings)
    control_delay_s: float = 0.0

    @property
    def estimator(self) -> str:
        """Name of the estimator."""
        return self.estimation.kind

    @property
    def estimating(self) -> bool:
        """Whether controller and gait get what an estimator believes, and not the true state."""
        return self.estimator != TRUTH

    def changed(self, command: ChangeSensing) -> "Sensing":
        """Others, as the command says. Raises InvalidInput."""
        delay_s = self.control_delay_s if command.control_delay_s is None else command.control_delay_s
        return Sensing(
            sensors=_changed(self.sensors, command.sensors, "sensors"),
            estimation=replace(self.estimation, kind=command.estimator or self.estimator),
            motors=_changed(self.motors, command.motors, "motors"),
            model_error=_changed(self.model_error, command.model_error, "model_error"),
            control_delay_s=delay_s,
        )

    def in_words(self) -> str:
        """For a line of the log: motors and model only where they are not perfect."""
        parts = [f"{_words('sensors', self.sensors)}, seed {self.sensors.seed}", f"estimator {self.estimator}"]
        if self.motors != MotorSettings():
            parts.append(_words("motors", self.motors))
        if self.control_delay_s > 0.0:
            parts.append(f"torques {1e3 * self.control_delay_s:g} ms late")
        if self.model_error.any or self.model_error.friction > 0.0:
            parts.append(f"{_words('model error', self.model_error)}, seed {self.model_error.seed}")
        return "; ".join(parts)


def own_figures(settings: PresetSettings) -> Mapping[str, float]:
    """What is not as the preset has it: field -> value."""
    usual = type(settings)(preset=settings.preset)
    names = [item.name for item in fields(settings) if item.name not in _NOT_OF_A_PRESET]
    return {name: getattr(settings, name) for name in names if getattr(settings, name) != getattr(usual, name)}


def _changed(now: _Settings, changes: Mapping[str, Any], table: str) -> _Settings:
    names = [item.name for item in fields(now)]
    kept = [name for name in ("seed", "imu_body") if name in names] if "preset" in changes else names
    return from_mapping(type(now), {**{name: getattr(now, name) for name in kept}, **changes}, table)


def _words(what: str, settings: PresetSettings) -> str:
    own = "".join(f", {name} = {value:g}" for name, value in own_figures(settings).items())
    return f"{what} {settings.preset}{own}"


PERFECT_SENSING = Sensing()


def sensing_of(scenario: Scenario) -> Sensing:
    """What a scenario says."""
    return Sensing(
        sensors=scenario.sensors,
        estimation=scenario.estimator,
        motors=scenario.motors,
        model_error=scenario.model_error,
        control_delay_s=scenario.physics.control_delay_s,
    )


def with_sensing(scenario: Scenario, sensing: Sensing) -> Scenario:
    """The scenario with all of it as said. Raises InvalidInput: a delay out of range."""
    return replace(
        scenario,
        sensors=sensing.sensors,
        estimator=sensing.estimation,
        motors=sensing.motors,
        model_error=sensing.model_error,
        physics=replace(scenario.physics, control_delay_s=sensing.control_delay_s),
    )
