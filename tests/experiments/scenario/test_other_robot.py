"""A scenario that was written for Bip, run with another robot: everything in it is in proportion."""

import math

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.changes import changes_of
from surefoot.experiments.scenario.other_robot import in_proportion_to
from surefoot.experiments.scenario.proportions import proportions_of
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, scenario_from_table, shipped_scenarios
from surefoot.robot.description import load_robot

OTHER = "offset"
RATIOS = proportions_of(OTHER)
THREE_DIGITS = 5e-3  # of a number that is rounded to three digits


def close(value):
    return pytest.approx(value, rel=THREE_DIGITS)


def test_steps_go_with_the_leg_and_periods_with_the_root_of_the_height():
    bip, other = (load_scenario("walk_flat", {"robot": robot}).reference for robot in ("bip", OTHER))
    assert other.step_length_m == close(0.2 * load_robot(OTHER).sizes.leg)
    assert other.step_period_s == close(0.8 * math.sqrt(load_robot(OTHER).sizes.com_height))
    assert other.step_width_m == close(2.0 * load_robot(OTHER).sizes.foot_spread_m)
    assert other.lift_m == close(bip.lift_m * RATIOS.leg)
    assert other.steps == bip.steps == 10


def test_stones_tiles_and_pushes_follow_the_robot():
    stones = load_scenario("walk_stones", {"robot": OTHER}).stones_under_steps
    assert (stones.height_m, stones.size_m) == (close(0.02 * RATIOS.leg), close(0.05 * RATIOS.sole_width))
    tiles = load_scenario("walk_tiles", {"robot": OTHER}).ground.tiles
    assert (tiles.size_m, tiles.amplitude_m) == (close(0.1 * RATIOS.sole_length), close(0.02 * RATIOS.leg))
    before, after = (load_scenario("push_left", {"robot": robot}).pushes[0] for robot in ("bip", OTHER))
    assert after.impulse_ns == close(before.impulse_ns * RATIOS.impulse(before.direction_deg))
    assert (after.start_s, after.duration_s) == (before.start_s, before.duration_s)
    one, two = (load_scenario("stone_outer_edge", {"robot": robot}).stones[0] for robot in ("bip", OTHER))
    assert (two.x_m, two.y_m) == (close(one.x_m * RATIOS.sole_length), close(one.y_m * RATIOS.sole_width))


def test_what_is_set_is_taken_as_it_is_said():
    changes = {"reference.step_length_m": 0.11, "robot": OTHER}
    assert load_scenario("walk_flat", changes).reference.step_length_m == 0.11


@pytest.mark.parametrize("name", list(shipped_scenarios()))
def test_the_robot_that_it_was_written_for_changes_nothing(name):
    assert load_scenario(name, {"robot": "bip"}) == load_scenario(name)


def test_there_and_back_is_the_same_to_the_digits_kept():
    table = {
        "robot": "bip",
        "support": "double",
        "duration_s": 5.0,
        "reference": {"kind": "walk", "steps": 4, "step_length_m": 0.2, "step_period_s": 0.8},
        "ledges": [{"x_m": 0.7, "height_m": 0.02}],
    }
    again = in_proportion_to(in_proportion_to(table, OTHER), "bip")
    twice = 2.0 * THREE_DIGITS  # rounded on either way
    assert again["reference"]["step_length_m"] == pytest.approx(0.2, rel=twice)
    assert again["reference"]["step_period_s"] == pytest.approx(0.8, rel=twice)
    assert again["ledges"][0] == {"x_m": pytest.approx(0.7, rel=twice), "height_m": pytest.approx(0.02, rel=twice)}
    assert again["robot"] == "bip" and again["duration_s"] == 5.0


def test_values_of_a_wrong_kind_are_told_as_they_are():
    table = {"robot": "bip", "support": "left", "duration_s": 1.0, "reference": "walk", "stones": [3], "pushes": [True]}
    scaled = in_proportion_to(table, OTHER)
    with pytest.raises(InvalidInput) as refusal:
        scenario_from_table(scaled)
    assert refusal.value.field == "reference"


def test_a_walk_for_another_robot_that_says_no_sizes_has_its_own():
    table = {"robot": OTHER, "support": "double", "duration_s": 5.0, "reference": {"kind": "walk"}}
    spec = scenario_from_table(table).reference
    assert spec.step_length_m == close(0.2 * RATIOS.leg) and spec.step_period_s == close(0.8 * RATIOS.time)
    said = scenario_from_table({**table, "reference": {"kind": "walk", "step_length_m": 0.2}}).reference
    assert said.step_length_m == 0.2


def test_footsteps_of_another_robot_still_replace_even_ones():
    steps = [{"foot": "left", "x_m": 0.1, "y_m": 0.1}]
    table = {"robot": OTHER, "support": "double", "duration_s": 5.0, "reference": {"kind": "walk"}, "footsteps": steps}
    assert isinstance(scenario_from_table(table), Scenario)


def test_the_changes_that_lead_from_a_shipped_scenario_lead_there_again():
    scenario = load_scenario("walk_flat", {"robot": OTHER, "reference.lift_m": 0.06})
    changes = changes_of(scenario)
    assert changes == {"robot": OTHER, "reference.lift_m": 0.06}
