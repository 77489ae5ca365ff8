"""Kinds of commands: who hears one, and what the history has to know of it."""

from enum import Enum
from typing import ClassVar


class Audience(Enum):
    """Which robot of a twin run hears a command."""

    BOTH = "both"
    FIRST = "first"
    TWIN = "twin"


class Command:
    """What a user can ask of the session."""

    audience: ClassVar[Audience] = Audience.BOTH


class WorldCommand(Command):
    """A disturbance: it is remembered with its tick, and comes again after a fork."""


class ControlCommand(Command):
    """About controller and settings: remembered with its tick, forgotten by an earlier fork."""

    audience = Audience.FIRST


class PlaybackCommand(Command):
    """About what is seen when: pace, past, scenario; never remembered."""


class TwinCommand(Command):
    """About the second robot."""

    audience = Audience.TWIN

    def for_twin(self) -> Command | None:
        """What its own run is asked to do; None where it is about having a twin at all."""
        return None
