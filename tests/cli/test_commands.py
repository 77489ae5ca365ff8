"""The other commands print what they promise, and a help text for every flag."""

import dataclasses
import subprocess
import sys
from pathlib import Path

from surefoot.control.settings import ControllerSettings
from surefoot.equation_ledger import TITLES

ROOT = Path(__file__).resolve().parents[2]


def test_settings_prints_every_setting_with_its_range(surefoot):
    done = surefoot("settings")
    assert done.returncode == 0
    for field in dataclasses.fields(ControllerSettings):
        assert field.name in done.stdout
    assert "0 to 400 1/s2" in done.stdout


def test_equations_prints_every_equation(surefoot):
    done = surefoot("equations")
    assert done.returncode == 0
    for number in TITLES:
        assert f"| ({number}) |" in done.stdout


def test_help_describes_every_flag_of_run(surefoot):
    done = surefoot("run", "--help")
    assert done.returncode == 0
    for flag in ("--controller", "--json", "--out", "--set"):
        assert flag in done.stdout


def test_an_unknown_flag_is_exit_code_two(surefoot):
    done = surefoot("run", "stand_left", "--colour", "red")
    assert done.returncode == 2
    assert "--colour" in done.stderr


def test_the_command_line_starts_without_what_only_its_commands_need():
    heavy = {"mujoco", "pinocchio", "viser", "matplotlib", "pyarrow", "markdown_it", "scipy", "numpy", "rich"}
    code = f"import surefoot.cli.main, sys; print(*{heavy} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT / "app")
    assert done.stdout.strip() == ""
