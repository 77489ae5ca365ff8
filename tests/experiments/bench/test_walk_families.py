"""Families in which the robot steps: what they are, what a seed draws, when a walk counts as survived."""

import dataclasses
import math
import tomllib

import numpy as np
import pytest
from scipy.optimize import linprog

from surefoot.experiments.bench.bench import BenchRequest, plan_bench, run_bench
from surefoot.experiments.bench.cell_runner import run_cell
from surefoot.experiments.bench.cells import Case, Cell
from surefoot.experiments.bench.families import FAMILIES, cases
from surefoot.experiments.bench.report import bench_page, read_bench
from surefoot.experiments.bench.share_table import ENDINGS_TITLE, TITLE, walks_completed
from surefoot.experiments.bench.shares import endings, shares
from surefoot.experiments.bench.statistics import wilson_interval
from surefoot.experiments.bench.store import read_table
from surefoot.experiments.bench.variations import LEDGE_M, SIZES, varied
from surefoot.experiments.bench.walk_families import GROUND_BY_SEED, WALK_FAMILIES, walk_table
from surefoot.experiments.bench.walk_pushes import PUSHES_TITLE
from surefoot.experiments.runs.run import run
from surefoot.experiments.runs.walk_tally import STANDS_S
from surefoot.experiments.scenario.bounds import push_bound, step_impulse, walking_bound
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.references import feet_at_start, planned_footsteps
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.experiments.scenario.scenario_text import scenario_text
from surefoot.experiments.scenario.uneven_ground import build_terrain
from surefoot.gait.emergency_step import LANDING_S, REACH_AHEAD_M, REACH_ASIDE_M
from surefoot.gait.footsteps import AHEAD_M, ASIDE_M, feet_now
from surefoot.gait.walk import FIRST_SHIFT_S, LAST_SHIFT_S
from surefoot.simulation.falls import FALL_CAUSES

PUSH = {"direction_deg": 90.0, "impulse_ns": 0.0, "start_s": 0.9, "duration_s": 0.1}
SHORT = walk_table(2, 0.1, 0.6, pushes=[PUSH])


def short_walk(**changes):
    case = Case(
        family="walk-push",
        name="two steps",
        table={**SHORT, **changes},
        knob="pushes.0.impulse_ns",
        unit="N s",
        levels=(1.0, 400.0),
    )
    return Cell(case=case, label="two-part", controller="two-part", every_level=True)


@pytest.fixture(scope="module")
def walked():
    return run_cell(short_walk())


def terrain(case):
    scenario = scenario_from_table(case.table_at(case.levels[-1]))
    return build_terrain(
        scenario.robot_description(),
        feet_at_start(scenario),
        planned_footsteps(scenario),
        tiles=scenario.ground.tiles,
        ledges=scenario.ledges,
        stones=scenario.stones_under_steps,
    )


@pytest.mark.parametrize("quick", [True, False])
def test_every_case_is_a_scenario_file_at_every_level(quick):
    found = cases(["walk"], quick=quick)
    assert {case.family for case in found} == set(WALK_FAMILIES)
    assert len({(case.family, case.name) for case in found}) == len(found)
    for case in found:
        assert list(case.levels) == sorted(set(case.levels))
        for level in (case.levels[0], case.levels[-1]):
            table = case.table_at(level)
            assert scenario_from_table(table) == scenario_from_table(tomllib.loads(scenario_text(table, "a\nb")))


def test_only_who_asks_gets_them():
    assert {case.family for case in cases(quick=True)} == set(FAMILIES)
    assert {case.family for case in cases(["walk-flat", "tilt"], quick=True)} == {"walk-flat", "tilt"}


def test_a_bench_of_those_that_stand_says_nothing_of_walks():
    bench = plan_bench(BenchRequest(quick=True, families=("slope",)))
    assert bench.manifest()["variation"] == SIZES
    assert not any("walk" in what for what in bench.manifest()["survived"])


@pytest.mark.parametrize("family", GROUND_BY_SEED)
def test_each_seed_is_other_ground(family):
    case = cases([family], quick=True)[0]
    grounds = [terrain(varied(case, seed)) for seed in (0, 3, 3, 4)]
    assert grounds[1] == grounds[2]
    assert grounds[0] != grounds[1] != grounds[3] != grounds[0]


