"""The price list: what is compared with what, and what the table says of rows whose losses are known."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.stats import t, ttest_1samp

from surefoot.cli.main import main
from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import run_bench
from surefoot.experiments.bench.rerun_cell import rerun_cell
from surefoot.experiments.bench.store import read_table
from surefoot.experiments.plots.waterfall import waterfall
from surefoot.experiments.price.figures import FIGURES, figures_named
from surefoot.experiments.price.losses import INTERPLAY, mean_and_interval, prices
from surefoot.experiments.price.page import (
    DATA,
    PAGE,
    command_of,
    price_page,
    price_tables,
    read_price,
    write_price,
)
from surefoot.experiments.price.plan import ABOUT, PriceRequest, plan_again, plan_price
from surefoot.experiments.price.variants import ESTIMATOR, NONE, TOGETHER, variants
from surefoot.resources import resource_folder

RESULT = resource_folder("static") / "results" / "price"
RESULTS = resource_folder("static") / "help" / "results.md"
BEGIN, END = "<!-- price:begin -->\n", "\n<!-- price:end -->"

SEEDS = (4, 5, 6)
ASKED = PriceRequest(
    families=("push", "walk-flat"), imperfections=("imu-bias", "latency", "masses"), quick=True, seeds=3, first_seed=4
)
# What is left of 1.0 (or of 20 steps) under each, whatever the case; and how a seed moves it
LEFT = {NONE: 1.0, ESTIMATOR: 0.95, "imu-bias": 0.85, "latency": 0.95, "masses": 0.9, TOGETHER: 0.7}
MOVED = {4: 0.0, 5: 0.04, 6: -0.01}


def made_up(cell):
    """The row of a cell: perfect differs from seed to seed, and under bias and together the loss does too."""
    name = cell.label.partition(": ")[2]
    value = LEFT[name] + 0.1 * (cell.seed - 5) + (MOVED[cell.seed] if name in ("imu-bias", TOGETHER) else 0.0)
    walk = cell.case.family == "walk-flat"
    fell = name == TOGETHER and cell.seed == 4
    return [
        {
            "family": cell.case.family, "case": cell.case.name, "controller": cell.label, "seed": cell.seed,
            "registry_name": cell.controller, "level": cell.case.levels[0], "unit": cell.case.unit,
            "goal": math.nan, "threshold": 0.0 if walk and fell else value, "survived": not fell,
            "outcome": ("unsettled" if fell else "stands"), "fall_cause": "", "at_top": name == NONE, "scenario": "",
            "cell": cell.key, **({"steps_made": 20.0 * value, "steps_planned": 20.0} if walk else {}),
        }
    ]  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("price")
    run_bench(plan_price(ASKED), out, workers=1, task=made_up)
    return out


@pytest.fixture(scope="module")
def found(folder):
    return {(price.family, price.variant): price for price in read_price(folder)[0]}


def test_a_sensor_is_held_against_perfect_sensors_and_all_else_against_the_true_state():
    known = {variant.name: variant for variant in variants("robot", "anchor")}
    assert (next(iter(known)), next(reversed(known))) == (NONE, TOGETHER)
    assert known[NONE].changes == {} and known[ESTIMATOR].changes == {"estimator.kind": "anchor"}
    assert known["imu-bias"].changes == {
        "estimator.kind": "anchor", "sensors.gyro_bias_rad_s": 0.005, "sensors.accelerometer_bias_m_s2": 0.1,
    }  # fmt: skip
    assert known["masses"].changes == {"model_error.mass": 0.03, "model_error.inertia": 0.1}
    assert (known["imu-bias"].base, known["masses"].base, known[TOGETHER].base) == (ESTIMATOR, NONE, NONE)
    every = {path for name, variant in known.items() if name != TOGETHER for path in variant.changes}
    assert set(known[TOGETHER].changes) == every


def test_one_of_your_own_and_some_of_a_preset():
    known = {one.name: one for one in variants("lab", "anchor", ("latency", "slow+physics.control_delay_s=0.002"))}
    assert list(known) == [NONE, ESTIMATOR, "latency", "slow", TOGETHER]
    assert known["slow"].changes == {"physics.control_delay_s": 0.002} and known["slow"].base == NONE
    assert known[TOGETHER].changes["physics.control_delay_s"] == 0.002


def test_with_the_true_state_no_sensor_is_in_the_list():
    names = [one.name for one in variants("robot", "truth")]
    assert ESTIMATOR not in names and "imu-noise" not in names and "motor-friction" in names


@pytest.mark.parametrize(
    ("asked", "names"),
    [
        ({"families": ("swing",)}, "push-double"),
        ({"imperfections": ("gyros",)}, "imu-noise"),
        ({"imperfections": ("motor-speed",)}, "the preset does not have it"),
        ({"imperfections": ("mine+duration_s=3",)}, "is no imperfection"),
        ({"imperfections": ("latency+sensors.imu_latency_s=0.1",)}, "name of its own"),
        ({"imperfections": ("mine+sensors.imu_latency_s=9",)}, r"sensors\.imu_latency_s"),
        ({"imperfections": ("latency",), "estimator": "truth"}, "nobody reads"),
        ({"imperfections": ("latency", "latency")}, "twice"),
        ({"preset": "perfect", "estimator": "truth"}, "nothing differs"),
        ({"preset": "bad"}, "cheap"),
        ({"estimator": "oracle"}, "invariant-ekf"),
        ({"controllers": ""}, "two-part"),
        ({"changes": ("duration_s=3",)}, "settings and the plant"),
        ({"seeds": 0}, "at least 1"),
        ({"first_seed": -1}, "negative"),
    ],
)
def test_what_cannot_be_asked_for_is_told_before_anything_runs(asked, names):
    with pytest.raises(InvalidInput, match=names):
        plan_price(PriceRequest(**asked))


@pytest.mark.parametrize("quick", [True, False])
def test_every_figure_is_played_from_scenarios_that_can_be_started(quick):
    for figure in figures_named(tuple(FIGURES)):
        cases = figure.cases(quick=quick)
        assert len(cases) == min(len(figure.names), 2 if quick else 9)
        for case in cases:
            level = case.levels[len(case.levels) // 2]
            assert len(case.levels) in (1, 15, 31) and case.goal is None
            assert case.table_at(level)["robot"] == "bip"


def test_fewer_seeds_are_the_beginning_and_all_variants_of_a_seed_meet_the_same_disturbance():
    bench = plan_price(ASKED)
    keys = [cell.key for cell in bench.cells]
    fewer = [cell.key for cell in plan_price(PriceRequest(**{**ASKED.__dict__, "seeds": 1})).cells]
    assert keys[: len(fewer)] == fewer and len(set(keys)) == len(keys)
    for seed in SEEDS:
        tables = [cell.case.table for cell in bench.cells if (cell.seed, cell.case.name) == (seed, "left")]
        assert len(tables) == len(LEFT) and all(table == tables[0] for table in tables)
    biased = next(cell for cell in bench.cells if cell.label.endswith("imu-bias") and cell.seed == 5)
    assert biased.changes["sensors.seed"] == 5


@pytest.mark.parametrize(("family", "scale"), [("push", 1.0), ("walk-flat", 20.0)])
def test_losses_that_are_known_come_out(found, family, scale):
    perfect = scale * np.mean([1.0 + 0.1 * (seed - 5) for seed in SEEDS])
    for name, lost in ((ESTIMATOR, 0.05), ("latency", 0.0), ("masses", 0.1)):  # the same in every seed
        price = found[family, name]
        assert price.lost == pytest.approx(scale * lost, abs=1e-12)
        assert price.interval == pytest.approx((scale * lost, scale * lost), abs=1e-12)
        assert price.share == pytest.approx(scale * lost / perfect, abs=1e-12)
    moved = scale * np.array([0.1 - MOVED[seed] for seed in SEEDS])
    bias = found[family, "imu-bias"]
    assert bias.lost == pytest.approx(moved.mean(), rel=1e-12)
    expected = ttest_1samp(moved, 0.0).confidence_interval(0.95)
    assert bias.interval == pytest.approx((expected.low, expected.high), rel=1e-9)
    assert bias.seeds == 3 and bias.value == pytest.approx(perfect - scale * 0.05 - moved.mean())


def test_the_lines_add_up_to_together(found):
    for family in ("push", "walk-flat"):
        mine = {name: price for (of, name), price in found.items() if of == family}
        parts = [price.lost for name, price in mine.items() if name not in (NONE, TOGETHER)]
        assert sum(parts) == pytest.approx(mine[TOGETHER].lost)
        assert mine[INTERPLAY].lost == pytest.approx(0.05 * (20.0 if family == "walk-flat" else 1.0))
        spans = waterfall(list(mine.values()))
        assert spans[0] == (0.0, mine[NONE].value) and spans[1][0] == mine[NONE].value
        assert all(one[1] == following[0] for one, following in pairwise(spans[:-1]))
        assert spans[-2][1] == pytest.approx(spans[-1][1]) and spans[-1] == (0.0, mine[TOGETHER].value)


def test_what_was_not_survived_at_all_is_counted(found):
    assert (found["walk-flat", TOGETHER].nothing, found["walk-flat", TOGETHER].unsettled) == (1, 1)
    assert found["walk-flat", TOGETHER].cells == 3 and found["push", TOGETHER].cells == 6
    assert found["push", TOGETHER].nothing == 0
    assert found["push", NONE].at_top == 6 and found["push", TOGETHER].at_top == 0


def test_a_case_that_cannot_be_started_under_one_variant_is_left_out_of_all(folder):
    rows, (_, manifest) = read_table(folder), read_price(folder)
    for row in rows:
        if (row["family"], row["case"]) == ("push", "left") and row["controller"].endswith("masses"):
            row["threshold"] = math.nan
    left = {price.variant: price for price in prices(rows, manifest) if price.family == "push"}
    assert all(price.cells == 3 for name, price in left.items() if name != INTERPLAY)
    for row in rows:
        row["threshold"] = math.nan
    nothing = [price for price in prices(rows, manifest) if price.family == "push"]
    assert all(math.isnan(price.lost) and price.interval is None for price in nothing)
    assert "| - |" in price_page(nothing, manifest)


def test_an_interval_needs_two_seeds():
    assert mean_and_interval([2.0]) == (2.0, None)
    middle, (low, high) = mean_and_interval([1.0, 3.0])
    assert middle == 2.0 and high - 2.0 == pytest.approx(t.ppf(0.975, 1)) == 2.0 - low


def test_the_page_is_made_from_the_folder_alone(folder, capsys):
    written = write_price(folder)
    assert all(file.stat().st_size for file in written)
    page = (folder / PAGE).read_text(encoding="utf-8")
    assert "\n### Push survived from one foot [J/J_cap], two-part\n" in page
    assert "| perfect | 1.000+ |  |  | 0/6 |" in page
    assert "| masses | 0.900 | +0.100 [+0.100, +0.100] | 10.0 % | 0/6 |" in page
    assert "| interplay |  | +0.050 [+0.050, +0.050] | 5.0 % |  |" in page
    assert "`sensors.gyro_bias_rad_s = 0.005`" in page
    command = (
        "surefoot price --quick --families push,walk-flat --preset robot --estimator anchor "
        "--imperfections imu-bias,latency,masses --controllers two-part --seeds 3 --first-seed 4"
    )
    assert command_of(read_price(folder)[1]) == command and command in page
    plain = json.loads((folder / DATA).read_text(encoding="utf-8"))
    assert [entry["variant"] for entry in plain[:2]] == [NONE, ESTIMATOR]
    before = page
    main(["price", "--report", "--out", str(folder)])
    assert (folder / PAGE).read_text(encoding="utf-8") == before
    assert "push survived from one foot" in capsys.readouterr().out


def test_a_bench_that_is_no_price_list_is_told(folder, tmp_path, capsys):
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    del manifest[ABOUT]
    (tmp_path / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    with pytest.raises(SystemExit) as exit_:
        main(["price", "--report", "--out", str(tmp_path)])
    assert exit_.value.code == 2 and "no price list" in capsys.readouterr().err


def test_after_an_interruption_only_the_rest_is_run(folder, tmp_path):
    bench, ran = plan_price(ASKED), []

    def interrupted(cell):
        if len(ran) == 7:
            raise KeyboardInterrupt
        ran.append(cell.key)
        return made_up(cell)

    with pytest.raises(KeyboardInterrupt):
        run_bench(bench, tmp_path, workers=1, task=interrupted)
    again = []

    def counted(cell):
        again.append(cell.key)
        return made_up(cell)

    run_bench(bench, tmp_path, workers=1, task=counted)
    assert len(ran) == 7 and set(ran) | set(again) == {cell.key for cell in bench.cells} and not set(ran) & set(again)
    assert read_price(tmp_path)[0] == read_price(folder)[0]


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    """One case at its weakest level, of 50 ms, under the sensors and masses of ``cheap``, really played."""
    bench = plan_price(PriceRequest(families=("push",), imperfections=("imu-noise", "masses"), preset="cheap", seeds=1))
    cells = []
    for cell in bench.cells:
        if cell.case.name == "left":
            table = {**cell.case.table, "duration_s": 0.05}
            case = type(cell.case)(**{**cell.case.__dict__, "table": table, "levels": cell.case.levels[:1]})
            cells.append(type(cell)(**{**cell.__dict__, "case": case}))
    out = tmp_path_factory.mktemp("real")
    run_bench(type(bench)(**{**bench.__dict__, "cells": tuple(cells)}), out, workers=1)
    return out


def test_each_variant_is_really_another_run(real):
    rows = {row["controller"].partition(": ")[2]: row for row in read_table(real)}
    assert list(rows) == [NONE, ESTIMATOR, "imu-noise", "masses", TOGETHER]
    assert not any(row["refusal"] for row in rows.values())
    assert len({row["com_speed_mps"] for row in rows.values()}) == len(rows)
    assert {name for name, row in rows.items() if row["other_plant"] == 1.0} == {"masses", TOGETHER}
    assert len(read_price(real)[0]) == len(rows) + 1


def test_every_cell_is_found_again_from_the_manifest(folder):
    rows, (_, manifest) = read_table(folder), read_price(folder)
    for row in rows[:: len(LEFT)]:
        assert row["cell"] in {cell.key for cell in plan_again(row, manifest)}
    with pytest.raises(InvalidInput, match="asked for"):
        rerun_cell(rows[0]["cell"], rows, {ABOUT: {}})


def test_the_table_in_the_documents_is_made_from_the_result_that_ships():
    """Both, or neither."""
    _, begun, rest = RESULTS.read_text(encoding="utf-8").partition(BEGIN)
    assert bool(begun) == RESULT.is_dir()
    if begun:
        found, manifest = read_price(RESULT)
        assert manifest["complete"]
        assert rest.partition(END)[0] == "\n".join(price_tables(found, manifest)).rstrip("\n")
        assert command_of(manifest) in RESULTS.read_text(encoding="utf-8")
