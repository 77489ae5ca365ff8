"""What a price list plays: which variants, what each is held against, and that each is really another run."""

from dataclasses import replace

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import run_bench
from surefoot.experiments.bench.store import read_table
from surefoot.experiments.price.figures import FIGURES, figures_named
from surefoot.experiments.price.page import read_price
from surefoot.experiments.price.plan import PriceRequest, plan_price
from surefoot.experiments.price.variants import ESTIMATOR, NONE, TOGETHER, variants

ASKED = PriceRequest(families=("push",), imperfections=("imu-bias", "masses"), quick=True, seeds=3, first_seed=4)


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
            assert list(case.levels) == sorted(set(case.levels))
            assert case.table_at(level)["robot"] == "bip"


def test_fewer_seeds_are_the_beginning_and_all_variants_of_a_seed_meet_the_same_disturbance():
    bench = plan_price(ASKED)
    keys = [cell.key for cell in bench.cells]
    fewer = [cell.key for cell in plan_price(replace(ASKED, seeds=1)).cells]
    assert keys[: len(fewer)] == fewer and len(set(keys)) == len(keys)
    for seed in (4, 5, 6):
        tables = [cell.case.table for cell in bench.cells if (cell.seed, cell.case.name) == (seed, "left")]
        assert len(tables) == 5 and all(table == tables[0] for table in tables)
    biased = next(cell for cell in bench.cells if cell.label.endswith("imu-bias") and cell.seed == 5)
    assert biased.changes["sensors.seed"] == 5


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
