"""A second robot beside the first: start and stop it, its controller and its settings."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from surefoot.dashboard.messages.command_base import TwinCommand
from surefoot.dashboard.messages.tuning_commands import ChangeSettings, SetController


@dataclass(frozen=True)
class StartTwin(TwinCommand):
    """Put a second robot beside the first: same scenario, friction and settings, but its own controller and changes.

    Both begin at the start of the scenario, so that nothing but that tells them apart.
    """

    controller: str
    changes: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class StopTwin(TwinCommand):
    """Take the second robot away."""


@dataclass(frozen=True)
class SetTwinController(TwinCommand):
    """Hand the twin over to the controller of that name."""

    name: str

    def for_twin(self) -> SetController:
        """The same, as its own run is told."""
        return SetController(self.name)


@dataclass(frozen=True)
class ChangeTwinSettings(TwinCommand):
    """Change settings of the twin only."""

    changes: Mapping[str, Any]

    def for_twin(self) -> ChangeSettings:
        """The same, as its own run is told."""
        return ChangeSettings(self.changes)
