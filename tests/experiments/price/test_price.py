"""The price list of made-up rows whose losses are known: its figures, page and pictures, and how it goes on."""

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
from surefoot.experiments.price.variants import ESTIMATOR, NONE, TOGETHER
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


def test_a_value_of_zero_is_told_as_less_than_the_weakest_level(folder):
    rows, (_, manifest) = read_table(folder), read_price(folder)
    for row in rows:
        if row["family"] == "push" and row["controller"].endswith("masses"):
            row.update(threshold=0.0, survived=False, outcome="falls", level=0.45)
    found = {price.variant: price for price in prices(rows, manifest) if price.family == "push"}
    assert (found["masses"].nothing, found["masses"].cells, found["masses"].lowest) == (6, 6, 0.45)
    assert found["latency"].lowest is None
    assert "| masses | < 0.450 |" in price_page(list(found.values()), manifest)


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


def test_the_command_of_a_finished_list_runs_nothing_again(folder, capsys):
    cells = {file: file.stat().st_mtime_ns for file in (folder / "cells").iterdir()}
    _, *arguments = command_of(read_price(folder)[1]).split()
    main([*arguments, "--workers", "1", "--out", str(folder)])
    said = capsys.readouterr()
    assert "price: 54/54 cells" in said.err and "steps made of 20 on flat ground" in said.out
    assert {file: file.stat().st_mtime_ns for file in (folder / "cells").iterdir()} == cells


def test_a_mistake_is_one_line(tmp_path, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["price", "--families", "swing", "--out", str(tmp_path / "new")])
    told = capsys.readouterr().err
    assert exit_.value.code == 2 and told.count("\n") == 1 and "push-double, push, stone" in told
    assert not (tmp_path / "new").exists()


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
