"""Packages of other people with names that we use: on ``PYTHONPATH`` and in the working folder."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

APP = Path(__file__).resolve().parents[2] / "app"
SCENARIO = 'robot = "bip"\nsupport = "left"\nduration_s = 0.01\n'


@pytest.fixture
def foreign(tmp_path):
    """A folder with packages ``app`` and ``pinocchio`` that are not ours, and a scenario."""
    for name in ("app", "pinocchio"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(f'print("the foreign {name} ran")\n')
    (tmp_path / "scenario.toml").write_text(SCENARIO)
    return tmp_path


def call(folder: Path, options: tuple[str, ...], *arguments: str, path: tuple[Path, ...]):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, path))}
    command = [sys.executable, *options, "-m", "surefoot", *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment, timeout=300)


def test_isolated_as_the_script_starts_it_they_are_not_seen(foreign):
    done = call(foreign, ("-I",), "run", "scenario.toml", "--json", path=(foreign,))
    assert done.returncode == 0, done.stderr
    assert '"fell": false' in done.stdout
    assert "foreign" not in done.stdout + done.stderr


def test_the_script_of_the_dashboard_starts_it_isolated():
    assert '/python" -I -m surefoot dashboard' in (APP.parent / "scripts" / "dashboard").read_text()


def test_workers_of_an_isolated_program_are_isolated_too(foreign):
    """A run in a process of its own, started from the folder of the foreign packages."""
    program = (
        "from surefoot.dashboard.engine.process_worker import ProcessWorker\n"
        "from surefoot.dashboard.engine.worker import Request, RunSpec\n"
        "from surefoot.experiments.scenario.scenario import load_scenario\n"
        "worker = ProcessWorker()\n"
        "worker.begin(Request(start=RunSpec(load_scenario('stand_left'), 'two-part'), ticks=5))\n"
        "print('ticks', worker.finish().ticks_done)\n"
        "worker.close()\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(foreign)}
    command = [sys.executable, "-I", "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, cwd=foreign, env=environment, timeout=300)
    assert "ticks 5" in done.stdout, done.stderr


def test_another_pinocchio_found_first_is_named_in_one_line(foreign):
    done = call(foreign, ("-P",), "run", "scenario.toml", path=(APP, foreign))
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert str(foreign / "pinocchio") in line
    assert "PYTHONPATH" in line
    assert "app ran" not in done.stdout


def test_a_library_that_cannot_be_imported_is_named_in_one_line(tmp_path):
    (tmp_path / "scenario.toml").write_text(SCENARIO)
    (tmp_path / "mujoco.py").write_text("from mujoco.core import MjModel\n")
    done = call(tmp_path, ("-P",), "run", "scenario.toml", path=(APP, tmp_path))
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert "mujoco" in line
