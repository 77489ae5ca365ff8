"""What sets a scenario apart from the shipped one of its name is enough to make it again."""

from dataclasses import replace

import pytest

from surefoot.experiments.scenario.changes import changes_of
from surefoot.experiments.scenario.scenario import load_scenario, shipped_scenarios
from surefoot.robot.feet import Support

CHANGES = {
    "nothing": ("walk_flat", {}),
    "a walk": ("walk_flat", {"reference.steps": 4, "reference.step_length_m": 0.1 + 0.2,
                             "reference.first_foot": "right"}),
    "tiles where there were none": ("walk_flat", {"ground.tiles.amplitude_m": 0.02, "ground.tiles.size_m": 0.1,
                                                  "ground.tiles.seed": 0}),
    "other tiles": ("walk_tiles", {"ground.tiles.amplitude_m": 0.03}),
    "slope and stones": ("walk_flat", {"ground.slope_deg": 5.0, "stones_under_steps.height_m": 0.02,
                                       "stones_under_steps.offset_x_m": 0.0}),
    "an entry of a list": ("push_left", {"pushes.0.impulse_ns": 3.0}),
    "a step that is wanted": ("stand_left", {"reference.step_when_needed": True}),
    "not below any table": ("stand_left", {"com_height_m": 0.85}),
}  # fmt: skip


@pytest.mark.parametrize("what", CHANGES)
def test_what_was_changed_comes_back(what):
    name, changes = CHANGES[what]
    assert changes_of(load_scenario(name, changes)) == changes


def test_a_new_entry_of_a_list_comes_back():
    stone = {"x_m": 0.3, "height_m": 0.01, "size_m": [0.1, 0.08]}
    scenario = load_scenario("stand_left", {f"stones.0.{key}": value for key, value in stone.items()})
    changes = changes_of(scenario)
    assert changes is not None
    assert load_scenario("stand_left", changes) == scenario


@pytest.mark.parametrize("name", shipped_scenarios())
def test_nothing_sets_a_shipped_scenario_apart_but_what_is_left_out(name):
    assert changes_of(load_scenario(name, {"duration_s": 0.25, "controller.com_stiffness": 77.0})) == {}


def test_what_no_change_leads_to_has_none():
    assert changes_of(replace(load_scenario("stand_left"), name="my own")) is None
    two = load_scenario("step_onto_stone")
    assert changes_of(replace(two, footsteps=two.footsteps[:1])) is None
    assert changes_of(load_scenario("stand_left", {"support": "double"})) == {"support": Support.DOUBLE}