def test_a_ledge_moves_by_half_a_step_at_most_and_never_below_a_foot():
    for case in cases(["walk-ledge"]):
        moved = [varied(case, seed).table["ledges"][0]["x_m"] for seed in range(1, 30)]
        assert 0.5 * LEDGE_M < max(abs(x - case.table["ledges"][0]["x_m"]) for x in moved) <= LEDGE_M
        for seed in range(1, 30):
            terrain(varied(case, seed))  # refuses a ledge below a foot


def test_the_stone_lies_below_the_foot_that_steps_and_clear_of_it_before():
    for case in cases(["step-onto-stone"]):
        for seed in (0, 1, 2, 3):
            scenario = scenario_from_table(varied(case, seed).table_at(case.levels[-1]))
            sole = scenario.robot_description().feet[0].sole
            stone = np.array((scenario.stones[0].x_m, scenario.stones[0].y_m))  # from the left ankle's point
            left = feet_at_start(scenario)[0].point
            landed = planned_footsteps(scenario)[0].point - left
            assert sole.signed_margin(stone - landed) > -SIZES["place_m"]
            assert stone[0] - 0.5 * scenario.stones[0].size_m[0] > sole.vertices[:, 0].max() + 0.005


def test_a_walk_survives_when_it_is_completed(walked):
    low, high = walked
    assert low["survived"] and low["outcome"] == "stands"
    assert low["steps_made"] == low["steps_planned"] == 2.0
    assert high["outcome"] == "falls" and high["fall_cause"] in FALL_CAUSES
    assert high["steps_made"] < 2.0
    assert low["threshold"] == 1.0
    assert low["bound_1_ns"] == high["bound_1_ns"] > 0.0  # nothing has been felt of the push when it begins
    assert high["eta_1"] == pytest.approx(400.0 * low["eta_1"])
    summary = run(scenario_from_table(tomllib.loads(low["scenario"])), "two-part").summary
    assert summary["walk_completed"] and summary["steps_made"] == 2


def test_a_walk_that_falls_says_what_came_first(walked):
    low, high = walked
    summary = run(scenario_from_table(tomllib.loads(high["scenario"])), "two-part").summary
    assert high["first_cause"] == summary["fall_first_cause"]
    assert high["first_cause_time_s"] == summary["fall_first_cause_time_s"] <= high["fall_time_s"]
    assert low["first_cause"] == "" and math.isnan(low["first_cause_time_s"])
    assert high["ankle_stop_s"] >= high["ankle_stop_before_s"] >= 0.0
    assert math.isnan(low["ankle_stop_before_s"])


def test_a_walk_that_has_not_stood_long_enough_is_not_survived():
    walk = SHORT["reference"]
    walks_s = walk["start_s"] + FIRST_SHIFT_S + walk["steps"] * walk["step_period_s"] + LAST_SHIFT_S
    cell = short_walk(duration_s=walks_s + 0.5 * STANDS_S)
    row = run_cell(dataclasses.replace(cell, case=dataclasses.replace(cell.case, levels=(1.0,))))[0]
    assert (row["outcome"], row["survived"], row["fall_cause"]) == ("unsettled", False, "")


def test_the_share_of_the_seeds_has_wilsons_interval():
    row = {"family": "walk-stones", "case": "a", "controller": "c", "unit": "m", "outcome": "falls", "fall_cause": ""}
    rows = [
        {**row, "seed": seed, "level": 0.02, "survived": seed < 7, "fall_cause": "" if seed < 7 else "trunk_tilt"}
        for seed in range(10)
    ]
    rows[9] |= {"outcome": "unsettled", "fall_cause": ""}
    rows.append({**rows[0], "level": 0.03})  # not of every seed
    (share,) = shares(rows)
    assert (share.completed, share.seeds) == (7, 10)
    assert share.interval == wilson_interval(7, 10)
    assert share.ended == {"trunk_tilt": 2, "unsettled": 1}
    (of_family,) = endings(rows)
    assert (of_family.runs, of_family.ended) == (11, {"trunk_tilt": 2, "unsettled": 1})
    (near_copies,) = shares([{**row, "family": "walk-flat"} for row in rows])
    assert near_copies.interval == wilson_interval(0.7, 1)
    for drawn in ({"tilt_error_p99_deg": 0.1}, {"other_plant": 1.0}):  # noise, errors of the model
        (trials,) = shares([{**row, "family": "walk-flat", **drawn} for row in rows])
        assert trials.interval == wilson_interval(7, 10)
    assert shares([{**row, "family": "stone"} for row in rows]) == []
    text = "\n".join(walks_completed([dataclasses.asdict(share)]))
    assert "| walk-stones | a | c | 20.0 mm | 7/10 [0.40, 0.89] | trunk_tilt 2, unsettled 1 |" in text


