"""Who takes part: controllers by name, ``+key=value`` for what differs, e.g. ``soft-qp+guard=true``.

A key without a dot is a setting of the controller; one with a dot is of the scenario (``motors.bandwidth_hz=40``).
``preset=robot`` is that preset of sensors, motors and model error, ``estimator=anchor`` what reads the sensors.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from surefoot.control.registry import controller_named, controllers
from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.estimation.registry import TRUTH
from surefoot.experiments.bench.imperfections import IMPERFECT, KIND, preset_changes, unread
from surefoot.experiments.scenario.scenario import parse_change
from surefoot.simulation.presets import PERFECT

OF_SCENARIO = ("physics.", *IMPERFECT)
_PRESET, _ESTIMATOR = "preset", "estimator"


@dataclass(frozen=True)
class BenchEntry:
    """One line of the ranking.

    Attributes:
        label: how tables call it.
        controller: name in the registry.
        changes: settings that differ from the controller's own.
        scenario: what differs in every scenario (dotted path -> value).
    """

    label: str
    controller: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    scenario: Mapping[str, Any] = field(default_factory=dict)

    @property
    def settings(self) -> ControllerSettings:
        """All its settings."""
        return controller_named(self.controller).settings(self.changes)


def bench_entries(
    text: str, changes: Mapping[str, Any], scenario: Mapping[str, Any] | None = None
) -> tuple[BenchEntry, ...]:
    """Those of a comma-separated list (all registered ones for an empty one), each with ``changes`` as well.

    Args:
        text: the list.
        changes: of the settings of all.
        scenario: of the scenarios of all (dotted path -> value).

    Raises:
        InvalidInput: an unknown controller, an unknown setting, a bad value, sensors that nobody reads, or the same
            one twice.
    """
    labels = labels_of(text)
    found = [_entry(label, changes, scenario or {}) for label in labels]
    for label in labels:
        if labels.count(label) > 1:
            raise InvalidInput("--controllers", label, "is named twice")
    return tuple(found)


def labels_of(text: str) -> Sequence[str]:
    """The parts of a comma-separated list; all registered controllers for an empty one."""
    return [part.strip() for part in text.split(",")] if text.strip() else list(controllers())


def with_presets(text: str, presets: Sequence[str], estimator: str) -> str:
    """Every controller of a list under every preset, as such a list. Raises InvalidInput.

    Args:
        text: comma-separated; empty for all registered ones.
        presets: of sensors, motors and model error; ``perfect`` is the controller as it is named.
        estimator: what reads the sensors.
    """
    for preset in presets:
        preset_changes(preset, estimator)
    return ",".join(
        label if preset == PERFECT else f"{label}+{_PRESET}={preset}+{_ESTIMATOR}={estimator}"
        for label in labels_of(text)
        for preset in presets
    )


def _entry(label: str, changes: Mapping[str, Any], scenario: Mapping[str, Any]) -> BenchEntry:
    name, *parts = label.split("+")
    own = dict(parse_change(part) for part in parts)
    estimator, preset = own.pop(_ESTIMATOR, None), own.pop(_PRESET, None)
    of_preset = {} if preset is None else dict(preset_changes(preset, estimator or TRUTH))
    of_preset.pop(KIND, None)  # said by the label, or by what is changed for all
    if estimator is not None:
        of_preset[KIND] = estimator
    of_scenario = {path: value for path, value in own.items() if "." in path}
    for path in of_scenario:
        if not path.startswith(OF_SCENARIO):
            raise InvalidInput("--controllers", label, f"a bench does not change {path}", OF_SCENARIO)
    all_of_scenario = {**scenario, **of_preset, **of_scenario}
    if paths := unread(all_of_scenario):
        reason = "nobody reads the sensors: the controller gets the true state; say which estimator"
        raise InvalidInput(paths[0], all_of_scenario[paths[0]], reason, [f"{KIND}=anchor"])
    settings = {path: value for path, value in own.items() if "." not in path}
    entry = BenchEntry(label, name, {**changes, **settings}, all_of_scenario)
    _ = entry.settings  # refuses what is unknown, before anything runs
    return entry
