"""A point of the ground that goes where the robot goes, and stays while it only sways."""

import numpy as np

_FARTHEST_M = 1.0  # a robot farther away has not walked there: it was put there, by a reset or a seek


class Leash:
    """Follows at a distance; near the origin, where every run begins, it stands in the origin.

    Args:
        length_m: how far the robot may go before it follows.
        share: part of the way that it catches up in each update, above 0, at most 1.

    Attributes:
        point: where it is (2,) in world [m].
    """

    def __init__(self, length_m: float, share: float = 1.0) -> None:
        self._length, self._share = length_m, share
        self.point = np.zeros(2)

    def settle(self, robot: np.ndarray) -> None:
        """Go to the robot (2,) [m] at once, or to the origin when it stands near there."""
        self.point = np.zeros(2) if np.linalg.norm(robot) <= self._length else robot.copy()

    def follow(self, robot: np.ndarray) -> None:
        """The robot is there now (2,) [m]."""
        away = robot - self.point
        distance = float(np.linalg.norm(away))
        if distance > _FARTHEST_M:
            self.settle(robot)
        elif distance > self._length:
            self.point = self.point + self._share * (1.0 - self._length / distance) * away
