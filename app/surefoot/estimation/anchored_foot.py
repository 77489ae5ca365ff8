"""A foot that tells where the robot is: by where it was put down, as far as it can be trusted to be there still."""

from collections.abc import Sequence

import numpy as np

from surefoot.dynamics.turns import turn_of, vector_of
from surefoot.estimation.contact import FootContact, FootTrust
from surefoot.geometry.triples import Triple, blend

# Chosen, on Bip with the sensors ``robot``.
# 1/s with which a foot that carries gives way (by a fifth of what two feet disagree by in a step of 0.7 s), and its
# sole (which soft ground turns), and both in the air (at once: 1 over a tick)
SETTLING_RATE, SOLE_SETTLING_RATE, AIR_RATE = 0.3, 1.0, 1000.0
# What is left of a foot at its edge; a sole that turns so fast counts half: on a stone it turns by 0.1 rad/s and more
EDGE_TRUST, TURNING_RAD_S = 0.1, 0.05


class AnchoredFoot:
    """Follows one foot.

    Args:
        contact: says how far it can be trusted.

    Attributes:
        place: its anchor: where the ankle was put down, in world [m].
        hold: from 0 to 1, how much it keeps its anchor.
        turned: rotation vector [rad] from how the sole was put down to how it lies by the believed attitude, world.
    """

    def __init__(self, contact: FootContact):
        self._contact, self._sole, self._air_rate = contact, np.eye(3), 0.0
        self.place: Triple = (0.0, 0.0, 0.0)
        self.turned, self.hold = [0.0, 0.0, 0.0], 1.0

    def put(self, place: Triple, rotation: np.ndarray) -> None:
        """Have it stand with its ankle at a place [m] and turned so: (3, 3) foot axes -> world."""
        self.place, self._sole = place, rotation

    def feel(
        self, wrench: Sequence[float], angular_velocity: Sequence[float], rotation: np.ndarray, step_s: float
    ) -> None:
        """Take in how it presses and turns.

        Args:
            wrench: of the ground about the ankle, 3 + 3 components in foot axes [N], [N m].
            angular_velocity: 3 components, in world [rad/s].
            rotation: (3, 3) foot axes -> world, by the believed attitude.
            step_s: time since the last call.
        """
        self.hold = _hold(self._contact.update(wrench, angular_velocity, step_s))
        self._air_rate = AIR_RATE * (1.0 - self.hold) ** 4
        turned = vector_of(rotation.dot(self._sole.T))
        self.turned = turned.tolist()
        self._sole = turn_of(min(step_s * (SOLE_SETTLING_RATE + self._air_rate), 1.0) * turned).dot(self._sole)

    def settle(self, seen: Triple, step_s: float) -> None:
        """Give way to where it is seen, in world [m]."""
        self.place = blend(self.place, seen, min(step_s * (SETTLING_RATE + self._air_rate), 1.0))


def _hold(trust: FootTrust) -> float:
    rolling = (trust.turning_rad_s / TURNING_RAD_S) ** 2
    return trust.load * (1.0 - (1.0 - EDGE_TRUST) * trust.edge) / (1.0 + rolling)
