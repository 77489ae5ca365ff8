"""Every case is a scenario file at every level, quick and full; seeds change it a little, the same for everybody."""

import tomllib

import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import BenchRequest, plan_bench
from surefoot.experiments.bench.families import FAMILIES, cases
from surefoot.experiments.bench.variations import PLANT, SIZES, varied, varied_plant
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.experiments.scenario.scenario_text import scenario_text
from surefoot.experiments.scenario.sole_places import sole_places
from surefoot.robot.description import load_robot
from surefoot.robot.feet import Support
from surefoot.simulation.external_forces import WHOLE_ROBOT


@pytest.fixture(scope="module", params=["quick", "full"])
def all_cases(request):
    return cases(quick=request.param == "quick")


def value_at(table, path):
    for part in path.split("."):
        table = table[int(part)] if part.isdecimal() else table[part]
    return table


def test_every_case_is_a_scenario_file_at_every_level(all_cases):
    assert {case.family for case in all_cases} == set(FAMILIES)
    for case in all_cases:
        for level in (case.levels[0], case.levels[-1]):
            table = case.table_at(level)
            assert scenario_from_table(table) == scenario_from_table(tomllib.loads(scenario_text(table, "a\nb")))


def test_names_are_unique_and_levels_grow(all_cases):
    assert len({(case.family, case.name) for case in all_cases}) == len(all_cases)
    for case in all_cases:
        assert list(case.levels) == sorted(set(case.levels))
        weak, strong = (abs(value_at(case.table_at(level), case.knob)) for level in (case.levels[0], case.levels[-1]))
        assert 0.0 < weak < strong


def test_eta_is_for_pushes_through_the_com_on_flat_ground_only(all_cases):
    for case in all_cases:
        scenario = scenario_from_table(case.table_at(case.levels[0]))
        in_eta = case.unit == "J/J_cap"
        assert in_eta == (case.family in ("push", "push-double"))
        if in_eta:
            assert scenario.pushes[0].link == WHOLE_ROBOT
            assert not scenario.stones and scenario.ground.slope_deg == 0.0


def test_a_swings_goal_is_the_largest_whose_capture_point_stays_inside():
    slow, fast = (
        next(case for case in cases(["swing"]) if case.name == name).goal for name in ("inward 1.0 s", "inward 0.3 s")
    )
    assert slow > fast > 0.0


@pytest.mark.parametrize("support", [Support.LEFT, Support.RIGHT])
def test_the_nine_places_lie_under_the_sole_and_outer_is_outward(support):
    places = sole_places("bip", support)
    foot = load_robot("bip").feet[support.reference_foot]
    assert len(places) == 9
    low, high = foot.sole.vertices.min(axis=0), foot.sole.vertices.max(axis=0)
    assert all((low < place).all() and (place < high).all() for place in map(np.array, places.values()))
    assert (places["outer"][1] > 0.0) == (support is Support.LEFT)
    assert places["toe"][0] > 0.0 > places["heel"][0]


def test_seed_zero_is_the_case_itself_and_others_differ_by_little():
    for case in cases(quick=True):
        assert varied(case, 0) is case
        assert varied_plant(case, 0) == {}
        other = varied(case, 3)
        assert other == varied(case, 3)
        assert other.table != case.table
        for key, size in (("x_m", SIZES["place_m"]), ("rise_start_s", SIZES["onset_s"])):
            for stone, moved in zip(case.table.get("stones", ()), other.table.get("stones", ()), strict=True):
                if key in stone:
                    assert 0.0 <= abs(moved[key] - stone[key]) <= size + 5e-5
        plant = varied_plant(case, 3)
        assert PLANT["mass_scale"][0] <= plant["physics.mass_scale"] <= PLANT["mass_scale"][1]


def test_a_seed_is_the_same_for_every_controller():
    bench = plan_bench(BenchRequest(families=("stone",), quick=True, seeds=2, first_seed=4, vary_plant=True))
    for case in {cell.case.name for cell in bench.cells}:
        for seed in (4, 5):
            same = [cell for cell in bench.cells if cell.case.name == case and cell.seed == seed]
            assert len(same) == 4
            assert all(cell.case == same[0].case and cell.changes == same[0].changes for cell in same)


def test_an_unknown_family_is_refused():
    with pytest.raises(InvalidInput, match="no such family"):
        cases(["jumping"])
