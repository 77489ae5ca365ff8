"""The same small biped as URDF and as MJCF: the same robot and the same run; and where its path is taken."""

import json

import numpy as np
import pytest

from surefoot.cli.main import main
from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.robots import sha256_now
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import RobotState
from tests.support.small_biped import SPHERE_SOLE, bent, biped
from tests.support.small_urdf import urdf

SCENARIO = 'robot = "robot_{kind}.toml"\nsupport = "left"\nduration_s = 0.2\n'


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "small.urdf").write_text(urdf())
    (tmp_path / "small.xml").write_text(biped(sole=SPHERE_SOLE, joint='range="-1.5 1.5"'))
    for kind in ("urdf", "xml"):
        (tmp_path / f"robot_{kind}.toml").write_text(bent(f"small.{kind}"))
        (tmp_path / f"{kind}.toml").write_text(SCENARIO.format(kind=kind))
    return tmp_path


@pytest.fixture
def scenarios(folder):
    return [load_scenario(folder / f"{kind}.toml", robot_files=True) for kind in ("urdf", "xml")]


def test_both_are_the_same_robot(scenarios):
    one, two = (scenario.robot_description() for scenario in scenarios)
    assert [joint.name for joint in one.joints] == [joint.name for joint in two.joints]
    assert one.mass_kg == pytest.approx(two.mass_kg, rel=1e-12)
    assert one.torque_limits == pytest.approx(two.torque_limits)
    assert one.joint_lower == pytest.approx(two.joint_lower)
    for left, right in zip(one.feet, two.feet, strict=True):
        assert left.corners_from_ankle == pytest.approx(right.corners_from_ankle, abs=1e-12)
    random, models = np.random.default_rng(5), [DynamicsModel(one), DynamicsModel(two)]
    for _ in range(3):
        q = np.concatenate((random.normal(size=3), (0.0, 0.6, 0.0, 0.8), random.uniform(-1.0, 1.0, len(one.joints))))
        state = RobotState(q, random.normal(size=one.dofs))
        terms = [model.evaluate(state) for model in models]
        assert terms[0].mass_matrix == pytest.approx(terms[1].mass_matrix, abs=1e-12)
        assert terms[0].bias == pytest.approx(terms[1].bias, abs=1e-11)


def test_both_make_the_same_run(scenarios):
    one, two = (run(scenario, "two-part") for scenario in scenarios)
    assert not one.summary["fell"]
    assert one.recorder.columns == two.recorder.columns
    tables = [dict(zip(one.recorder.columns, run.recorder.table().T, strict=True)) for run in (one, two)]
    for column in ("com_x_m", "com_y_m", "com_z_m", "force_left_n"):
        scale = np.abs(tables[1][column]).max()
        assert tables[0][column] == pytest.approx(tables[1][column], abs=1e-7 * scale), column


def test_commands_take_the_path_of_a_urdf(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    main(["robot", "check", "small.urdf", "--json"])
    assert json.loads(capsys.readouterr().out)["fit"]
    main(["robot", "init", "small.urdf", "--out", "mine.toml"])
    assert 'mjcf = "small.urdf"' in (folder / "mine.toml").read_text()
    capsys.readouterr()
    main(["run", "stand_double", "--robot", "small.urdf", "--set", "duration_s=0.02", "--json"])
    assert not json.loads(capsys.readouterr().out)["fell"]


def test_a_scenario_names_it_and_its_hash_is_that_of_the_files(folder):
    (folder / "urdf.toml").write_text('robot = "small.urdf"\nsupport = "left"\nduration_s = 0.1\n')
    scenario = load_scenario(folder / "urdf.toml", robot_files=True)
    assert scenario.robot == str(folder / "small.urdf")
    before = sha256_now(scenario.robot)
    assert scenario.robot_description().sha256 == before
    (folder / "small.urdf").write_text(urdf().replace("0.15", "0.16"))
    assert sha256_now(scenario.robot) != before
    (folder / "urdf.toml").write_text('robot = "small.xacro"\nsupport = "left"\nduration_s = 0.1\n')
    (folder / "small.xacro").write_text(urdf())
    with pytest.raises(InvalidInput, match="must be expanded first"):
        load_scenario(folder / "urdf.toml", robot_files=True).robot_description()
