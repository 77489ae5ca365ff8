"""Tiles, ledges, stones below steps and footsteps of one's own: what comes of each, and what is refused."""

import json
import math
import tomllib

import numpy as np
import pytest

from surefoot.control.registry import controller_named
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.saved_run import describe_run, scenario_of
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.reference_spec import WALKING_GAINS
from surefoot.experiments.scenario.references import feet_at_start, planned_footsteps
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, scenario_from_table
from surefoot.experiments.scenario.scenario_text import scenario_text
from surefoot.gait.swing_foot import SwingFoot
from surefoot.gait.walk import Phase
from surefoot.simulation.terrain import Terrain

WALK = {"robot": "bip", "support": "double", "duration_s": 1.0, "reference": {"kind": "walk"}}
AHEAD = [{"foot": "left", "x_m": 0.15, "y_m": 0.11}, {"foot": "right", "x_m": 0.15, "y_m": -0.11}]


def walk(**tables) -> Scenario:
    return scenario_from_table({**WALK, **tables})


def terrain_of(scenario: Scenario) -> Terrain:
    return build_simulation(scenario, "two-part", rows=1).simulation.plant.terrain


def footprints(scenario: Scenario, steps) -> list[np.ndarray]:
    """Corners (4, 2) in world of a sole per step."""
    robot = scenario.robot_description()
    return [step.point + robot.feet[step.foot].sole.vertices @ step.axes.T for step in steps]


def test_tiles_lie_around_the_whole_way_and_are_level_where_the_robot_starts():
    scenario = walk(ground={"tiles": {"size_m": 0.1, "amplitude_m": 0.03, "seed": 4}})
    terrain = terrain_of(scenario)
    tops = np.array([block.top_m for block in terrain.blocks])
    assert terrain.depth_m == 0.03
    assert -0.03 <= tops.min() < -0.028 and 0.028 < tops.max() <= 0.03
    for sole in footprints(scenario, feet_at_start(scenario)):
        assert {terrain.height_at(x, y) for x, y in sole} == {0.0}
    for sole in footprints(scenario, planned_footsteps(scenario)):
        assert all(any(block.covers(x, y) for block in terrain.blocks) for x, y in sole)


def test_a_seed_makes_the_same_tiles_and_another_seed_others():
    one, same, other = (terrain_of(walk(ground={"tiles": {"seed": seed}})) for seed in (1, 1, 2))
    assert one == same != other


def test_ledges_add_up_from_where_the_robot_stands():
    ledges = [{"x_m": 1.0, "height_m": -0.06}, {"x_m": 0.5, "height_m": 0.02}, {"x_m": -0.7, "height_m": 0.03}]
    terrain = terrain_of(walk(ledges=ledges))
    heights = [terrain.height_at(x, 0.3) for x in (-1.0, -0.5, 0.0, 0.45, 0.55, 0.95, 1.05, 20.0)]
    assert heights == pytest.approx([-0.03, 0.0, 0.0, 0.0, 0.02, 0.02, -0.04, -0.04])


@pytest.mark.parametrize("seed", [0, 7])
def test_a_stone_lies_below_each_footprint_and_none_below_the_feet_at_the_start(seed):
    scenario = walk(stones_under_steps={"height_m": 0.02, "size_m": 0.04, "seed": seed})
    steps, stones = planned_footsteps(scenario), terrain_of(scenario).blocks
    assert len(stones) == len(steps)
    robot = scenario.robot_description()
    for step, stone in zip(steps, stones, strict=True):
        place = step.axes.T @ (np.array((stone.x_m, stone.y_m)) - step.point)
        sole = robot.feet[step.foot].sole.vertices
        assert (place >= sole.min(axis=0)).all() and (place <= sole.max(axis=0)).all()
        assert (stone.length_m, stone.width_m, stone.top_m) == (0.04, 0.04, 0.02)
    start = footprints(scenario, feet_at_start(scenario))
    assert not any(stone.overlaps(sole.min(axis=0), sole.max(axis=0)) for stone in stones for sole in start)


def test_a_stone_lies_where_it_is_told_in_the_axes_of_the_foot_and_on_what_is_there():
    stones = {"height_m": 0.01, "offset_x_m": 0.1, "offset_y_m": -0.03}
    turned = [{"foot": "left", "x_m": 0.2, "y_m": 0.15, "yaw_deg": 90.0}]
    stairs = [{"x_m": 0.18, "height_m": 0.02}]
    *_, stone = terrain_of(walk(footsteps=turned, stones_under_steps=stones, ledges=stairs)).blocks
    assert (stone.x_m, stone.y_m, stone.top_m) == pytest.approx((0.2 + 0.03, 0.15 + 0.1, 0.03))


