"""Maps of survival: what is read from a table, the limits drawn beside it, and the files that come out."""

import math
import subprocess
import sys

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.cli.map import Map
from surefoot.errors import InvalidInput
from surefoot.experiments.maps.data import plan_maps, spots, word
from surefoot.experiments.maps.limits import ankle_stop_height, capture_curve, swing_limits
from surefoot.experiments.maps.report import write_maps
from surefoot.experiments.runs.table_file import write_parquet
from surefoot.experiments.scenario.bounds import support_polygon_at_rest, swing_excursion
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.momentum.zmp import capture_impulse, natural_frequency
from surefoot.robot.feet import Support

NAN = math.nan
BLANK = {
    "seed": 0, "unit": "m", "at_top": False, "axis": "", "support": "left", "swing_duration_s": NAN, "amplitude_m": NAN,
    "stone_x_m": NAN, "stone_y_m": NAN, "push_direction_deg": NAN, "bound_ns": NAN,
}  # fmt: skip


def row(family, case, controller, level, outcome, threshold, **more):
    keys = {"family": family, "case": case, "controller": controller, "level": level, "outcome": outcome}
    return {**BLANK, **keys, "threshold": threshold, **more}


def table():
    rows = []
    for controller, height, eta, amplitude in (("two-part", 0.012, 0.95, 0.05), ("soft-qp", 0.0, NAN, 0.02)):
        for level in (0.008, 0.012, 0.016):
            what = "stands" if level <= height else "falls"
            rows.append(row("stone", "outer", controller, level, what, height, stone_x_m=0.03, stone_y_m=0.08))
        rows.append(row("push", "left", controller, 0.95, "stands", eta, push_direction_deg=90.0, bound_ns=29.0))
        for level in (0.02, 0.05):
            what = "stands" if level <= amplitude else "refused"
            rows.append(row("swing", "inward 0.5 s", controller, level, what, amplitude, swing_duration_s=0.5,
                            amplitude_m=-level, axis="lateral"))  # fmt: skip
    return rows


def test_spots_hold_threshold_levels_and_place():
    found = spots(table(), "stone")
    (spot,) = found["two-part"]
    assert spot.threshold == 0.012
    assert spot.levels == ((0.008, "stands"), (0.012, "stands"), (0.016, "falls"))
    assert spot.place == (0.03, 0.08)
    (swing,) = spots(table(), "swing")["soft-qp"]
    assert swing.place == (0.5, -1.0)
    assert word(swing) == "inward"
    assert spots(table(), "tilt") == {}


def test_of_several_seeds_the_median_counts_and_the_worst_outcome_is_shown():
    seeds = enumerate((("stands", 0.01), ("falls", 0.0), ("stands", 0.014)))
    rows = [
        row("stone", "toe", "a", 0.01, what, threshold, seed=seed, stone_x_m=0.1 + 0.01 * seed, stone_y_m=0.0)
        for seed, (what, threshold) in seeds
    ]
    (spot,) = spots(rows, "stone")["a"]
    assert spot.threshold == 0.01
    assert spot.levels == ((0.01, "falls"),)
    assert spot.place == (pytest.approx(0.11), 0.0)


def test_directions_of_several_seeds_are_averaged_around_the_circle():
    rows = [
        row("push", "forward", "a", 0.9, "stands", 0.9, seed=seed, push_direction_deg=angle, bound_ns=58.0)
        for seed, angle in enumerate((359.0, 1.0, 358.5, 1.5))
    ]
    assert spots(rows, "push")["a"][0].place == (pytest.approx(0.0, abs=1e-9), 58.0)


@pytest.mark.parametrize("support", Support)
def test_the_capture_curve_is_the_capture_impulse_with_the_true_polygon(robot, support):
    angles = np.array((0.0, 33.0, 90.0, 180.0, 271.0))
    scenario = Scenario(support=support)
    com = start_posture(scenario).position_com
    omega = natural_frequency(float(com[2]), robot.gravity)
    polygon = support_polygon_at_rest(scenario)
    expected = [
        capture_impulse(robot.mass_kg, omega, polygon, com[:2],
                        np.array((math.cos(math.radians(a)), math.sin(math.radians(a)))), 0.1)
        for a in angles
    ]  # fmt: skip
    assert_allclose(capture_curve(support, 0.1, angles), expected, rtol=1e-12)


def test_the_curve_has_the_figures_of_the_first_study():
    """58.2 forward, 28.9 lateral, 54.3 back for 0.1 s."""
    assert capture_curve(Support.LEFT, 0.1, np.array((0.0, 90.0, 180.0))) == pytest.approx((58.2, 28.9, 54.3), abs=0.1)


@pytest.mark.parametrize(("axis", "sign", "duration"), [("lateral", -1.0, 0.5), ("sagittal", 1.0, 0.7)])
def test_at_the_limits_of_a_swing_its_margins_vanish(axis, sign, duration):
    limits = swing_limits(axis, sign, np.array((duration,)))

    def margins(amplitude):
        spec = ReferenceSpec(kind="swing", axis=axis, amplitude_m=sign * amplitude, duration_s=duration, start_s=0.1)
        return swing_excursion(Scenario(reference=spec))

    assert margins(float(limits.capture_m[0])).capture_margin_m == pytest.approx(0.0, abs=1e-4)
    assert margins(float(limits.zmp_m[0])).zmp_margin_m == pytest.approx(0.0, abs=2e-3)  # first order in the amplitude
    assert limits.zmp_m[0] < limits.capture_m[0]


