"""External forces: pushes, constant for a while, and pulls, a damped spring for as long as somebody holds on."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.field_metadata import check_fields, number
from surefoot.simulation.physics import TIMESTEP_S

STIFFNESS_N_PER_M = 300.0  # some 25 cm sideways are more than one foot can hold
DAMPING_NS_PER_M = 60.0  # with the least mass of a link still far from what a millisecond can carry
LARGEST_N = 250.0  # a strong hand; the spring gives way there
_FARTHEST_M = 50.0  # a hand further from the middle of the world holds nothing; a walk may lead so far


@dataclass(frozen=True, kw_only=True)
class Pull:
    """A hand on a link. Validated in ``__post_init__`` (InvalidInput).

    Attributes:
        link: which link is held.
        point: where it is held (3,), in the link's axes from the link's origin [m].
        target: where the hand is (3,) in world [m].
        strength: of spring, damper and their limit, as a ratio to those for Bip: that of the robot's weight.
        until_s: a hand that nobody confirms lets go then [s]: its browser is gone, or the run was taken back to here.
    """

    link: str
    point: tuple[float, float, float]
    target: tuple[float, float, float]
    strength: float = 1.0
    until_s: float = math.inf

    def __post_init__(self) -> None:
        """Refuse what is no place."""
        for name in ("point", "target"):
            place = getattr(self, name)
            good = len(place) == 3 and all(isinstance(x, int | float) and abs(x) <= _FARTHEST_M for x in place)
            if not good:  # NaN too
                valid = [f"three numbers, -{_FARTHEST_M:g} to {_FARTHEST_M:g} m"]
                raise InvalidInput(f"pull.{name}", place, "is no place near the robot", valid)

    def force(self, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        """Force (3,) in world [N] on the held point: towards the hand, damped, at most ``strength * LARGEST_N``.

        Args:
            position: of the held point (3,) in world [m].
            velocity: of the same (3,) [m/s].
        """
        wanted = STIFFNESS_N_PER_M * (np.array(self.target) - position) - DAMPING_NS_PER_M * velocity
        size = float(np.linalg.norm(wanted))
        return self.strength * (wanted * (LARGEST_N / size) if size > LARGEST_N else wanted)


WHOLE_ROBOT = "com"
_START_SLACK_TICKS = 5e-4  # times of ticks are sums of milliseconds: their rounding puts no start a tick off
_WHOLE_TICKS = 1e-9  # a duration as near to whole ticks is whole: 0.003 s are three, not 3.0000000000000004


@dataclass(frozen=True, kw_only=True)
class Push:
    """A horizontal push of constant force impulse / duration. Validated in ``__post_init__`` (InvalidInput).

    It begins with the first tick that is not before its start. A last tick that it covers in part gets that part of the
    force, so that the force summed over the ticks is the impulse whatever the duration.

    Attributes:
        link: a link (force at its centre of mass) or ``com`` (force through the whole robot's centre of mass).
        direction_deg: 0 = forward, 90 = to the left.
        impulse_ns: [N s].
        start_s, duration_s: [s].
    """

    link: str = WHOLE_ROBOT
    direction_deg: float = number(0.0, -360.0, 360.0, "deg", "0 = forward, 90 = to the left", step=5.0)
    impulse_ns: float = number(10.0, 0.0, 500.0, "N s", "impulse: force times duration", step=1.0)
    start_s: float = number(1.0, 0.0, 1e6, "s", "when it starts")
    duration_s: float = number(0.1, 0.001, 10.0, "s", "how long it lasts", step=0.01)

    def __post_init__(self) -> None:
        """Refuse NaN, wrong types and values out of range."""
        check_fields(self, "push")

    @property
    def direction(self) -> np.ndarray:
        """Unit vector (2,) in world."""
        angle = math.radians(self.direction_deg)
        return np.array((math.cos(angle), math.sin(angle)))

    def share_of_tick(self, time_s: float) -> float:
        """Part of the tick that begins at a time [s] which it covers: 0 before and after it, 1 within."""
        since_start = round(time_s / TIMESTEP_S) - math.ceil(self.start_s / TIMESTEP_S - _START_SLACK_TICKS)
        return min(1.0, max(0.0, self._ticks - since_start)) if since_start >= 0 else 0.0

    def active_at(self, time_s: float) -> bool:
        """Whether it pushes in the tick that begins at a time [s]."""
        return self.share_of_tick(time_s) > 0.0

    def over_at(self, time_s: float) -> bool:
        """Whether neither the tick that begins at a time [s] nor a later one is pushed."""
        return time_s > self.start_s and not self.active_at(time_s)

    def force_at(self, time_s: float) -> np.ndarray:
        """Force (3,) in world [N] of the tick that begins at a time [s]."""
        return self.share_of_tick(time_s) * self.force()

    @property
    def _ticks(self) -> float:
        ticks = self.duration_s / TIMESTEP_S
        whole = round(ticks)
        return float(whole) if abs(ticks - whole) < _WHOLE_TICKS else ticks

    def force(self) -> np.ndarray:
        """Force (3,) in world [N] of a tick that it covers whole."""
        size, (x, y) = self.impulse_ns / self.duration_s, self.direction
        return np.array((size * x, size * y, 0.0))


class ActingForce(NamedTuple):
    """A force on the robot from outside: force (3,) [N] and the point that it acts on (3,) [m], both in world."""

    force: np.ndarray
    point: np.ndarray


NO_FORCE = ActingForce(np.zeros(3), np.full(3, np.nan))


def sum_of_forces(acting: Sequence[ActingForce]) -> ActingForce:
    """Their sum, at the middle of their points weighted by their sizes; ``NO_FORCE`` where nothing acts."""
    if len(acting) < 2:
        return acting[0] if acting else NO_FORCE
    sizes = [float(np.linalg.norm(one.force)) for one in acting]
    if not sum(sizes) > 0.0:
        return NO_FORCE
    points = np.stack([one.point for one in acting])
    return ActingForce(np.sum([one.force for one in acting], axis=0), np.average(points, axis=0, weights=sizes))
