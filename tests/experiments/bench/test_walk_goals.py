"""The figures that walks are to reach: what is played in which order, and the table of what came out."""

from collections import Counter

import pytest

from surefoot.cli.main import main
from surefoot.experiments.bench.bench import BenchRequest, plan_bench, run_bench
from surefoot.experiments.bench.goal_table import TITLE, goal_lines
from surefoot.experiments.bench.made_by import command_of
from surefoot.experiments.bench.report import bench_page, read_bench
from surefoot.experiments.bench.statistics import wilson_interval
from surefoot.experiments.bench.store import read_table
from surefoot.experiments.bench.walk_goals import walk_goals


def asked(seeds=3):
    return BenchRequest(controllers="two-part,optimization", goals=True, seeds=seeds, first_seed=50)


@pytest.fixture(scope="module")
def bench():
    return plan_bench(asked())


def made_up(cell):
    """The row of a walk over that cell: half of the seeds fall over the highest stones, the rest stands."""
    (level,) = cell.case.levels
    fell = cell.case.name == "30 mm, 50 steps" and cell.seed % 2 == 0
    return [
        {
            "family": cell.case.family, "case": cell.case.name, "controller": cell.label, "seed": cell.seed,
            "registry_name": cell.controller, "level": level, "unit": cell.case.unit, "goal": float("nan"),
            "threshold": 0.0 if fell else level, "survived": not fell, "outcome": "falls" if fell else "stands",
            "fall_cause": "pelvis_low" if fell else "", "first_cause": "out_of_reach" if fell else "", "at_top": False,
            "ankle_stop_before_s": 0.3 if fell else float("nan"), "scenario": "", "cell": cell.key,
        }
    ]  # fmt: skip


def test_it_is_played_seed_by_seed_so_that_fewer_seeds_are_its_beginning(bench):
    keys = [cell.key for cell in bench.cells]
    for seeds in (1, 2):
        fewer = [cell.key for cell in plan_bench(asked(seeds)).cells]
        assert fewer == keys[: len(fewer)]
    assert len(set(keys)) == len(keys)
    assert [cell.seed for cell in bench.cells] == sorted(cell.seed for cell in bench.cells)


def test_near_copies_are_not_played_again_and_again(bench):
    played = Counter((cell.case.family, cell.case.name) for cell in bench.cells if cell.label == "two-part")
    for goal in walk_goals():
        for case in goal.cases:
            assert played[case.family, case.name] == min(3, goal.most_seeds or 3)
    many = Counter(cell.case.family for cell in plan_bench(asked(12)).cells if cell.label == "two-part")
    assert many["walk-slope"] == 30 and many["walk-stones"] == 24 and many["walk-flat"] == 2


def test_controllers_to_compare_with_play_fewer_seeds():
    played = Counter((cell.label, cell.case.name) for cell in plan_bench(asked(100)).cells)
    assert played["two-part", "20 mm, 50 steps"] == played["two-part", "30 mm, 30 steps"] == 100
    assert played["two-part", "30 mm, 50 steps"] == played["two-part", "60 mm up"] == 20
    assert played["optimization", "20 mm, 50 steps"] == played["optimization", "30 mm, 50 steps"] == 8


def test_every_case_is_a_scenario_at_its_level_with_the_steps_that_it_is_called_after(bench):
    for cell in bench.cells[:: len(bench.entries)]:
        scenario = cell.scenario_at(*cell.case.levels)
        if " steps" in cell.case.name:
            steps = next(int(part.split()[-1]) for part in cell.case.name.split(" steps")[:1])
            assert scenario.reference.steps == steps


def test_the_table_is_made_from_the_result_alone(bench, tmp_path):
    played = []

    def task(cell):
        played.append(cell.seed)
        return made_up(cell)

    run_bench(plan_bench(asked(2)), tmp_path, workers=1, task=task)
    before = len(played)
    run_bench(bench, tmp_path, workers=1, task=task)
    assert set(played[before:]) == {52}  # the others are kept
    assert len(read_table(tmp_path)) == len(bench.cells)
    ranking, manifest = read_bench(tmp_path)
    lines = goal_lines(ranking, manifest)
    assert len(lines) == 2 + len(walk_goals())
    assert lines[0] == "| what | bar | two-part | optimization |"
    low, high = wilson_interval(1, 3)
    fallen = f"1/3 [{low:.2f}, {high:.2f}] out_of_reach 2 (ankle at its stop before 2)"
    assert f"(0.15 m, 0.7 s) | >= 70 % | {fallen} | {fallen} |" in lines[4]
    assert "| >= 95 % | **3/3** [0.44, 1.00] |" in lines[2]
    from_two_feet = next(line for line in lines if "from two feet" in line)
    assert "8 directions | all | **8/8** [0.68, 1.00] |" in from_two_feet
    page = bench_page(ranking, manifest)
    assert f"## {TITLE}" in page and all(line in page for line in lines)
    assert command_of(manifest) == (
        "surefoot bench --goals --controllers two-part,optimization --seeds 3 --first-seed 50"
    )


def test_only_who_asks_for_goals_is_told_of_them():
    assert "goals" not in plan_bench(BenchRequest(quick=True, families=("slope",))).manifest()


@pytest.mark.parametrize("more", [["--families", "push"], ["--levels", "0.02"], ["--quick"]])
def test_they_have_cases_and_levels_of_their_own(more, tmp_path, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["bench", "--goals", *more, "--out", str(tmp_path)])
    assert exit_.value.code == 2 and "--goals" in capsys.readouterr().err
