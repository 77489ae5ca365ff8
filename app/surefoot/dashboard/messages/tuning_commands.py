"""Commands about controller and settings; ``commands`` offers them with all others."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from surefoot.dashboard.messages.command_base import ControlCommand


@dataclass(frozen=True)
class SetController(ControlCommand):
    """Hand over to the controller of that name; its torques fade in over 50 ms."""

    name: str


@dataclass(frozen=True)
class ChangeSettings(ControlCommand):
    """Change fields of ``ControllerSettings``; they stay changed until ``ResetSettings``.

    Attributes:
        changes: field -> value.
        drag_id: number of the slider's drag that this belongs to: all of one are undone together; 0 for none.
    """

    changes: Mapping[str, Any]
    drag_id: int = 0


@dataclass(frozen=True)
class ResetSettings(ControlCommand):
    """Back to the settings of scenario and controller."""


@dataclass(frozen=True)
class UndoSettings(ControlCommand):
    """Take the last change of controller and settings back."""


@dataclass(frozen=True)
class RedoSettings(ControlCommand):
    """Make the change that was undone last again."""


@dataclass(frozen=True, kw_only=True)
class UseSettings(ControlCommand):
    """Take over a whole set of settings.

    Attributes:
        settings: field -> value; what is not named is as scenario and controller have it.
        label: where it comes from, for the log.
        controller: who is to have them; empty for the one active.
    """

    settings: Mapping[str, Any]
    label: str
    controller: str = ""
