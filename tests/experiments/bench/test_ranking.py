"""What is made of the table."""

import math
import re

import pytest

from surefoot.cli.bench_tables import print_cases, print_ranking
from surefoot.experiments.bench.ranking import as_data, beyond_bound, not_adding_up, places, ranking, standings
from surefoot.experiments.bench.report import bench_page, read_bench
from surefoot.experiments.bench.statistics import wilson_interval
from surefoot.resources import resource_folder

RESULT = resource_folder("static") / "results" / "bench"


def row(controller, case, threshold, **more):
    return {
        "family": "push", "case": case, "controller": controller, "seed": 0, "unit": "J/J_cap", "threshold": threshold,
        "goal": 0.95, "at_top": False, "level": threshold, "outcome": "stands", "survived": True, "eta": 0.5,
        "cell": f"{controller} {case} {more.get('seed', 0)}", **more,
    }  # fmt: skip


def test_controllers_are_ranked_by_their_share_of_the_best():
    rows = [row("a", "left", 0.9), row("a", "right", 1.0), row("b", "left", 0.45), row("b", "right", 0.5)]
    found = {standing.controller: standing for standing in standings(rows)}
    assert (found["a"].score, found["b"].score) == (1.0, 0.5)
    assert (found["a"].mean, found["a"].worst) == pytest.approx((0.95, 0.9))
    assert (found["a"].reached, found["a"].wanted) == (1, 2)
    assert ranking(list(found.values())) == [("a", 1.0), ("b", 0.5)]


def test_a_cell_counts_once_however_many_levels_were_run():
    assert standings([row("a", "left", 0.95)] * 3)[0].wanted == 1


def test_seeds_give_a_range_and_refused_cells_are_left_out():
    rows = [row("a", "left", t, seed=i) for i, t in enumerate((0.8, 1.0, 0.9, math.nan))]
    standing = standings(rows)[0]
    assert (standing.thresholds["left"].median, standing.worst, standing.refused) == (0.9, 0.8, 1)
    assert (standing.reached, standing.wanted) == (1, 3)


def test_who_cannot_start_where_others_can_gets_nothing_for_it():
    rows = [row("a", "left", 1.0), row("b", "left", math.nan), row("a", "up", math.nan), row("b", "up", math.nan)]
    assert [standing.score for standing in standings(rows)] == [1.0, 0.0]


def test_where_nothing_is_survived_the_lowest_level_is_said_not_zero():
    """Two seeds: one falls at 0.45, the lowest that was played, the other holds it."""
    fallen = {"survived": False, "outcome": "falls"}
    rows = [row("a", "left", 0.0, seed=1, level=level, **fallen) for level in (0.45, 0.5)]
    rows += [row("a", "left", 0.45, seed=2, level=0.45), row("a", "left", 0.45, seed=2, level=0.5, **fallen)]
    rows += [row("a", "up", 0.0, seed=seed, level=0.4, **fallen) for seed in (1, 2)]
    rows += [row("a", "up", 0.0, seed=1, level=0.3, survived=False, outcome="refused")]
    rows += [row("b", case, 0.9, seed=seed) for case in ("left", "up") for seed in (1, 2)]
    nothing, held = standings(rows)
    assert (nothing.lowest, nothing.lowest_level) == ({"left": 0.45, "up": 0.4}, 0.45)
    assert (held.lowest, held.lowest_level) == ({}, None)
    data = as_data([nothing, held])
    page = bench_page(data, {**read_bench(RESULT)[1], "seeds": [1, 2]})
    assert "| 0.900 (0.900) | 0.113 (< 0.450) |" in page
    assert "| push | left | J/J_cap | 0.900 | 0.225 (< 0.450 to 0.450) |" in page
    assert "| push | up | J/J_cap | 0.900 | < 0.400 |" in page
    assert "`<`: not even the lowest level played was survived" in page
    for entry in data["families"]:  # as a bench of an older version wrote it
        entry.pop("lowest")
        for case in entry["cases"].values():
            case.pop("lowest", None)
    assert "| push | up | J/J_cap | 0.900 | 0.000 |" in bench_page(data, {**read_bench(RESULT)[1], "seeds": [1, 2]})


