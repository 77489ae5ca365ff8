"""The step onto a stone: one scene, of which the bench and the paper's report move the stone."""

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.families import cases
from surefoot.experiments.runs.walk_tally import STANDS_S
from surefoot.experiments.scenario.scenario import load_scenario, scenario_from_table
from surefoot.experiments.scenario.step_onto_stone import NO_STONE, PLACES, SCENE, scene_table, stone_changes
from surefoot.gait.walk import FIRST_SHIFT_S, LAST_SHIFT_S
from surefoot.robot.description import load_robot


@pytest.mark.parametrize("robot", [None, "bip", "offset"])
@pytest.mark.parametrize("place", [*PLACES, NO_STONE])
def test_table_and_changes_are_the_same_scene(place, robot):
    by_table = scenario_from_table(scene_table(place, 0.02, robot), SCENE)
    assert by_table == load_scenario(SCENE, dict(stone_changes(place, 0.02, robot)))


def test_another_robot_s_scene_is_in_proportion_but_for_where_its_own_sole_lands():
    mine = scenario_from_table(scene_table("outer", 0.02, "offset"), SCENE)
    there = load_scenario(SCENE, {"robot": "offset"})
    assert (mine.footsteps, mine.reference) == (there.footsteps, there.reference)
    assert mine.stones[0].size_m == there.stones[0].size_m
    sole = load_robot("offset").feet[0].sole.vertices[:, 1]
    assert 0.0 < mine.stones[0].y_m < sole.max()


def test_the_shipped_stone_lies_below_the_outer_edge():
    shipped = load_scenario(SCENE)
    assert load_scenario(SCENE, dict(stone_changes("outer", shipped.stones[0].height_m))) == shipped


def test_each_place_is_on_its_side_of_the_foot_that_lands():
    scene = load_scenario(SCENE)
    stone = {place: load_scenario(SCENE, dict(stone_changes(place, 0.01))).stones[0] for place in PLACES}
    step = scene.footsteps[0].x_m  # from the left ankle's point at the start to where that foot lands
    assert stone["heel"].x_m < step < stone["toe"].x_m
    assert stone["inner"].y_m < 0.0 < stone["outer"].y_m


def test_without_a_stone_it_lies_where_no_foot_comes():
    aside = load_scenario(SCENE, dict(stone_changes(NO_STONE, 0.01))).stones[0]
    assert aside.y_m - 0.5 * aside.size_m[1] > load_robot("bip").feet[0].sole.vertices[:, 1].max()


def test_a_place_that_there_is_not_is_refused_with_those_that_there_are():
    with pytest.raises(InvalidInput, match="outer, toe, heel, inner, none"):
        stone_changes("arch", 0.01)


def test_there_is_time_to_complete_the_walk_and_the_bench_has_the_same_scene():
    scene = load_scenario(SCENE)
    walk_s = FIRST_SHIFT_S + len(scene.footsteps) * scene.reference.step_period_s + LAST_SHIFT_S
    assert scene.duration_s > scene.reference.start_s + walk_s + STANDS_S + 1.0
    for case in cases(["step-onto-stone"]):
        assert case.table_at(0.02) == scene_table(case.name, 0.02)
