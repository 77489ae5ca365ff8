"""Pulls: a damped spring from a point of a link to a place in the world, as long as somebody holds it."""

import math
from dataclasses import dataclass

import numpy as np

from surefoot.errors import InvalidInput

STIFFNESS_N_PER_M = 300.0  # some 25 cm sideways are more than one foot can hold
DAMPING_NS_PER_M = 60.0  # with the least mass of a link still far from what a millisecond can carry
LARGEST_N = 250.0  # a strong hand; the spring gives way there
_FARTHEST_M = 5.0  # a hand further from the middle of the world holds nothing


@dataclass(frozen=True, kw_only=True)
class Pull:
    """A hand on a link. Validated in ``__post_init__`` (InvalidInput).

    Attributes:
        link: which link is held.
        point: where it is held (3,), in the link's axes from the link's origin [m].
        target: where the hand is (3,) in world [m].
        until_s: a hand that nobody confirms lets go then [s]: its browser is gone, or the run was taken back to here.
    """

    link: str
    point: tuple[float, float, float]
    target: tuple[float, float, float]
    until_s: float = math.inf

    def __post_init__(self) -> None:
        """Refuse what is no place."""
        for name in ("point", "target"):
            place = getattr(self, name)
            good = len(place) == 3 and all(isinstance(x, int | float) and abs(x) <= _FARTHEST_M for x in place)
            if not good:  # NaN too
                raise InvalidInput(f"pull.{name}", place, "is no place near the robot", ["three numbers, -5 to 5 m"])

    def force(self, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        """Force (3,) in world [N] on the held point: towards the hand, damped, never more than ``LARGEST_N``.

        Args:
            position: of the held point (3,) in world [m].
            velocity: of the same (3,) [m/s].
        """
        wanted = STIFFNESS_N_PER_M * (np.array(self.target) - position) - DAMPING_NS_PER_M * velocity
        size = float(np.linalg.norm(wanted))
        return wanted * (LARGEST_N / size) if size > LARGEST_N else wanted