def test_walks_resume_beside_what_stands_and_are_reported(tiny, walked, tmp_path):
    standing = dataclasses.replace(tiny.tiny_bench().cells[0], label="two-part")
    seeds = [dataclasses.replace(short_walk(), seed=seed) for seed in (0, 1)]
    bench = dataclasses.replace(tiny.tiny_bench(), cells=(standing, *seeds))
    asked = []

    def task(cell):
        asked.append(cell.key)
        if cell.key == standing.key:
            return run_cell(cell)
        return [{**row, "seed": cell.seed, "cell": cell.key} for row in walked]

    run_bench(dataclasses.replace(bench, cells=bench.cells[:2]), tmp_path, workers=1, task=task)
    table = run_bench(bench, tmp_path, workers=1, task=task)
    first = table.read_bytes()
    assert asked == [cell.key for cell in bench.cells]
    run_bench(bench, tmp_path, workers=1, task=task)
    assert len(asked) == 3 and table.read_bytes() == first
    rows = read_table(tmp_path)
    assert math.isnan(rows[0]["steps_made"]) and rows[-2]["steps_made"] == 2.0
    page = bench_page(*read_bench(tmp_path))
    assert all(f"## {title}" in page for title in (TITLE, PUSHES_TITLE, ENDINGS_TITLE))
    assert f"| two steps | two-part | 1.0 | {walked[0]['bound_1_ns']:.1f} | {walked[0]['eta_1']:.2f} |" in page


def most_one_step_can_catch(scenario, stance):
    """J_cap1 of one who stands, by ``most_caught``."""
    robot, bound, push = scenario.robot_description(), push_bound(scenario), scenario.pushes[0]
    rest = bound.com - feet_at_start(scenario)[stance].point
    reach = (REACH_AHEAD_M, REACH_ASIDE_M)
    return most_caught(robot, stance, reach, rest, bound.direction, bound.omega, bound.mass_kg, push, LANDING_S)


def most_caught(robot, stance, reach, capture, direction, omega, mass_kg, push, landing_s):
    """The same by a linear programme: 300 moments of a pendulum, its ZMP free in the sole, a foot free in its reach."""
    moments = 300
    dt, side = landing_s / moments, 1.0 if stance == 1 else -1.0
    grows = math.exp(omega * dt)
    sole, other = (robot.feet[i].sole.vertices for i in (stance, 1 - stance))
    places = np.array([(ahead, side * aside) for ahead in reach[0] for aside in reach[1]])
    landed = np.vstack([sole, *(other + place for place in places)])
    # unknown: impulse, weights of the sole's corners at each moment, weights of the corners of all soles at the end
    corners, unknown = len(sole), 1 + moments * len(sole) + len(landed)
    way = np.zeros((2, unknown))
    for i in range(moments):
        way *= grows
        way[:, 1 + i * corners : 1 + (i + 1) * corners] = (1.0 - grows) * sole.T
        acts = min(max(push.duration_s / dt - i, 0.0), 1.0)  # share of the moment: the end may lie within one
        # a constant force, which moves the point of no motion
        way[:, 0] += (grows - 1.0) * acts / push.duration_s / (mass_kg * omega**2) * direction
    way[:, -len(landed) :] -= landed.T
    sums = np.zeros((moments + 1, unknown))
    for i in range(moments):
        sums[i, 1 + i * corners : 1 + (i + 1) * corners] = 1.0
    sums[-1, -len(landed) :] = 1.0
    wanted = np.concatenate((-(grows**moments) * capture, np.ones(moments + 1)))
    found = linprog(-np.eye(unknown)[0], A_eq=np.vstack((way, sums)), b_eq=wanted)
    return found.x[0] if found.success else 0.0


