"""What is done to the world: stones, pushes, pulls, slope, friction."""

from dataclasses import dataclass

from surefoot.dashboard.messages.command_base import WorldCommand


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
    """Turn the ground to another slope while the robot stands on it.

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
