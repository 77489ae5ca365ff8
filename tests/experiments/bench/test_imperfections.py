"""Imperfections of a preset: each field belongs to one, together they are the preset; how a bench takes them."""

import dataclasses
from collections import Counter

import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import BenchRequest, plan_bench
from surefoot.experiments.bench.entries import bench_entries, with_presets
from surefoot.experiments.bench.fingerprint import code_fingerprint, entry_fingerprint
from surefoot.experiments.bench.imperfections import IMPERFECTIONS, PRESETS_OF, imperfections_of, unread, with_seeds
from surefoot.experiments.bench.made_by import command_of
from surefoot.experiments.bench.ranking import beyond_bound
from surefoot.field_metadata import from_mapping
from surefoot.simulation.model_error import ModelErrorSettings
from surefoot.simulation.motors import MotorSettings
from surefoot.simulation.presets import PERFECT, PRESETS
from surefoot.simulation.sensors.settings import SensorSettings

SETTINGS = {"sensors": SensorSettings, "motors": MotorSettings, "model_error": ModelErrorSettings}


def test_every_field_that_a_preset_sets_belongs_to_exactly_one_imperfection():
    owners = Counter((table, key) for table, fields in IMPERFECTIONS.values() for key in fields)
    set_by_presets = {(table, key) for table, presets in PRESETS_OF.items() for of in presets.values() for key in of}
    assert set(owners) == set_by_presets
    assert set(owners.values()) == {1}


@pytest.mark.parametrize("preset", PRESETS)
def test_the_imperfections_of_a_preset_together_are_the_preset(preset):
    changes = {path: value for one in imperfections_of(preset).values() for path, value in one.items()}
    for table, settings in SETTINGS.items():
        mine = {path.partition(".")[2]: value for path, value in changes.items() if path.startswith(f"{table}.")}
        assert dataclasses.replace(from_mapping(settings, mine, table), preset=preset) == settings(preset=preset)
    assert (not changes) == (preset == PERFECT)


def test_the_seed_of_a_cell_is_that_of_its_noise_and_errors_unless_it_is_said():
    assert with_seeds({"motors.bandwidth_hz": 40.0}, 7) == {"motors.bandwidth_hz": 40.0}
    assert with_seeds({"sensors.preset": "lab"}, 7) == {"sensors.seed": 7, "sensors.preset": "lab"}
    assert with_seeds({"sensors.preset": "lab", "sensors.seed": 3}, 7)["sensors.seed"] == 3
    assert with_seeds({"model_error.mass": 0.1}, 7)["model_error.seed"] == 7
    assert with_seeds({"estimator.told_tilt_rad": 1e-3}, 7)["sensors.seed"] == 7


def test_a_controller_may_differ_in_the_scenario_too():
    plain, robot, slow = bench_entries(
        "two-part,two-part+preset=robot+estimator=anchor,two-part+guard=false+motors.bandwidth_hz=40", {}
    )
    assert (plain.changes, plain.scenario) == ({}, {})
    assert robot.changes == {} and robot.scenario == {
        "sensors.preset": "robot", "motors.preset": "robot", "model_error.preset": "robot", "estimator.kind": "anchor",
    }  # fmt: skip
    assert (slow.changes, slow.scenario) == ({"guard": False}, {"motors.bandwidth_hz": 40})


@pytest.mark.parametrize(
    ("label", "names"),
    [
        ("two-part+preset=robot", "sensors.preset"),
        ("two-part+sensors.imu_latency_s=0.003", "sensors.imu_latency_s"),
        ("two-part+preset=bad+estimator=anchor", "perfect, lab, robot, cheap"),
        ("two-part+preset=robot+estimator=oracle", "estimator.kind"),
        ("two-part+duration_s.x=3", "physics."),
    ],
)
def test_what_would_change_nothing_or_something_else_is_refused(label, names):
    with pytest.raises(InvalidInput, match=names):
        bench_entries(label, {})


def test_sensors_are_unread_only_with_the_true_state():
    assert unread({"sensors.preset": "lab"}) == unread({"sensors.preset": "lab", "estimator.kind": "truth"})
    assert unread({"sensors.preset": "lab"}) == ["sensors.preset"]
    assert not unread({"sensors.preset": "lab", "estimator.kind": "anchor"})


def test_a_bench_has_a_column_for_every_preset_and_perfect_is_the_bench_as_ever():
    text = with_presets("two-part", ["perfect", "robot"], "anchor")
    assert text == "two-part,two-part+preset=robot+estimator=anchor"
    request = BenchRequest(controllers=text, families=("stone",), quick=True, seeds=2, first_seed=5)
    both = plan_bench(request)
    alone = plan_bench(dataclasses.replace(request, controllers="two-part"))
    perfect = [cell for cell in both.cells if cell.label == "two-part"]
    assert [cell.key for cell in perfect] == [cell.key for cell in alone.cells]
    robot = [cell for cell in both.cells if cell.label != "two-part"]
    assert {cell.changes["sensors.seed"] for cell in robot} == {5, 6}
    scenario = robot[1].scenario_at(0.01)
    assert scenario.sensors.preset == scenario.motors.preset == scenario.model_error.preset == "robot"
    assert (scenario.sensors.seed, scenario.model_error.seed, scenario.estimator.kind) == (6, 6, "anchor")
    assert "scenario" not in alone.manifest() and set(both.manifest()["scenario"]) == {robot[0].label}


def test_a_change_of_all_reaches_every_cell_and_the_command():
    request = BenchRequest(
        controllers="two-part", families=("slope",), quick=True,
        changes=("sensors.preset=lab", "estimator.kind=anchor", "controller.guard=false"),
    )  # fmt: skip
    bench = plan_bench(request)
    assert all(cell.scenario_at(1.0).sensors.preset == "lab" for cell in bench.cells)
    assert bench.cells[0].settings == {"guard": False}
    assert command_of(bench.manifest()).endswith(
        "--set sensors.preset=lab --set estimator.kind=anchor --set controller.guard=false"
    )
    with pytest.raises(InvalidInput, match=r"sensors\.preset"):
        plan_bench(dataclasses.replace(request, changes=("sensors.preset=lab",)))


def test_an_estimator_that_a_label_says_comes_before_that_of_all_and_of_a_preset():
    _, own = bench_entries("two-part,two-part+estimator=truth", {}, {"estimator.kind": "anchor"})
    assert own.scenario["estimator.kind"] == "truth"
    (perfect,) = bench_entries("two-part+preset=perfect+estimator=anchor", {})
    assert perfect.scenario == {"estimator.kind": "anchor"}
    (of_all,) = bench_entries("two-part+preset=robot", {}, {"estimator.kind": "anchor"})
    assert of_all.scenario["estimator.kind"] == "anchor" and of_all.scenario["sensors.preset"] == "robot"


def test_a_mistake_of_any_controller_shows_before_anything_runs():
    with pytest.raises(InvalidInput, match=r"motors\.coulomb_share"):
        plan_bench(BenchRequest(controllers="two-part,two-part+motors.coulomb_share=9", families=("slope",)))


def test_estimators_of_ours_are_within_the_fingerprint_of_the_code():
    assert entry_fingerprint("two-part", "anchor") == entry_fingerprint("two-part") == code_fingerprint()


def test_no_ledger_is_asked_of_a_plant_that_is_not_the_nominal_robot():
    row = {"survived": True, "eta": 1.1}
    nominal, other = {**row, "other_plant": float("nan")}, {**row, "other_plant": 1.0}
    assert beyond_bound([row, nominal, other]) == [row, nominal]
