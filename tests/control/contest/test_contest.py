"""A controller from outside takes part: installed, listed, run by the real command, ranked by the bench's own probe."""

import copy
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import load_scenario

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
PAGE = ROOT / "static" / "help" / "contest.md"


@pytest.fixture
def install(tmp_path):
    """Put a package into a folder of its own, as ``pip install --target`` would: its modules, and its dist-info."""

    def put(name: str) -> Path:
        project = tomllib.loads((HERE / name / "pyproject.toml").read_text())
        target, about = tmp_path / "site", project["project"]
        info = target / f"{about['name'].replace('-', '_')}-{about['version']}.dist-info"
        info.mkdir(parents=True)
        for module in project["tool"]["hatch"]["build"]["targets"]["wheel"]["only-include"]:
            shutil.copy(HERE / name / module, target / module)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {about['name']}\nVersion: {about['version']}\n")
        points = [
            f"[{group}]\n" + "\n".join(f"{key} = {value}" for key, value in entries.items())
            for group, entries in about["entry-points"].items()
        ]
        (info / "entry_points.txt").write_text("\n".join(points) + "\n")
        return target

    return put


@pytest.fixture
def surefoot():
    def call(site: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(site), str(ROOT / "app"))), "COLUMNS": "200"}
        command = [sys.executable, "-m", "surefoot", *arguments]
        return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=site, timeout=120)

    return call


@pytest.mark.parametrize("scenario", ["push_left", "stand_double"])
def test_the_worked_example_runs_by_its_name(install, surefoot, scenario):
    changes = ("--set", "duration_s=1.6") if scenario == "push_left" else ("--set", "duration_s=0.5")
    done = surefoot(install("example_controller"), "run", scenario, "--controller", "dcm", "--json", *changes)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert summary["controller"] == "dcm"
    assert summary["fell"] is False
    assert summary["com_error_max_m"] < 0.1


def test_the_settings_it_documents_reach_it(install, surefoot):
    site = install("example_controller")
    done = surefoot(site, "run", "stand_left", "--controller", "dcm", "--set", "controller.zmp_margin=9")
    assert done.returncode == 2
    assert "zmp_margin" in done.stderr


def test_without_the_package_the_name_is_unknown(tmp_path, surefoot):
    done = surefoot(tmp_path, "run", "stand_left", "--controller", "dcm")
    assert done.returncode == 2
    assert "no such controller" in done.stderr


def tsid_can_be_imported() -> bool:
    """Asked in a process of its own: a library that does not match may take the process with it."""
    return subprocess.run([sys.executable, "-c", "import tsid"], capture_output=True).returncode == 0


def test_tsid_is_refused_in_one_line_where_it_cannot_be_imported(install, surefoot):
    if tsid_can_be_imported():
        pytest.skip("TSID can be imported here: the tests below drive it")
    site = install("tsid_controller")
    done = surefoot(site, "run", "stand_left", "--controller", "tsid", "--set", "duration_s=0.01")
    assert done.returncode == 2
    assert "TSID cannot be imported" in done.stderr
    assert "Traceback" not in done.stderr
    others = surefoot(site, "run", "stand_left", "--controller", "two-part", "--set", "duration_s=0.01", "--json")
    assert others.returncode == 0, others.stderr


