"""What a robot gets to know its state by: its sensors, and the estimator that reads them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from surefoot.estimation.registry import TRUTH
from surefoot.estimation.settings import EstimatorSettings
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.field_metadata import from_mapping
from surefoot.simulation.sensors.settings import SensorSettings

_NOT_OF_A_PRESET = ("preset", "seed", "imu_body")


@dataclass(frozen=True, kw_only=True)
class Sensing:
    """Sensors and estimator of a run; constant while it goes on.

    Attributes:
        sensors: how good they are.
        estimator: name of the one that reads them; ``TRUTH``: nobody does.
    """

    sensors: SensorSettings = field(default_factory=SensorSettings)
    estimator: str = TRUTH

    @property
    def estimating(self) -> bool:
        """Whether controller and gait get what an estimator believes, and not the true state."""
        return self.estimator != TRUTH

    @property
    def own_figures(self) -> Mapping[str, float]:
        """What of the sensors is not as their preset has it."""
        usual = SensorSettings(preset=self.sensors.preset)
        names = [item.name for item in fields(SensorSettings) if item.name not in _NOT_OF_A_PRESET]
        return {
            name: getattr(self.sensors, name) for name in names if getattr(self.sensors, name) != getattr(usual, name)
        }

    def changed(self, sensors: Mapping[str, Any], estimator: str = "") -> "Sensing":
        """Others, see ``ChangeSensing``. Raises InvalidInput."""
        now = self.sensors
        kept: dict[str, Any] = {"seed": now.seed, "imu_body": now.imu_body}
        if "preset" not in sensors:
            kept = {item.name: getattr(now, item.name) for item in fields(SensorSettings)}
        return Sensing(
            sensors=from_mapping(SensorSettings, {**kept, **sensors}, "sensors"),
            estimator=EstimatorSettings(kind=estimator or self.estimator).kind,
        )

    def in_words(self) -> str:
        """For a line of the log."""
        own = "".join(f", {name} = {value:g}" for name, value in self.own_figures.items())
        return f"sensors {self.sensors.preset}{own}, seed {self.sensors.seed}; estimator {self.estimator}"


PERFECT_SENSING = Sensing()


def sensing_of(scenario: Scenario) -> Sensing:
    """What a scenario says."""
    return Sensing(sensors=scenario.sensors, estimator=scenario.estimator.kind)


def with_sensing(scenario: Scenario, sensing: Sensing) -> Scenario:
    """The scenario with other sensors and another estimator."""
    return replace(scenario, sensors=sensing.sensors, estimator=replace(scenario.estimator, kind=sensing.estimator))
