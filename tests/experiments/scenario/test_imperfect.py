"""Sensors, estimator, motors and errors of the model, as scenario files and the command line say them."""

import json
import math

import pytest

from surefoot.cli.main import main
from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import BenchRequest, plan_bench
from surefoot.experiments.runs.run import run
from surefoot.experiments.runs.saved_run import scenario_of
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.changes import changes_of
from surefoot.experiments.scenario.imperfect import UNREAD_SENSORS
from surefoot.experiments.scenario.scenario import load_scenario, scenario_from_table
from surefoot.simulation.imperfections import Imperfections
from surefoot.simulation.sensors.settings import SENSOR_PRESETS, SensorSettings
from tests.support.plug_ins import installed, put_package

STAND = {"robot": "bip", "support": "left", "duration_s": 0.2}


@pytest.fixture
def strapdown(tmp_path):
    """An estimator of that name."""
    points = {"strapdown": "tests.support.strapdown:STRAPDOWN"}
    put_package(tmp_path, "strapdown", points, "surefoot.estimators")
    with installed(tmp_path):
        yield


def test_a_preset_is_taken_and_any_figure_of_it_changed():
    scenario = scenario_from_table({**STAND, "sensors": {"preset": "robot", "encoder_noise_rad": 0.0, "seed": 7}})
    sensors, preset = scenario.sensors, SENSOR_PRESETS["robot"]
    assert sensors.encoder_noise_rad == 0.0
    assert sensors.seed == 7
    assert {name: getattr(sensors, name) for name in preset} == {**preset, "encoder_noise_rad": 0.0}


@pytest.mark.parametrize("preset", SENSOR_PRESETS)
def test_a_preset_says_every_figure(preset):
    assert all(getattr(SensorSettings(preset=preset), name) is not None for name in SensorSettings.__dataclass_fields__)
    assert set(SENSOR_PRESETS[preset]) == set(SensorSettings.__dataclass_fields__) - {"preset", "seed", "imu_body"}


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"sensors": {"preset": "best"}}, r"sensors\.preset.*perfect, lab, robot, cheap"),
        ({"sensors": {"preset": ["lab"]}}, r"sensors\.preset"),
        ({"sensors": {"gyro_noise_rad_s": math.nan}}, r"sensors\.gyro_noise_rad_s"),
        ({"sensors": {"gyro_noise": 1.0}}, r"sensors\.gyro_noise.*unknown setting.*gyro_noise_rad_s"),
        ({"sensors": {"seed": -1}}, r"sensors\.seed"),
        ({"sensors": {"imu_body": "head"}}, r"sensors\.imu_body.*base, trunk"),
        ({"estimator": {"kind": "oracle"}}, r"estimator\.kind.*truth"),
        ({"estimator": {"predict": 1}}, r"estimator\.predict.*true, false"),
        ({"estimator": {"told_tilt_rad": math.nan}}, r"estimator\.told_tilt_rad.*0 to 0.05 rad"),
        ({"motors": {"no_load_speed_rad_s": -1.0}}, r"motors\.no_load_speed_rad_s"),
        ({"model_error": {"mass": 0.9}}, r"model_error\.mass"),
    ],
)
def test_what_cannot_be_is_refused_with_what_can(table, words):
    with pytest.raises(InvalidInput, match=words):
        scenario_from_table({**STAND, **table})


def test_a_perfect_scenario_builds_no_imu_no_motors_and_no_senses(simulate):
    simulation = simulate()
    assert simulation.senses is None
    assert simulation.plant.imperfections.imu is None
    assert simulation.plant.imperfections.motors == Imperfections().motors
    assert not simulation.plant.imperfections.model_error.any
    assert simulation.plant.model.nsensor == 0


def test_sensors_that_nobody_reads_are_told():
    for tables, told in (
        ({}, False),
        ({"sensors": {"seed": 3}}, False),
        ({"sensors": {"preset": "lab"}}, True),
        ({"sensors": {"gyro_noise_rad_s": 1e-3}}, True),
        ({"estimator": {"com_offset_rate": 1.0}}, True),  # of an estimator that is not there
    ):
        setup = build_simulation(scenario_from_table({**STAND, **tables}), "two-part", rows=10)
        assert (UNREAD_SENSORS in setup.warnings) == told


def test_a_latency_that_is_no_whole_tick_is_told(strapdown):
    table = {**STAND, "sensors": {"imu_latency_s": 0.0015}, "estimator": {"kind": "strapdown"}}
    (line,) = build_simulation(scenario_from_table(table), "two-part", rows=10).warnings
    assert line.startswith("sensors.imu_latency_s = 0.0015 s is no whole number of ticks")


def test_flags_are_short_for_set_and_set_wins(strapdown, capsys):
    args = ["stand_left", "--set", "duration_s=0.05", "--json"]
    main(["run", *args, "--sensors", "lab", "--estimator", "strapdown", "--motors", "robot", "--model-error", "lab"])
    short = json.loads(capsys.readouterr().out)
    long = ("sensors.preset=lab", "estimator.kind=strapdown", "motors.preset=robot", "model_error.preset=lab")
    main(["run", *args, "--sensors", "cheap", *(part for text in long for part in ("--set", text))])
    spelled = json.loads(capsys.readouterr().out)
    assert short["estimator"] == "strapdown"
    for key in ("dcm_error_p50_mm", "dcm_error_p99_mm", "tilt_error_p99_deg", "position_drift_mm", "yaw_drift_deg"):
        assert short[key] == spelled[key]
        assert math.isfinite(short[key])
    assert 0.0 < short["dcm_error_p50_mm"] <= short["dcm_error_p99_mm"]


def test_the_summary_in_words_says_how_wrong_the_estimator_was(strapdown, capsys):
    main(["run", "stand_left", "--set", "duration_s=0.05", "--sensors", "lab", "--estimator", "strapdown"])
    words = " ".join(capsys.readouterr().out.split())
    assert "strapdown: DCM error" in words
    assert "tilt error p99" in words


def test_a_run_file_brings_the_scenario_back(strapdown):
    table = {"sensors.preset": "robot", "sensors.seed": 5, "estimator.kind": "strapdown", "model_error.preset": "lab"}
    scenario = load_scenario("stand_left", {**table, "duration_s": 0.02})
    result = run(scenario, "two-part")
    assert scenario_of(json.loads(json.dumps(result.manifest))) == scenario
    changes = changes_of(scenario)
    assert changes is not None
    assert load_scenario("stand_left", {**changes, "duration_s": 0.02}) == scenario


def test_the_bench_gives_each_cell_errors_of_its_own():
    request = {"controllers": "two-part", "families": ("tilt",), "quick": True, "seeds": 2}
    plain = plan_bench(BenchRequest(**request)).cells
    noisy = plan_bench(
        BenchRequest(**request, changes=("sensors.preset=lab", "motors.preset=lab", "estimator.kind=anchor"))
    ).cells
    assert all("sensors.seed" not in cell.changes for cell in plain)
    for cell in noisy:
        scenario = cell.scenario_at(cell.case.levels[0])
        assert scenario.sensors.seed == cell.seed
        assert scenario.sensors.preset == "lab"
        assert scenario.motors.preset == "lab"
    assert {cell.seed for cell in noisy} == {0, 1}
    fixed = plan_bench(
        BenchRequest(**request, changes=("sensors.preset=lab", "sensors.seed=9", "estimator.kind=anchor"))
    ).cells
    assert {cell.changes["sensors.seed"] for cell in fixed} == {9}