def test_a_place_of_a_stone_in_both_axes_below_the_start_has_no_stone():
    on_the_spot = [{"foot": "left", "x_m": 0.0, "y_m": 0.11}]
    stones = {"height_m": 0.01, "offset_x_m": 0.0, "offset_y_m": 0.0}
    assert terrain_of(walk(footsteps=on_the_spot, stones_under_steps=stones)) == Terrain()


REFUSED = {
    "ground.tiles.size_m": {"ground": {"tiles": {"size_m": 0.0}}},
    "ground.tiles.colour": {"ground": {"tiles": {"colour": 1}}},
    "ground.tiles": {"ground": {"tiles": 3}},
    "ledges.0.height_m": {"ledges": [{"height_m": math.nan}]},
    "ledges.1.x_m": {"ledges": [{"x_m": 0.5}, {"x_m": 0.1}]},
    "ledges": {"ledges": [{"x_m": 0.5}], "ground": {"tiles": {}}},
    "stones_under_steps.offset_x_m": {"stones_under_steps": {"offset_x_m": "left"}},
    "stones_under_steps.seed": {"stones_under_steps": {"seed": 1.5}},
    "stones_under_steps": {"stones_under_steps": [1]},
    "footsteps.0.foot": {"footsteps": [{"foot": "middle"}]},
    "footsteps.1.y_m": {"footsteps": [AHEAD[0], {**AHEAD[1], "y_m": 0.05}]},  # onto the other foot
    "footsteps.0.x_m": {"footsteps": [{**AHEAD[0], "x_m": 0.9}]},
    "reference.steps": {"footsteps": AHEAD, "reference": {"kind": "walk", "steps": 4}},
    "footsteps,": {"footsteps": AHEAD, "reference": {"kind": "hold"}},
    "stones_under_steps.height_m": {"stones_under_steps": {"height_m": 0.01}, "reference": {}},
}  # fmt: skip


@pytest.mark.parametrize("field", REFUSED)
def test_what_makes_no_sense_is_refused_by_name(field):
    with pytest.raises(InvalidInput) as caught:
        build_simulation(walk(**REFUSED[field]), "two-part", rows=1)
    assert caught.value.field == field.strip(",")
    assert caught.value.reason


def test_a_scenario_with_all_of_it_reads_the_same_from_a_file_and_from_a_manifest():
    table = {
        **WALK,
        "ground": {"slope_deg": 2.0, "tiles": {"size_m": 0.12, "amplitude_m": 0.01, "seed": 3}},
        "footsteps": AHEAD,
        "stones_under_steps": {"height_m": 0.015, "offset_y_m": 0.02},
    }
    scenario = scenario_from_table(table)
    assert scenario_from_table(tomllib.loads(scenario_text(table))) == scenario
    simulation = build_simulation(scenario, "two-part", rows=1).simulation
    manifest = describe_run(simulation, scenario, "two-part", controller_named("two-part").settings({}))
    assert scenario_of(json.loads(json.dumps(manifest))) == scenario


def _left_over(step_m: float, early_m: float) -> float:
    """What is left of a step when the foot is so far above where it expects the ground, on its way down [m]."""
    swing = SwingFoot(np.zeros(3), np.eye(3), np.array((step_m, 0.0, 0.0)), np.eye(3), 0.05, 0.8 * 0.6)
    times = np.linspace(0.24, 0.48, 500)
    landing = next(swing.at(t) for t in times if swing.at(t).position[2] <= early_m)
    return step_m - float(landing.position[0])


def test_footsteps_are_walked_up_a_ledge():
    changes = {"reference.step_period_s": 0.6, "ledges.0.x_m": 0.2, "ledges.0.height_m": 0.03}
    for i, (foot, y) in enumerate((("left", 0.12), ("right", -0.1))):
        changes |= {f"footsteps.{i}.foot": foot, f"footsteps.{i}.x_m": 0.4, f"footsteps.{i}.y_m": y}
    simulation = build_simulation(load_scenario("walk_flat", changes), "two-part", rows=1).simulation
    for _ in range(3_000):
        simulation.tick()
    assert simulation.gait.phase is Phase.STANDING
    early = 0.4 - _left_over(step_m=0.4, early_m=0.03)  # only the right foot knows of the ledge
    places = ((early, 0.12), (0.4, -0.1))
    for now, foot, place in zip(simulation.plant.feet(), simulation.robot.feet, places, strict=True):
        x, y, height = now.position_ankle - foot.ankle_height_m * now.rotation[:, 2]
        assert height == pytest.approx(0.03, abs=0.002)
        assert (x, y) == pytest.approx(place, abs=0.015)


@pytest.mark.parametrize("said", [{}, {"foot_stiffness": 300.0}])
def test_a_walk_has_gains_to_walk_with_where_the_scenario_says_none(said):
    scenario = walk(controller=said)
    assert scenario.controller == {**WALKING_GAINS, **said}
    assert scenario_from_table({**WALK, "controller": dict(scenario.controller)}) == scenario
    assert scenario_from_table({**WALK, "reference": {}, "controller": said}).controller == said
