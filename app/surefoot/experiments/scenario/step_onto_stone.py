"""The scene of the paper's introduction: a foot is set on a stone, and the other foot takes off.

The scene itself is the shipped scenario ``step_onto_stone``; here is where its stone may lie.
"""

import tomllib
from functools import lru_cache
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.other_robot import in_proportion_to
from surefoot.experiments.scenario.references import feet_at_start, planned_footsteps
from surefoot.experiments.scenario.scenario import load_scenario, set_in_table, shipped_scenarios
from surefoot.experiments.scenario.sole_places import sole_places
from surefoot.robot.feet import Support

SCENE = "step_onto_stone"
PLACES = ("outer", "toe", "heel", "inner")  # of the stone below the sole
NO_STONE = "none"  # a place too: it lies beside the way
_ASIDE_M = 1.0  # so far left of the start


def stone_changes(place: str, height_m: float, robot: str | None = None) -> tuple[tuple[str, Any], ...]:
    """What sets the scene apart from the shipped scenario: dotted path and value.

    Args:
        place: one of ``PLACES``: where the stone's centre is below the left sole once it has landed as planned; or
            ``NO_STONE``.
        height_m: of the stone [m].
        robot: who steps, if not the shipped scenario's; the scene is in proportion to it.

    Raises:
        InvalidInput: no such place.
    """
    changes = () if robot is None else (("robot", robot),)
    if place == NO_STONE:
        return (*changes, ("stones.0.y_m", _ASIDE_M))
    if place not in PLACES:
        raise InvalidInput("place", place, "no such place of a stone", (*PLACES, NO_STONE))
    x, y = _centre(place, robot)
    return (*changes, ("stones.0.x_m", x), ("stones.0.y_m", y), ("stones.0.height_m", height_m))


def scene_table(place: str, height_m: float, robot: str | None = None) -> dict[str, Any]:
    """The scene as a parsed scenario file. Arguments and errors: as of ``stone_changes``."""
    table = tomllib.loads(shipped_scenarios()[SCENE].read_text(encoding="utf-8"))
    if robot is not None and robot != table["robot"]:
        table = in_proportion_to(table, robot)
    for path, value in stone_changes(place, height_m, robot):
        set_in_table(table, path, value)
    return table


@lru_cache(maxsize=2 * len(PLACES))
def _centre(place: str, robot: str | None) -> tuple[float, float]:
    """Centre of the stone (x, y) [m] from the point below the left ankle at the start."""
    scene = load_scenario(SCENE, {} if robot is None else {"robot": robot}, robot_files=True)
    way = planned_footsteps(scene)[0].point - feet_at_start(scene)[0].point
    x, y = sole_places(scene.robot, Support.LEFT)[place]
    return round(float(way[0]) + x, 4), round(float(way[1]) + y, 4)
