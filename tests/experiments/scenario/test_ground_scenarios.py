"""Slopes, tilting ground, drops and lying stones, as scenario files ask for them and as runs end."""

import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, scenario_from_table, shipped_scenarios
from surefoot.simulation.ground import Ground
from surefoot.simulation.stones import Stone

BASE = {"robot": "bip", "support": "left", "duration_s": 0.4}
STONE = {"x_m": 0.05, "y_m": 0.07, "height_m": 0.008, "lying": True}


def table(**keys):
    return scenario_from_table({**BASE, **keys})


def test_a_file_says_how_the_ground_lies_and_from_where_the_robot_is_released(tmp_path):
    file = tmp_path / "slope.toml"
    file.write_text(
        'robot = "bip"\nsupport = "left"\nduration_s = 1.0\ndrop_height_m = 0.02\n'
        "[ground]\nslope_deg = 5.0\ndirection_deg = 90.0\ntilt_start_s = 0.5\ntilt_duration_s = 1.0\n"
        "[[stones]]\nx_m = 0.05\nlying = true\n"
    )
    scenario = load_scenario(file)
    assert scenario.ground == Ground(slope_deg=5.0, direction_deg=90.0, tilt_start_s=0.5, tilt_duration_s=1.0)
    assert scenario.drop_height_m == 0.02
    assert scenario.stones == (Stone(x_m=0.05, lying=True),)
    assert load_scenario(file, {"ground.slope_deg": 7}).ground.slope_deg == 7.0


def test_level_ground_and_no_drop_are_the_default():
    scenario = table()
    assert scenario.ground == Ground()
    assert scenario.drop_height_m == 0.0
    for path in shipped_scenarios().values():
        assert load_scenario(path).ground.slope_deg == 0.0, path.stem


@pytest.mark.parametrize(("keys", "field"), [
    ({"ground": {"slope_deg": 30.0}}, "ground.slope_deg"),
    ({"ground": {"steepness": 3.0}}, "ground.steepness"),
    ({"ground": {"tilt_start_s": 1.0}}, "ground.tilt_start_s"),
    ({"ground": 5.0}, "ground"),
    ({"drop_height_m": 0.2}, "drop_height_m"),
    ({"drop_height_m": "high"}, "drop_height_m"),
    ({"stones": [{"lying": "yes"}]}, "stones.0.lying"),
    ({"stones": [{"lying": True, "rise_start_s": 1.0}]}, "stones.0.lying"),
])  # fmt: skip
def test_a_mistake_is_named_by_its_key(keys, field):
    with pytest.raises(InvalidInput) as refusal:
        table(**keys)
    assert refusal.value.field == field


def test_a_stone_that_would_start_inside_a_foot_is_refused():
    with pytest.raises(InvalidInput, match=r"stones\.0\.height_m.*inside a foot.*drop_height_m"):
        run(table(stones=[STONE]), "two-part")
    run(table(stones=[{**STONE, "y_m": 0.3}], duration_s=0.002), "two-part")  # beside it: no objection


def test_the_robot_lands_on_a_lying_stone_and_its_sole_rolls():
    result = run(table(stones=[STONE], drop_height_m=0.012, duration_s=0.6), "two-part")
    assert not result.summary["fell"]
    force = result.recorder.column("force_left_n")
    assert (force[:15] == 0.0).all()
    assert force[-1] == pytest.approx(1030.0, rel=0.05)
    assert result.recorder.column("angle_left_ankle_frontal_rad")[-1] != pytest.approx(0.155, abs=0.02)


@pytest.mark.parametrize("controller", ["two-part", "soft-qp", "optimization"])
@pytest.mark.parametrize("ground", [
    {"slope_deg": 5.0, "direction_deg": 0.0},
    {"slope_deg": 5.0, "direction_deg": -90.0},
    {"slope_deg": 5.0, "direction_deg": 180.0, "tilt_start_s": 0.05, "tilt_duration_s": 0.3},
])  # fmt: skip
def test_every_controller_stands_on_a_gentle_slope(ground, controller):
    summary = run(table(ground=ground), controller).summary
    assert not summary["fell"]
    assert summary["com_error_max_m"] < 0.003


def test_a_posture_that_needs_more_ankle_than_there_is_gets_a_warning():
    summary = run(table(ground={"slope_deg": 3.0, "direction_deg": 90.0}, duration_s=0.01), "two-part").summary
    assert any("left_ankle_frontal" in warning for warning in summary["warnings"])


def test_a_run_on_tilting_ground_repeats_to_the_bit():
    scenario = table(ground={"slope_deg": 6.0, "direction_deg": 20.0, "tilt_duration_s": 0.2}, stones=[
        {"x_m": 0.05, "y_m": 0.02, "height_m": 0.005, "rise_start_s": 0.1, "rise_duration_s": 0.1}
    ])  # fmt: skip
    first, second = (run(scenario, "two-part").recorder.table() for _ in range(2))
    assert np.array_equal(first, second, equal_nan=True)


@pytest.mark.parametrize("name", ["stand_left", "stone_outer_edge"])
def test_naming_level_ground_changes_no_bit(name):
    """The ground's code path is there for all runs: told that it is level, or told nothing, is the same."""
    plain = load_scenario(name, {"duration_s": 0.8})
    stated = load_scenario(name, {"duration_s": 0.8, "ground.slope_deg": 0.0, "drop_height_m": 0.0})
    tables = [run(scenario, "two-part").recorder.table() for scenario in (plain, stated)]
    assert np.array_equal(*tables, equal_nan=True)


def test_scenarios_made_in_code_take_the_same_fields():
    assert Scenario(ground=Ground(slope_deg=2.0), drop_height_m=0.01).ground.slope_deg == 2.0
