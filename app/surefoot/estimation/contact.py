"""How far a foot can be trusted to stand still: by its load, its centre of pressure and the turning of its sole."""

import math
from collections.abc import Sequence

from surefoot.geometry.smooth_step import smooth_step
from surefoot.record import record
from surefoot.robot.feet import Foot

UNLOADED, LOADED = 0.04, 0.15  # shares of the weight: a foot with less carries nothing, one with more stands
EDGE_M = 0.012  # a centre of pressure nearer to the sole's edge may be a sole that tips
TURNING_LAG_S = 0.03  # what is known of a sole's turning comes from noisy joint rates


@record
class FootTrust:
    """What is believed of one contact.

    Attributes:
        load: 0 where the foot carries nothing, 1 where it stands; smooth between.
        edge: 0 where the centre of pressure is well inside the sole, 1 where it is at its edge; smooth between.
        turning_rad_s: speed at which the sole turns, beyond what noise explains.
    """

    load: float
    edge: float
    turning_rad_s: float


class FootContact:
    """Follows one foot; it is asked in every tick and remembers how its sole turned.

    Args:
        foot: the foot.
        weight_n: of the robot.
        turning_noise: standard deviation of the angular velocities that it is told [rad/s].
    """

    def __init__(self, foot: Foot, weight_n: float, turning_noise: float):
        self._height, self._weight = foot.ankle_height_m, weight_n
        self._noise = 9.0 * turning_noise**2 * 0.5  # three sigma of each axis, after the filter times its share
        self._edges = [(*n, c) for n, c in zip(foot.sole.normals.tolist(), foot.sole.offsets.tolist(), strict=True)]
        self._turning = (0.0, 0.0, 0.0)

    def update(self, wrench: Sequence[float], angular_velocity: Sequence[float], step_s: float) -> FootTrust:
        """Trust now.

        Args:
            wrench: 3 components of force [N] and 3 of moment about the ankle [N m] of the ground, foot axes.
            angular_velocity: 3 components, of the foot in the world [rad/s], any axes that do not change.
            step_s: time since the last call.
        """
        share = step_s / (TURNING_LAG_S + step_s)
        (x, y, z), (now_x, now_y, now_z) = self._turning, angular_velocity
        x, y, z = x + share * (now_x - x), y + share * (now_y - y), z + share * (now_z - z)
        self._turning = (x, y, z)
        turning = math.sqrt(max(0.0, x * x + y * y + z * z - self._noise * share))
        fx, fy, fz, mx, my, _ = wrench
        load = smooth_step((fz / self._weight - UNLOADED) / (LOADED - UNLOADED))
        if load == 0.0:
            return FootTrust(0.0, 1.0, turning)
        height = self._height  # moment about the ankle of a force at (x, y, -height) of the foot
        x, y = -(my + height * fx) / fz, (mx - height * fy) / fz
        margin = min([offset - nx * x - ny * y for nx, ny, offset in self._edges])  # a list is faster than a generator
        return FootTrust(load, 1.0 - smooth_step(margin / EDGE_M), turning)
