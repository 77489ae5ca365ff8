"""The CoM's acceleration: the capture point is led back to its plan, the height kept above the soles."""

import math

import numpy as np

from surefoot.gait.scale import BIP, GaitScale
from surefoot.momentum.zmp import capture_point, natural_frequency

CAPTURE_GAIN = 3.0  # 1/s: how fast the capture point comes back to its plan
HEIGHT_STIFFNESS = 150.0  # 1/s2; found by trial down a ledge of 60 mm, not searched for further
REACH_RESERVE_M = 0.012  # so much the knees can be stretched from the height that G has on two feet
_SOLES_S = 0.08  # the height follows the soles' with this time constant: a sole that lands higher is no jolt


class CoMFeedback:
    """G'' that lets the capture point follow its plan.

    With xi' = omega (xi - p) the ZMP p = p_plan + (1 + k / omega) (xi - xi_plan) gives (xi - xi_plan)' = -k (xi -
    xi_plan), and a pendulum of height h with that ZMP has G'' = (g + h'') / h (G - p). No position of the CoM is asked
    for: steps may end elsewhere than planned.

    Args:
        height_m: G above the soles [m].
        gravity: g [m/s2].
        stiffness: with which the height is kept [1/s2].
        reserve_m: so much the knee of the hind leg can be stretched [m].
        scale: of the robot, by which the two before are multiplied.

    Attributes:
        omega: natural frequency [rad/s].
        sole_height_m: what the height is counted from [m].
        lowered_m: so much lower G is carried now [m].
    """

    def __init__(
        self,
        height_m: float,
        gravity: float,
        *,
        stiffness: float = HEIGHT_STIFFNESS,
        reserve_m: float = REACH_RESERVE_M,
        scale: GaitScale = BIP,
    ) -> None:
        self.omega = natural_frequency(height_m, gravity)
        self.sole_height_m = self.lowered_m = 0.0
        self._height, self._gravity, self._scale = height_m, gravity, scale
        self._stiffness, self._reserve_m = stiffness * scale.stiffness, reserve_m * scale.length
        self._gain = CAPTURE_GAIN * scale.rate

    def with_others(self, *, stiffness: float, reserve_m: float) -> "CoMFeedback":
        """As it is now, but with other values of these."""
        other = CoMFeedback(self._height, self._gravity, stiffness=stiffness, reserve_m=reserve_m, scale=self._scale)
        other.sole_height_m, other.lowered_m = self.sole_height_m, self.lowered_m
        return other

    @property
    def height_m(self) -> float:
        """Where G should be [m]."""
        return self.sole_height_m + self._height - self.lowered_m

    def follow_soles(self, height_m: float, elapsed_s: float) -> None:
        """What carries the robot now is that high [m]; it was told so ``elapsed_s`` ago [s]."""
        self.sole_height_m += (height_m - self.sole_height_m) * min(1.0, elapsed_s / (_SOLES_S * self._scale.time))

    def lower_for(self, way_m: float) -> None:
        """Carry G so much lower that a leg that reaches so far back is as long as one below G.

        Args:
            way_m: from the foot to below G [m].
        """
        height = self._height
        needed = height - math.sqrt(height**2 - min(way_m, 0.5 * height) ** 2)
        self.lowered_m = max(needed - self._reserve_m, 0.0)

    def acceleration(
        self, com: np.ndarray, velocity: np.ndarray, zmp_planned: np.ndarray, capture_planned: np.ndarray
    ) -> np.ndarray:
        """G'' (3,) [m/s2].

        Args:
            com: G (3,) in world [m].
            velocity: G' (3,) [m/s].
            zmp_planned: (2,) in world [m].
            capture_planned: (2,) in world [m].
        """
        height = float(com[2]) - self.sole_height_m
        missing = self._height - self.lowered_m - height
        up = self._stiffness * missing - 2.0 * math.sqrt(self._stiffness) * float(velocity[2])
        error = capture_point(com, velocity, self.omega) - capture_planned
        zmp = zmp_planned + (1.0 + self._gain / self.omega) * error
        along = (self._gravity + up) / height * (com[:2] - zmp)
        return np.array((float(along[0]), float(along[1]), up))
