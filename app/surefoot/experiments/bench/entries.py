"""Who takes part: controllers by name, ``+key=value`` for a setting that differs, e.g. ``soft-qp+guard=true``."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from surefoot.control.registry import controller_named, controllers
from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.scenario import parse_change


@dataclass(frozen=True)
class BenchEntry:
    """One line of the ranking.

    Attributes:
        label: how tables call it.
        controller: name in the registry.
        changes: settings that differ from the controller's own.
    """

    label: str
    controller: str
    changes: Mapping[str, Any] = field(default_factory=dict)

    @property
    def settings(self) -> ControllerSettings:
        """All its settings."""
        return controller_named(self.controller).settings(self.changes)


def bench_entries(text: str, changes: Mapping[str, Any]) -> tuple[BenchEntry, ...]:
    """Those of a comma-separated list (all registered ones for an empty one), each with ``changes`` as well.

    Raises:
        InvalidInput: an unknown controller, an unknown setting, a bad value, or the same one twice.
    """
    labels: Sequence[str] = [part.strip() for part in text.split(",")] if text.strip() else list(controllers())
    found = []
    for label in labels:
        name, *settings = label.split("+")
        entry = BenchEntry(label, name, {**changes, **dict(parse_change(setting) for setting in settings)})
        _ = entry.settings  # refuses what is unknown, before anything runs
        found.append(entry)
    for label in labels:
        if labels.count(label) > 1:
            raise InvalidInput("--controllers", label, "is named twice")
    return tuple(found)
