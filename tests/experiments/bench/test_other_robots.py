"""A bench of another robot: its cases are in proportion, its file decides its cells, and its scenarios name it."""

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from surefoot.cli.bench_tables import print_ranking
from surefoot.cli.main import main
from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import BenchRequest, plan_bench, run_bench
from surefoot.experiments.bench.families import FAMILIES, cases
from surefoot.experiments.bench.report import bench_page, read_bench
from surefoot.experiments.bench.store import read_manifest, read_table
from surefoot.experiments.bench.variations import varied
from surefoot.experiments.bench.walk_families import WALK_FAMILIES
from surefoot.experiments.scenario.bounds import push_bound
from surefoot.experiments.scenario.proportions import proportions_of, scaled
from surefoot.experiments.scenario.robots import sha256_now
from surefoot.experiments.scenario.scenario import load_scenario, scenario_from_table
from surefoot.robot.description import load_robot
from tests.support.small_biped import SPHERE_SOLE, biped, write_small_robot

MADE_UP = "offset"


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    write_small_robot(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def short(folder):
    """A bench of one cell of two levels: a slope, stood on for 50 ms, too short to fall."""
    request = BenchRequest(
        controllers="two-part", families=("slope",), quick=True, levels=(1.0, 2.0), robot="small/robot.toml"
    )
    bench = plan_bench(request)
    cell = bench.cells[0]
    cell = replace(cell, case=replace(cell.case, table={**cell.case.table, "duration_s": 0.05}))
    return replace(bench, cells=(cell,))


def test_bip_is_in_proportion_to_itself():
    ratios = proportions_of("bip")
    assert all(scaled(0.0713, ratio) == 0.0713 for ratio in (ratios.sole_length, ratios.leg, ratios.time))
    assert [ratios.impulse(direction) for direction in (0.0, 45.0, 90.0, 210.0)] == pytest.approx([1.0] * 4, rel=1e-12)


@pytest.mark.parametrize(("direction", "axis"), [(0.0, "sagittal"), (90.0, "lateral")])
def test_impulses_are_in_proportion_to_the_capture_bound(direction, axis):
    """J_cap there and back again, per metre of the sole at its ankle: but for the push's duration it is the ratio."""
    along = np.array((np.cos(np.radians(direction)), np.sin(np.radians(direction))))

    def bound_per_metre(name):
        table = {"robot": name, "support": "left", "duration_s": 1.0}
        pushes = [{"direction_deg": angle, "impulse_ns": 1.0} for angle in (direction, direction + 180.0)]
        bounds = [push_bound(scenario_from_table({**table, "pushes": [push]})).impulse_ns for push in pushes]
        sole = load_robot(name).feet[0].sole
        return sum(bounds) / sum(sole.distance_to_edge(np.zeros(2), way) for way in (along, -along))

    ratios = proportions_of(MADE_UP)
    expected = ratios.impulse(direction) / ratios.along(axis)
    assert bound_per_metre(MADE_UP) / bound_per_metre("bip") == pytest.approx(expected, rel=0.05)


def test_every_case_of_another_robot_is_a_scenario_of_it():
    found = cases([*FAMILIES, *WALK_FAMILIES], quick=True, robot=MADE_UP)
    assert {case.family for case in found} == {*FAMILIES, *WALK_FAMILIES}
    for case in found:
        for level in (case.levels[0], case.levels[-1]):
            assert scenario_from_table(case.table_at(level)).robot == MADE_UP


def test_stones_are_as_large_against_the_sole_as_bips():
    mine, bips = ({case.name: case for case in cases(["stone"], robot=robot)} for robot in (MADE_UP, "bip"))
    soles = [np.ptp(load_robot(robot).feet[0].sole.vertices, axis=0) for robot in (MADE_UP, "bip")]
    for name, case in mine.items():
        pairs = zip((case, bips[name]), soles, strict=True)
        shares = [np.array(one.table["stones"][0]["size_m"]) / sole for one, sole in pairs]
        assert shares[0] == pytest.approx(shares[1], rel=0.01)
        assert case.goal / soles[0][1] == pytest.approx(bips[name].goal / soles[1][1], rel=0.01)
    moved = varied(mine["outer"], 5).table["stones"][0]
    for key, width in (("x_m", soles[0][1]), ("y_m", soles[0][1])):
        assert abs(moved[key] - mine["outer"].table["stones"][0][key]) <= 0.005 * width / 0.18 + 1e-4


def test_another_state_of_its_files_is_another_cell_and_another_place_is_not(folder):
    def keys(robot):
        return [cell.key for cell in plan_bench(BenchRequest(families=("slope",), quick=True, robot=robot)).cells]

    first = keys("small/robot.toml")
    (folder / "small").rename(folder / "moved")
    assert keys("moved/robot.toml") == first
    (folder / "moved" / "small.xml").write_text(biped(sole=SPHERE_SOLE, joint='range="-1.5 1.5" armature="0.02"'))
    (folder / "moved").rename(folder / "other")
    assert not set(keys("other/robot.toml")) & set(first)


def test_the_table_travels_and_its_scenarios_name_the_robot(short, folder, capsys):
    run_bench(short, folder / "out", workers=1)
    rows, manifest = read_table(folder / "out"), read_manifest(folder / "out")
    assert len(rows) == 2 and [row["outcome"] for row in rows] == ["stands"] * 2
    assert manifest["robot"] == {"name": "robot.toml", "sha256": sha256_now("small/robot.toml")}
    assert str(folder) not in json.dumps(manifest) + "".join(row["scenario"] for row in rows)
    main(["bench", "--out", "out", "--replay", "1", "--to", "again.toml"])
    assert tomllib.loads((folder / "again.toml").read_text())["robot"] == str(folder / "small" / "robot.toml")
    scenario = load_scenario("again.toml", robot_files=True)
    assert replace(scenario, name="") == replace(short.cells[0].scenario_at(2.0), name="")
    main(["bench", "--out", "out", "--report"])
    page = capsys.readouterr().out
    assert "--robot small/robot.toml" in page and manifest["robot"]["sha256"][:16] in page


def test_levels_that_are_asked_for_are_played_as_they_are_said(folder):
    """5 mm and 10 mm are metres, whatever the robot: not in proportion to it. So are its goals said: its own."""
    request = BenchRequest(
        controllers="two-part", families=("stone",), quick=True, levels=(0.005, 0.01), robot="small/robot.toml"
    )
    for cell in plan_bench(request).cells:
        assert [cell.scenario_at(level).stones[0].height_m for level in cell.case.levels] == [0.005, 0.01]
        assert cell.every_level and cell.case.goal == scaled(0.01, proportions_of(cell.case.table["robot"]).sole_width)


def rows_of(*controllers, goal):
    """The rows of one stone, held up to 5 mm, as a table has them."""
    known = {"family": "stone", "case": "outer", "unit": "m", "goal": goal, "threshold": 0.005, "at_top": False}
    known |= {"level": 0.005, "survived": True, "outcome": "stands"}
    return [{**known, "cell": name, "controller": name} for name in controllers]


def test_goals_are_the_robot_s_own_and_one_controller_alone_has_no_score(capsys):
    print_ranking(rows_of("two-part", "soft-qp", goal=0.00389))
    said = capsys.readouterr().out
    assert "stone and landing, 3.89 mm; push" in said and "10 mm" not in said
    assert "score" in said and "1. " in said and "behind the first" in said
    print_ranking(rows_of("two-part", goal=0.01))
    said = capsys.readouterr().out
    assert "stone and landing, 10 mm; push" in said
    assert "score:" not in said and "1. " not in said and "behind the first" not in said


def test_the_page_of_one_controller_alone_has_no_score(short, folder):
    run_bench(short, folder / "out", workers=1)
    page = bench_page(*read_bench(folder / "out"))
    assert "| slope |" in page and "in proportion to it" in page
    assert not any(word in page for word in ("**score**", "| behind the first", "nobody does better"))


def test_what_is_no_robot_is_refused():
    with pytest.raises(InvalidInput, match=r"no such robot.*offset.*path of an MJCF"):
        plan_bench(BenchRequest(robot="nobody"))
    with pytest.raises(InvalidInput, match="the goals are those of one robot"):
        plan_bench(BenchRequest(goals=True, robot=MADE_UP))