def test_the_bound_of_a_push_in_a_walk_is_that_of_a_linear_programme():
    """In single support, 0.1 s after the first lift-off, so that the push is over when the foot lands."""
    scenario = scenario_from_table({**SHORT, "duration_s": 0.92})
    simulation = build_simulation(scenario, "two-part", rows=scenario.ticks).simulation
    results = [simulation.tick() for _ in range(scenario.ticks)]
    watch, result, push = simulation.walk_watch, results[-1], scenario.pushes[0]
    swinging, terms = simulation.gait.swinging, result.terms
    foot = feet_now(simulation.robot, terms)[1 - swinging]
    height = terms.position_com_in_world[2] - result.balance.origin[2]
    omega, mass_kg = math.sqrt(9.81 / height), simulation.robot.mass_kg
    here, axes = foot.axes.T @ (result.capture - foot.point), foot.axes
    for direction in np.array([(1.0, 0.0), (0.0, 1.0), (0.6, -0.8), (-1.0, 0.0)]):
        bound = walking_bound(watch, result, mass_kg, direction, push.duration_s)
        at = (1 - swinging, (AHEAD_M, ASIDE_M), here, axes.T @ direction, omega, mass_kg, push, bound.landing_s)
        assert 0.2 < bound.landing_s < 0.48
        assert bound.impulse_ns == pytest.approx(most_caught(simulation.robot, *at), rel=1e-3)


@pytest.mark.parametrize("case", cases(["step-push"])[1::3], ids=lambda case: case.name)
def test_the_one_step_bound_is_that_of_a_linear_programme(case):
    scenario = scenario_from_table(case.table_at(1.0))
    options = [most_one_step_can_catch(scenario, i) for i in scenario.support.stance]
    assert scenario.pushes[0].impulse_ns == pytest.approx(step_impulse(scenario), rel=1e-6)
    assert step_impulse(scenario) == pytest.approx(max(*options, push_bound(scenario).impulse_ns), rel=1e-4)


def test_a_push_beyond_the_soles_is_caught_with_steps():
    case = next(case for case in cases(["step-push"]) if case.name == "two feet, forward")
    case = dataclasses.replace(case, levels=(0.6, 2.0))
    caught, lost = run_cell(Cell(case=case, label="two-part", controller="two-part", every_level=True))
    assert caught["survived"] and caught["steps_made"] >= 2.0
    assert caught["eta_1"] == pytest.approx(0.6)
    assert caught["impulse_ns"] > push_bound(scenario_from_table(case.table_at(0.6))).impulse_ns
    assert lost["fall_cause"] in FALL_CAUSES
    (first, _) = shares([caught, lost])
    text = "\n".join(walks_completed([dataclasses.asdict(first)]))
    assert f"0.600 J/J_cap1 of {caught['bound_1_ns']:.1f} N s" in text
    assert f"standing after {LANDING_S:g} s" in text


def test_the_slopes_rise_and_turn_as_they_are_called():
    """Height of the ground half a metre ahead and to the left; heading and place after all turns of 10 degrees."""
    rises = {}
    for case in cases(["walk-slope"]):
        scenario = scenario_from_table(case.table_at(5.0))
        slope, direction = math.radians(scenario.ground.slope_deg), math.radians(scenario.ground.direction_deg)
        rises[case.name] = [round(math.tan(slope) * math.cos(direction - at), 6) for at in (0.0, math.pi / 2)]
    steep = round(math.tan(math.radians(5.0)), 6)
    assert rises == {"up": [steep, 0.0], "down": [-steep, 0.0], "across, the left higher": [0.0, steep]}
    for case in cases(["walk-turn"]):
        last = planned_footsteps(scenario_from_table(case.table_at(10.0)))[-2:]
        assert [math.degrees(step.yaw_rad) for step in last] == pytest.approx([110.0 * case.sign] * 2)
        start = feet_at_start(scenario_from_table(case.table_at(10.0)))
        middle = 0.5 * (start[0].point + start[1].point)
        assert 0.5 * (last[0].point + last[1].point) == pytest.approx(middle, abs=1e-9)
