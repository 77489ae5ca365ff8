"""What a user can ask of the session: frozen objects, put into a queue by the page and obeyed between two ticks."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from surefoot.dashboard.messages.command_base import Command, PlaybackCommand, TwinCommand, WorldCommand
from surefoot.dashboard.messages.tuning_commands import (
    ChangeSettings,
    RedoSettings,
    ResetSettings,
    SetController,
    UndoSettings,
    UseSettings,
)

__all__ = [
    "FASTEST", "MOST_STEP_TICKS", "SLOWEST", "ChangeSettings", "ChangeTwinSettings", "ClearStones", "Command", "GoLive",
    "HoldLink", "LetGo", "LoadScenario", "MoveStone", "OpenLink", "Pause", "PlaceStone", "PlaceStoneAtSole", "Play",
    "PushNow", "RedoSettings", "RemoveLastStone", "RemoveStone", "RepeatDisturbances", "Reset", "ResetSettings", "Seek",
    "SetController", "SetFriction", "SetSpeed", "SetTwinController", "StartTwin", "Step", "StoneKind", "StopTwin",
    "TiltGround", "TogglePlay", "UndoSettings", "UseSettings", "newest_seeks",
]  # fmt: skip
SLOWEST, FASTEST = 0.1, 2.0
MOST_STEP_TICKS = 1000


@dataclass(frozen=True, kw_only=True)
class StoneKind(WorldCommand):
    """What a stone is like.

    Attributes:
        height_m: of its highest point above the ground.
        size_m: length and width.
        shape: one out of ``SHAPES``.
        slope_deg, slope_direction_deg: of a wedge: slope of its top, and where it rises to (0 = forward, 90 = left).
    """

    height_m: float
    size_m: float
    shape: str = "box"
    slope_deg: float = 10.0
    slope_direction_deg: float = 90.0


@dataclass(frozen=True, kw_only=True)
class PlaceStone(StoneKind):
    """Put a stone into the world: it rises where a sole is above it and drops elsewhere.

    Attributes:
        x_m, y_m: centre in world.
    """

    x_m: float
    y_m: float


@dataclass(frozen=True, kw_only=True)
class PlaceStoneAtSole(StoneKind):
    """Put a stone under a place of the sole that stands (the left one when both do).

    Attributes:
        place: one out of ``SOLE_PLACES``.
    """

    place: str


@dataclass(frozen=True, kw_only=True)
class MoveStone(WorldCommand):
    """Shift a stone, by its number: it rises again where a sole is above it and lies there at once elsewhere."""

    number: int
    x_m: float
    y_m: float


@dataclass(frozen=True)
class RemoveStone(WorldCommand):
    """Take one stone away, by its number."""

    number: int


@dataclass(frozen=True)
class RemoveLastStone(WorldCommand):
    """Take the newest stone away."""


@dataclass(frozen=True)
class ClearStones(WorldCommand):
    """Take all stones away."""


@dataclass(frozen=True, kw_only=True)
class PushNow(WorldCommand):
    """Push at once.

    Attributes:
        link: a link, or ``com``.
        direction_deg: 0 = forward, 90 = to the left.
        impulse_ns: [N s].
        duration_s: [s].
    """

    direction_deg: float
    impulse_ns: float
    duration_s: float = 0.1
    link: str = "com"


@dataclass(frozen=True, kw_only=True)
class HoldLink(WorldCommand):
    """Pull a link by a spring, until ``LetGo``; sent again, the hand has moved.

    Attributes:
        client_id: the client that pulls.
        link: which link.
        point: where it is held (3,), in the link's axes.
        target: where the hand is (3,) in world.
    """

    client_id: str
    link: str
    point: tuple[float, float, float]
    target: tuple[float, float, float]


@dataclass(frozen=True)
class LetGo(WorldCommand):
    """End the pull of that client."""

    client_id: str


@dataclass(frozen=True, kw_only=True)
class TiltGround(WorldCommand):
    """Turn the ground to another slope while Bip stands on it.

    Attributes:
        slope_deg: in the end.
        direction_deg: where it rises to: 0 = forward, 90 = to the left.
        duration_s: how long that takes.
    """

    slope_deg: float
    direction_deg: float
    duration_s: float = 1.0


@dataclass(frozen=True)
class SetFriction(WorldCommand):
    """Friction coefficient of ground and stones."""

    friction: float


@dataclass(frozen=True)
class SetSpeed(PlaybackCommand):
    """Simulated seconds per second, 0.1 to 2."""

    speed: float


@dataclass(frozen=True)
class Play(PlaybackCommand):
    """Run."""


@dataclass(frozen=True)
class Pause(PlaybackCommand):
    """Stand still."""


@dataclass(frozen=True)
class TogglePlay(PlaybackCommand):
    """Run if paused, pause if running."""


@dataclass(frozen=True)
class Step(PlaybackCommand):
    """Pause, and advance by some milliseconds; go back when they are negative."""

    ticks: int = 1

    @property
    def ahead(self) -> int:
        """Ticks that are made."""
        return min(max(self.ticks, 0), MOST_STEP_TICKS)


@dataclass(frozen=True)
class Reset(PlaybackCommand):
    """Back to the start of the scenario; controller, settings and friction stay. Runs if ``play``."""

    play: bool = True


@dataclass(frozen=True)
class LoadScenario(PlaybackCommand):
    """Start another scenario, a shipped one by name or a file; controller and changed settings stay."""

    name: str


@dataclass(frozen=True)
class OpenLink(PlaybackCommand):
    """Start what the query of a link asks for: scenario, controller and changed values."""

    query: str


@dataclass(frozen=True)
class Seek(PlaybackCommand):
    """Pause, and go to an instant of the last 30 s.

    Attributes:
        time_s: simulated, since the start of the run.
    """

    time_s: float


@dataclass(frozen=True)
class GoLive(PlaybackCommand):
    """Go to the newest instant and run."""


@dataclass(frozen=True)
class RepeatDisturbances(PlaybackCommand):
    """Whether disturbances come again after a fork."""

    repeat: bool


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


def newest_seeks(commands: Iterable[Command]) -> list[Command]:
    """Commands in order, without every ``Seek`` that another one follows: a dragged slider sends more than needed."""
    found: list[Command] = []
    for command in commands:
        if isinstance(command, Seek) and found and isinstance(found[-1], Seek):
            found.pop()
        found.append(command)
    return found
