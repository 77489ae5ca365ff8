"""The ranges that the controllers keep the joints in: the joints' own, but no knee straight."""

from functools import lru_cache

import numpy as np

from surefoot.robot.description import BASE_DOFS, RobotDescription

_KNEE = 3  # its place among the six joints of a leg, from the base down: three of the hip, the knee, two of the ankle
_STRAIGHT_RAD = 0.1  # a knee bent by less counts as straight: chosen, just outside Bip's own range, not searched for


@lru_cache(maxsize=8)
def working_range(robot: RobotDescription) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper ends (n,), (n,) [rad], in the order of the joints.

    At a straight leg H is singular: no joint rate takes G any further from the foot. A knee whose range goes up to
    straight, as of most robots, loses the last 0.1 rad of it (Bip's own ends at 0.11); of a knee that is bent by less
    than 0.2 rad in the nominal posture half the bend is left. With that bound in the contact QP G sinks along the arc
    that the leg allows, before H is singular.
    """
    lower, upper = robot.joint_lower.copy(), robot.joint_upper.copy()
    for (dof, sign), foot in zip(robot.knees, robot.feet, strict=True):
        if dof != foot.leg[_KNEE]:  # the joint that is bent most is none between hip and ankle
            continue
        joint = dof - BASE_DOFS
        least = min(_STRAIGHT_RAD, 0.5 * abs(float(robot.start_angles[joint])))
        if sign > 0.0:
            lower[joint] = max(lower[joint], least)
        else:
            upper[joint] = min(upper[joint], -least)
    lower.flags.writeable = upper.flags.writeable = False
    return lower, upper
