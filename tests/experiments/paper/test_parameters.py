"""Every number has an origin, and every reading of the paper points at something that exists."""

from dataclasses import fields

import pytest

from surefoot.control.settings import ControllerSettings
from surefoot.equation_ledger import TITLES
from surefoot.experiments.paper.parameters import ORIGINS, parameters
from surefoot.experiments.paper.sources import constants
from surefoot.experiments.paper.tables import deviations

EQUATION_SWITCHES = {f.name for f in fields(ControllerSettings) if f.metadata.get("group") == "equations"}


def test_constants_are_found_in_the_sources():
    found = {(constant.module, constant.name) for constant in constants()}
    assert {
        ("surefoot.control.balance.capture_guard", "GUARD_SCALE"),
        ("surefoot.control.controllers.two_part", "GATE_ROLL_RAD"),
        ("surefoot.simulation.falls", "TRUNK_TILT_RAD"),
        ("surefoot.simulation.physics", "CONTACT_SOLREF"),
        ("surefoot.task.posture", "DEFAULT_COM_HEIGHT"),
    } <= found


@pytest.mark.parametrize("constant", list(constants()), ids=lambda constant: f"{constant.module}.{constant.name}")
def test_every_constant_says_what_it_is(constant):
    assert constant.meaning, "write a comment beside it, or a line in app/surefoot/experiments/paper/sources.py"


def test_table_names_settings_robot_and_constants_each_with_an_origin(invented_findings):
    rows = parameters(invented_findings(lambda case: False))
    names = {row.name for row in rows}
    numbers = {f.name for f in fields(ControllerSettings) if f.metadata["kind"] == "number"}
    assert numbers <= names
    assert {"m", "g", "h = |AP|", "sole", "simulation.physics.TIMESTEP_S"} <= names
    assert {row.origin for row in rows} == set(ORIGINS)
    assert all(row.value and row.meaning for row in rows)


def test_every_switch_of_the_equations_is_the_reading_of_some_gap():
    switches = {reading.switch for reading in deviations() if reading.switch}
    assert switches >= EQUATION_SWITCHES
    assert switches <= {f.name for f in fields(ControllerSettings)}


def test_readings_name_equations_that_exist():
    for reading in deviations():
        assert set(reading.equations) <= set(TITLES)
        assert reading.printed != reading.ours
