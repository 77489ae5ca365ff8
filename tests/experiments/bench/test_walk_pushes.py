"""The table of pushes during a walk: what is survived against what one step can catch."""

import dataclasses
import math

import pytest

from surefoot.experiments.bench.walk_pushes import PUSHES_COLUMNS, pushes_survived, walk_pushes

ROW = {"family": "walk-push", "case": "to the left", "controller": "c", "at_top": False, "level": 10.0,
       "outcome": "stands", "survived": True}  # fmt: skip
REACH = {"step_ahead_m": 0.6, "step_back_m": 0.5, "step_aside_m": 0.5, "step_landing_s": 0.08}


def cell(name: str, threshold: float, bound_ns: float, **changes: object) -> list[dict[str, object]]:
    """Two levels of it; in the first one the push was never felt."""
    unknown = {**ROW, **REACH, "cell": name, "threshold": threshold, "bound_1_ns": math.nan, **changes}
    return [unknown, {**unknown, "bound_1_ns": bound_ns}]


def lines(rows):
    return pushes_survived([dataclasses.asdict(entry) for entry in walk_pushes(rows)])


def test_each_seed_s_impulse_is_held_against_its_own_bound():
    rows = [*cell("a", 40.0, 80.0), *cell("b", 30.0, 120.0, at_top=True), *cell("c", 60.0, 100.0)]
    (found,) = walk_pushes(rows)
    assert found.survived_ns == (40.0, 30.0, 60.0)
    assert found.bound_ns == (100.0, 80.0, 120.0)
    assert found.eta_1 == pytest.approx((0.5, 0.25, 0.6))  # not 40 / 100
    text = "\n".join(lines(rows))
    assert "| to the left | c | 40.0 (30.0 to 60.0)+ | 100.0 (80.0 to 120.0) | 0.50 (0.25 to 0.60) | 0.080 |" in text
    assert "up to 0.6 m ahead, 0.5 m back or 0.5 m aside of the other foot" in text
    assert all(name in text for name in PUSHES_COLUMNS)


def test_an_impulse_of_zero_is_told_as_less_than_the_smallest_one():
    fallen = {"outcome": "falls", "survived": False}
    rows = [*cell("a", 0.0, 40.0, **fallen), *cell("b", 0.0, 40.0, **fallen), *cell("c", 20.0, 40.0)]
    table = [line for line in lines(rows) if line.startswith("|")][2:]
    assert table == ["| to the left | c | < 10.0 (< 10.0 to 20.0) | 40.0 | < 0.25 (< 0.25 to 0.50) | 0.080 |"]


def test_directions_and_controllers_have_a_line_each_and_nobody_else_has_one():
    rows = [
        *cell("a", 10.0, 0.0),  # the capture point was lost before the push
        *cell("b", 10.0, 20.0, controller="d"),
        *cell("c", math.nan, math.nan, case="forward"),  # refused
        *cell("d", 1.0, 2.0, family="step-push"),
    ]
    table = [line for line in lines(rows) if line.startswith("|")][2:]
    assert table == [
        "| to the left | c | 10.0 | 0.0 | - | 0.080 |",
        "| to the left | d | 10.0 | 20.0 | 0.50 | 0.080 |",
        "| forward | c | - | - | - | - |",
    ]
    assert lines(rows[-2:]) == []
