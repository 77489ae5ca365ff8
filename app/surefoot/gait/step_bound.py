"""J_cap1: the greatest impulse that one emergency step can catch."""

from collections.abc import Sequence

import numpy as np

from surefoot.gait.emergency_step import step_region
from surefoot.gait.footsteps import Footstep
from surefoot.momentum.zmp import capture_impulse
from surefoot.robot.description import RobotDescription


def one_step_impulse(
    robot: RobotDescription,
    stances: Sequence[Footstep],
    capture: np.ndarray,
    direction: np.ndarray,
    *,
    mass_kg: float,
    omega: float,
    duration_s: float,
) -> float:
    """The greatest impulse [N s] of a constant force through G that a step, decided as it begins, can catch.

    Backwards over the landing time, the capture point's way under a constant force is J_cap's (``capture_impulse``)
    with the capture region K_1 in place of the soles. The push must be over when the step lands
    (``emergency_step.landing_time``).

    Args:
        robot: the robot.
        stances: feet that may stand while the other one steps; the best of them counts.
        capture: capture point (2,) in world [m] as the push begins.
        direction: unit vector of the push (2,) in world.
        mass_kg: m.
        omega: natural frequency [rad/s].
        duration_s: T of the push [s].

    Returns:
        0 where no step helps.
    """
    found = [0.0]
    for foot in stances:
        region, here = step_region(robot, foot.foot, omega), (capture - foot.point).dot(foot.axes)
        if region.contains(here):
            found.append(capture_impulse(mass_kg, omega, region, here, direction.dot(foot.axes), duration_s))
    return max(found)
