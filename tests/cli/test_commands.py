"""The other commands print what they promise, and a help text for every flag."""

import dataclasses

from surefoot.control.settings import ControllerSettings
from surefoot.equation_ledger import TITLES


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