def test_the_ankle_stop_of_an_outer_stone_is_its_lever_times_the_room_of_the_ankle():
    """Left: room 0.055 rad; from the inner edge to the stone's inner upper edge some 0.13 m: 7 mm.

    Right: 0.068 rad, Bip's masses are not symmetric. Inner and middle stones, and those at the heel: no stop.
    """
    outer = ankle_stop_height((0.025, 0.0855), (0.06, 0.06), Support.LEFT)
    assert outer == pytest.approx(0.055 * 0.128, rel=0.05)
    assert ankle_stop_height((0.025, -0.0855), (0.06, 0.06), Support.RIGHT) == pytest.approx(0.068 * 0.128, rel=0.05)
    for place in ((0.025, -0.0855), (0.025, 0.0), (-0.11, 0.0855)):
        assert ankle_stop_height(place, (0.06, 0.06), Support.LEFT) == math.inf


def test_every_picture_is_written_twice_and_the_page_needs_no_other_file(tmp_path):
    files = write_maps(table(), {"commit": "abc", "cells": 6}, tmp_path)
    names = {file.name for file in files}
    assert names == {f"map_{what}.{kind}" for what in ("stones", "pushes", "swings") for kind in ("png", "svg")} | {
        "map.html"
    }
    assert all(file.stat().st_size > 5000 for file in files)
    page = (tmp_path / "map.html").read_text()
    assert page.count("data:image/png;base64,") == 3
    assert "two-part" in page
    assert "abc" in page
    assert 'src="map_' not in page
    assert "<td>&lt; 8</td>" in page  # soft-qp falls on every stone, 8 mm being the lowest that was played


def test_a_table_without_anything_to_show_is_refused(tmp_path):
    with pytest.raises(InvalidInput, match="holds nothing that a map shows"):
        write_maps([row("tilt", "rises left", "a", 2.0, "stands", 2.0)], {}, tmp_path)


def test_the_quick_plan_is_small_and_the_full_one_has_every_place_and_direction():
    quick, full = plan_maps(quick=True), plan_maps("two-part")
    assert {cell.label for cell in quick.cells} == {"two-part", "soft-qp"}
    assert len(quick.cells) <= 50
    count = {family: sum(cell.case.family == family for cell in full.cells) for family in full.request.families}
    assert (count["stone"], count["push"], count["push-double"], count["swing"]) == (9, 8, 8, 20)
    assert len({cell.key for cell in full.cells}) == len(full.cells)


def test_a_finished_table_takes_no_further_wishes(tmp_path):
    with pytest.raises(InvalidInput, match="--bench"):
        Map(bench=tmp_path, out=tmp_path, quick=True, workers=1).main()
    with pytest.raises(InvalidInput, match="holds no finished bench"):
        Map(bench=tmp_path, out=tmp_path / "maps", workers=1).main()


def test_the_command_line_knows_map():
    done = subprocess.run(
        [sys.executable, "-m", "surefoot", "map", "--help"], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0
    assert "--bench" in done.stdout


def test_without_a_table_the_map_makes_its_own_runs_beside_its_pictures(tmp_path, monkeypatch, capsys):
    asked = []

    def pretend(plan, folder, *, workers, on_cell):
        asked.append((len(plan.cells), folder, workers))
        on_cell(len(plan.cells), len(plan.cells))
        folder.mkdir()
        rows = [{"cell": "", "survived": False, "scenario": "", **line} for line in table()]
        write_parquet(folder / "bench.parquet", {key: [line[key] for line in rows] for key in rows[0]}, {})

    monkeypatch.setattr("surefoot.experiments.bench.bench.run_bench", pretend)
    Map(out=tmp_path, controllers="two-part", quick=True, workers=3).main()
    assert asked == [(23, tmp_path / "runs", 3)]
    assert (tmp_path / "map.html").is_file()
    assert str(tmp_path / "map_pushes.svg") in capsys.readouterr().out


def test_a_map_of_another_robot_is_in_proportion_to_it():
    plan, of_bip = plan_maps("two-part", quick=True, robot="offset"), plan_maps("two-part", quick=True)
    assert {cell.case.table["robot"] for cell in plan.cells} == {"offset"}
    assert [len(cell.case.levels) for cell in plan.cells] == [len(cell.case.levels) for cell in of_bip.cells]
    angles, durations = np.array((0.0, 90.0)), np.array((0.5,))
    assert (capture_curve(Support.LEFT, 0.1, angles, "offset") < 0.4 * capture_curve(Support.LEFT, 0.1, angles)).all()
    mine, bips = (swing_limits("lateral", -1.0, durations, robot=robot) for robot in ("offset", "bip"))
    assert 0.0 < mine.capture_m[0] < bips.capture_m[0]