def test_the_terminal_says_what_nothing_was_survived_of(capsys):
    rows = [row("a", "left", 0.0, level=0.45, survived=False, outcome="falls")]
    print_ranking(rows)
    print_cases(rows)
    said = capsys.readouterr().out
    assert "push < 0.450 J/J_cap" in said
    assert re.search(r"left\s+│\s+J/J_cap\s+│\s+< 0.450", said)
    print_ranking([*rows, row("b", "left", 0.9)])
    assert "< 0.450 (< 0.450)" in capsys.readouterr().out


def test_what_lies_beyond_the_bound_is_found_and_what_does_not_add_up_too():
    entries = {"bound_ns": 50.0, "excess_ns": 2.5, "sole_ns": -1.0, "foot_moved_ns": 3.5, "angular_momentum_ns": 0.0,
               "vertical_ns": 0.0, "ends_ns": 0.0}  # fmt: skip
    none = dict.fromkeys(entries, math.nan)
    rows = [
        row("a", "left", 1.0, eta=1.0, **none),
        row("a", "left", 1.0, eta=1.05, explained=False, **entries),  # an old table's word: no angular momentum
        row("b", "left", 1.0, eta=1.1, **{**entries, "foot_moved_ns": 2.5}),
        row("b", "up", 1.0, eta=1.1, explained=True, **none),
        row("b", "up", 1.0, eta=1.2, survived=False, **none),
    ]
    assert [r["eta"] for r in beyond_bound(rows)] == [1.05, 1.1, 1.1]
    assert not_adding_up(rows) == rows[2:4]


def test_seeds_of_a_case_count_as_one_trial_of_the_share():
    rows = [row("a", case, 0.95, seed=seed) for case in ("left", "right", "up") for seed in (101, 102, 103)]
    (standing,) = standings(rows)
    assert (standing.reached, standing.wanted, standing.goal_cases) == (9, 9, 3)
    assert standing.interval == wilson_interval(3, 3)


def test_places_tell_how_far_behind_the_first_and_how_sure():
    """b holds three quarters of what a holds in every case: surely behind. c is ahead in one case and behind in one."""
    rows = []
    for seed in (101, 102, 103):
        for case, thresholds in (("left", (1.0, 0.75, 1.2)), ("right", (0.8, 0.6, 0.6))):
            rows += [row(name, case, t, seed=seed) for name, t in zip("abc", thresholds, strict=True)]
    first, second, third = places(standings(rows))
    assert (first.controller, second.controller, third.controller) == ("a", "c", "b")
    assert first.score == pytest.approx((1 / 1.2 + 1) / 2) and first.interval == pytest.approx((1 / 1.2, 1.0), abs=1e-6)
    assert (first.behind, first.behind_interval) == (0.0, (0.0, 0.0))
    assert second.behind == pytest.approx(first.score - (1.0 + 0.75) / 2)
    assert second.behind_interval[0] < 0.0 < second.behind_interval[1]
    assert third.behind == pytest.approx(0.25 * first.score)
    assert third.behind_interval == pytest.approx((0.25 / 1.2, 0.25), abs=1e-6)


def test_the_ranking_as_data_says_what_its_intervals_count():
    rows = [row(name, case, t, seed=seed) for seed in (1, 2) for name, t in (("a", 1.0), ("b", 0.5)) for case in "xy"]
    data = as_data(standings(rows))
    assert data["ranking"][1] == {
        "controller": "b", "score": 0.5, "score_95": [0.5, 0.5], "behind": 0.5, "behind_95": [0.5, 0.5]
    }  # fmt: skip
    family = data["families"][0]
    assert (family["goals"], family["goal_cases"], family["goals_95"]) == (4, 2, list(wilson_interval(2, 2)))
