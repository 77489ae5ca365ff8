"""What the robot feels of the ground."""

import numpy as np

from surefoot.record import record


@record
class FootSensing:
    """What six-axis load cells between ankle and sole would say.

    Attributes:
        wrenches: (2, 6) left and right: force [N] and moment about the ankle centre [N m] of the ground on the foot,
            foot axes.
    """

    wrenches: np.ndarray

    @property
    def normal_forces(self) -> tuple[float, float]:
        """Force along each sole's normal [N]."""
        return float(self.wrenches[0, 2]), float(self.wrenches[1, 2])


# Both feet loaded well beyond a twentieth of the weight: for computing with a posture that nothing has sensed
FULLY_LOADED = FootSensing(np.full((2, 6), 1e3))
