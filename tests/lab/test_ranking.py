"""What is made of the table."""

import math

import pytest

from app.experiments.lab.ranking import beyond_bound, not_adding_up, ranking, standings


def row(controller, case, threshold, **more):
    return {
        "family": "push", "case": case, "controller": controller, "seed": 0, "unit": "J/J_cap", "threshold": threshold,
        "goal": 0.95, "at_top": False, "survived": True, "eta": 0.5,
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