@pytest.fixture(scope="module")
def tsid_adapter():
    """The adapter's module, or a skip where TSID cannot be imported (scripts/setup_tsid.sh)."""
    if not tsid_can_be_imported():
        pytest.skip("TSID cannot be imported here: scripts/setup_tsid.sh makes an environment where it can")
    spec = importlib.util.spec_from_file_location("surefoot_tsid", HERE / "tsid_controller" / "surefoot_tsid.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def drive(tsid_adapter):
    """Torques (n, 15) of a run with TSID; before tick ``copy_at`` a copy takes over."""

    def run(scenario: str, ticks: int, *, copy_at: int | None = None, changes: dict | None = None):
        wanted = load_scenario(scenario, changes or {})
        simulation = build_simulation(wanted, "two-part", rows=1).simulation
        simulation.controller = tsid_adapter.TSID(simulation.robot, tsid_adapter.entry.settings(wanted.controller))
        torques = []
        for tick in range(ticks):
            if tick == copy_at:
                simulation.controller = copy.deepcopy(simulation.controller)
            output = simulation.tick().output
            assert output is not None
            assert output.status == "solved"
            torques.append(output.torques)
        assert simulation.fallen is None
        return np.array(torques), simulation

    return run


@pytest.mark.parametrize("scenario", ["stand_left", "stand_double"])
def test_tsid_stands(drive, scenario):
    _, simulation = drive(scenario, 1000)
    last = simulation.tick()
    assert np.abs(last.terms.position_com_in_world - last.reference.position_com).max() < 1e-3
    assert np.abs(last.output.zmp_commanded_in_world - last.terms.position_com_in_world[:2]).max() < 1e-2


SMALL_PUSH = {"pushes.0.impulse_ns": 12.0, "pushes.0.start_s": 0.05}


@pytest.mark.parametrize("scenario", ["push_left", "ablation_double_push"])
def test_tsid_survives_a_push_and_decides_the_same_again_to_the_bit_copied_or_not(drive, scenario):
    first, simulation = drive(scenario, 800, changes=SMALL_PUSH)
    last = simulation.tick()
    assert np.abs(last.terms.position_com_in_world - last.reference.position_com).max() < 2e-2
    assert (drive(scenario, 300, changes=SMALL_PUSH)[0] == first[:300]).all()
    assert (drive(scenario, 300, changes=SMALL_PUSH, copy_at=120)[0] == first[:300]).all()


def test_tsid_gives_torques_in_joint_order(drive):
    """Inverse dynamics with our own mass matrix: the joint rows, given the wrench that the base rows leave over."""
    _, simulation = drive("push_left", 150, changes=SMALL_PUSH)
    last = simulation.tick()
    torques, acceleration = simulation.controller._problem.solve(last.terms.state)
    assert (torques == last.output.torques).all()
    generalized = last.terms.mass_matrix.dot(acceleration) + last.terms.bias
    J = last.terms.feet[0].jacobian
    wrench = np.linalg.solve(J[:, :6].T, generalized[:6])
    np.testing.assert_allclose((generalized - J.T.dot(wrench))[6:], torques, atol=1e-8)


def test_tsid_comes_back_from_every_tick_of_a_fall(tsid_adapter):
    """With rows for the motors its solver went round for ever once the robot lay on the ground."""
    wanted = load_scenario("ablation_double_push", {"pushes.0.impulse_ns": 110.0, "pushes.0.start_s": 0.05})
    simulation = build_simulation(wanted, "two-part", rows=1).simulation
    simulation.controller = tsid_adapter.TSID(simulation.robot, tsid_adapter.entry.settings(wanted.controller))
    for _ in range(1500):
        simulation.tick()
    assert simulation.fallen is not None


def test_tsid_takes_part_by_its_name(tsid_adapter, install, surefoot):
    changes = ("--set", "duration_s=0.2", "--set", "drop_height_m=0.01")
    done = surefoot(install("tsid_controller"), "run", "stand_double", "--controller", "tsid", "--json", *changes)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert json.loads(done.stdout)["fell"] is False


def test_a_package_that_cannot_be_loaded_stops_nothing_but_its_own_controller(install, surefoot):
    site = install("example_controller")
    (site / "surefoot_dcm.py").write_text("import no_such_module\n")
    done = surefoot(site, "run", "stand_left", "--set", "duration_s=0.01")
    assert (done.returncode, done.stderr) == (0, "")
    refused = surefoot(site, "run", "stand_left", "--controller", "dcm")
    assert refused.returncode == 2
    assert re.search("'dcm': is not available: .*no_such_module.*valid: two-part, ", refused.stderr)
    assert len(refused.stderr.splitlines()) == 1
    listed = surefoot(site, "settings")
    assert listed.returncode == 0
    assert re.search(r"dcm \(not available\) .*no_such_module", listed.stdout)


def test_the_page_shows_the_example_as_it_is():
    """Every block of the page that is taken from the example stands in it, line by line."""
    page = PAGE.read_text(encoding="utf-8")
    sources = [(HERE / "example_controller" / name).read_text() for name in ("pyproject.toml", "surefoot_dcm.py")]
    blocks = [found[2] for found in re.finditer(r"```(toml|python)\n(.*?)```", page, re.DOTALL)]
    assert len(blocks) >= 2
    for block in blocks:
        assert any(block.strip() in source for source in sources), block
