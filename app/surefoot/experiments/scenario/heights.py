"""The posture that a scenario starts from; where there is none, which heights of the CoM would do."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.scenario import Scenario, com_heights_m
from surefoot.robot.feet import Support
from surefoot.simulation.ground import Ground
from surefoot.task.posture import Posture, solve_posture, standing_com_height

_STEP_M = 1e-3


def solve_start(scenario: Scenario, dynamics: DynamicsModel) -> Posture:
    """Joint angles of the start. Raises PostureError with the heights that keep every joint in its range."""
    try:
        return solve_posture(dynamics, start_posture(scenario))
    except PostureError as error:
        heights = heights_in_range(scenario.robot, scenario.support, scenario.ground)
        hint = f"com_height_m from {heights[0]:.3f} to {heights[1]:.3f} m keeps every joint in range" if heights else ""
        raise PostureError(error.reason, error.residual, hint) from None


@lru_cache(maxsize=32)
def heights_in_range(robot: str, support: Support, ground: Ground) -> tuple[float, float] | None:
    """Least and greatest CoM height (in whole millimetres) [m] whose posture has every joint in its range.

    None where not even the usual height has: the ground is too steep.
    """
    scenario = Scenario(robot=robot, support=support, ground=ground)
    dynamics = DynamicsModel(scenario.robot_description())

    def fits(millimetres: int) -> bool:
        try:
            posture = start_posture(replace(scenario, com_height_m=millimetres * _STEP_M))
            return not solve_posture(dynamics, posture).out_of_range
        except PostureError:
            return False

    usual = round(standing_com_height(dynamics.robot) / _STEP_M)
    if not fits(usual):
        return None
    least, greatest = com_heights_m(dynamics.robot)
    low = _last(fits, usual, math.ceil(least / _STEP_M))
    high = _last(fits, usual, math.floor(greatest / _STEP_M))
    return low * _STEP_M, high * _STEP_M


def _last(fits: Callable[[int], bool], good: int, bad: int) -> int:
    """The last whole number that fits on the way from one that does to one that does not."""
    while abs(bad - good) > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if fits(middle) else (good, middle)
    return good
