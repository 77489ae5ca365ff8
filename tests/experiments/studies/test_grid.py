"""The grid of runs and its table; one cell is run for real."""

import dataclasses

import pytest

from surefoot.control.registry import controllers
from surefoot.experiments.studies.grid import LATCHED, grid_cells, markdown_tables, outcome_text, run_cell
from tests.support.plug_ins import installed, put_failing_controllers

STANDS = {"fell": False, "fall_time_s": None, "first_limit": "joint_range", "fall_cause": None}
FALLS = {"fell": True, "fall_time_s": 1.234, "first_limit": "qp_infeasible", "fall_cause": "trunk_tilt"}


def test_every_controller_meets_every_column_and_the_baseline_latched_too():
    cells = grid_cells(torque_limits=True)
    labels = {cell.label for cell in cells}
    rows = {cell.row for cell in cells}
    assert rows == {*controllers(), LATCHED}
    assert len(cells) == len(labels) * len(rows)
    assert {(cell.label, cell.row) for cell in cells} == {(label, row) for label in labels for row in rows}
    for cell in cells:
        assert cell.scenario.controller == ({"latched": True} if cell.row == LATCHED else {})
        assert cell.controller in controllers()


@pytest.mark.parametrize("torque_limits", [True, False])
def test_torque_limits_reach_every_cell(torque_limits):
    assert {cell.scenario.physics.torque_limits for cell in grid_cells(torque_limits=torque_limits)} == {torque_limits}


def test_outcome_says_when_it_fell_and_what_went_first():
    assert outcome_text(STANDS) == "stands"
    assert outcome_text(FALLS) == "falls 1.23 s (qp_infeasible)"
    assert outcome_text({**FALLS, "first_limit": None}) == "falls 1.23 s (trunk_tilt)"


def test_table_has_a_line_for_each_controller_and_counts_who_stands():
    cells = grid_cells(torque_limits=True)
    results = [(cell, STANDS if cell.controller == "two-part" else FALLS) for cell in cells]
    lines = markdown_tables(results).splitlines()
    stones = len({cell.label for cell in cells if cell.family == "stone"})
    (first, second) = [line for line in lines if line.startswith("| two-part |")]
    assert first.endswith(f"| {stones}/{stones} |")
    assert second.count("stands") == len({cell.label for cell in cells if cell.family == "swing"})
    assert next(line for line in lines if line.startswith(f"| {LATCHED} |")).endswith(f"| 0/{stones} |")
    assert len({line.count("|") for line in lines[: 2 + len({cell.row for cell in cells})]}) == 1


def test_a_cell_is_an_ordinary_run():
    cell = grid_cells(torque_limits=True)[0]
    short = dataclasses.replace(cell, scenario=dataclasses.replace(cell.scenario, duration_s=0.05))
    summary = run_cell(short)
    assert (summary["controller"], summary["duration_s"], summary["fell"]) == (cell.controller, 0.05, False)


def test_a_controller_that_cannot_be_built_does_not_end_the_others(tmp_path):
    put_failing_controllers(tmp_path)
    with installed(tmp_path):
        cells = [
            dataclasses.replace(cell, scenario=dataclasses.replace(cell.scenario, duration_s=0.1))
            for cell in grid_cells(torque_limits=True)
            if cell.label == "stone 6 mm" and cell.row in ("unready", "raises", "two-part")
        ]
        results = [(cell, run_cell(cell)) for cell in cells]
    table = markdown_tables(results)
    assert "| two-part | stands |" in table
    assert "| raises | falls 0.05 s (controller_error) |" in table
    assert "| unready | refused |" in table
    assert "refused: controller unready: cannot be built (KeyError: 'a file of mine')" in table
