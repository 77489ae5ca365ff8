"""Settings refuse what makes no sense, in one line that lists what would have been accepted."""

import dataclasses
import math

import numpy as np
import pytest

from surefoot.control.registry import controllers
from surefoot.control.settings import ControllerSettings
from surefoot.dynamics.terms import COM, FOOT_ROWS, PELVIS, UPPER
from surefoot.errors import InvalidInput

FIELDS = {field.name: field for field in dataclasses.fields(ControllerSettings)}
NUMBERS = [name for name, field in FIELDS.items() if field.metadata["kind"] == "number"]
SWITCHES = [name for name, field in FIELDS.items() if field.metadata["kind"] == "switch"]
CHOICES = [name for name, field in FIELDS.items() if field.metadata["kind"] == "choice"]


def refusal(name: str, value: object) -> str:
    with pytest.raises(InvalidInput) as error:
        ControllerSettings(**{name: value})
    text = str(error.value)
    assert f"controller.{name}" in text
    assert "\n" not in text
    return text


def test_every_field_is_described():
    assert set(NUMBERS) | set(SWITCHES) | set(CHOICES) == set(FIELDS)
    for field in FIELDS.values():
        assert field.metadata["help"]
        assert field.metadata["group"]
        assert field.metadata["equation"]


@pytest.mark.parametrize("name", NUMBERS)
def test_numbers_out_of_range_are_refused_with_the_range(name):
    meta = FIELDS[name].metadata
    valid = f"{meta['low']:g} to {meta['high']:g} {meta['unit']}".strip()
    for value in (meta["low"] - 1e-6, meta["high"] + 1e-6, math.nan, math.inf, -math.inf, 10**400):
        assert f"(valid: {valid})" in refusal(name, value)


@pytest.mark.parametrize("name", NUMBERS)
def test_numbers_of_another_type_are_refused_with_the_range(name):
    meta = FIELDS[name].metadata
    for value in ("60", None, True, [60.0], 1j):
        assert f"{meta['low']:g} to {meta['high']:g}" in refusal(name, value)


@pytest.mark.parametrize("name", NUMBERS)
def test_both_ends_of_a_range_are_accepted_and_whole_numbers_become_floats(name):
    meta = FIELDS[name].metadata
    for value in (meta["low"], meta["high"]):
        assert getattr(ControllerSettings(**{name: value}), name) == value
    whole = ControllerSettings(**{name: math.ceil(meta["low"])})
    assert isinstance(getattr(whole, name), float)


@pytest.mark.parametrize("name", SWITCHES)
def test_switches_take_only_true_and_false(name):
    for value in ("true", 1, 0.0, None):
        assert "(valid: true, false)" in refusal(name, value)


@pytest.mark.parametrize("name", CHOICES)
def test_choices_list_the_choices(name):
    valid = FIELDS[name].metadata["valid"]
    for value in ("none of these", "", 3, None, ["qp"]):
        assert f"(valid: {', '.join(valid)})" in refusal(name, value)
    for value in valid:
        assert getattr(ControllerSettings(**{name: value}), name) == value


def test_unknown_settings_are_refused_with_all_names():
    with pytest.raises(InvalidInput, match="unknown setting") as error:
        controllers()["two-part"].settings({"com_stifness": 60.0})
    assert "controller.com_stifness" in str(error.value)
    assert set(error.value.valid) == set(FIELDS)


def test_settings_cannot_be_changed_afterwards():
    with pytest.raises(dataclasses.FrozenInstanceError):
        ControllerSettings().com_stiffness = 3.0  # type: ignore[misc]


def test_gains_reach_their_rows_of_kappa():
    settings = ControllerSettings(
        com_stiffness=1.0, pelvis_stiffness=2.0, foot_stiffness=3.0, lumbar_stiffness=4.0,
        com_damping=5.0, pelvis_damping=6.0, foot_damping=7.0, lumbar_damping=8.0,
        com_weight=9.0, pelvis_weight=10.0, foot_weight=11.0, lumbar_weight=12.0,
    )  # fmt: skip
    for table, (com, pelvis, foot, lumbar) in (
        (settings.stiffness(21), (1, 2, 3, 4)),
        (settings.damping(21), (5, 6, 7, 8)),
        (settings.weights(21), (9, 10, 11, 12)),
    ):  # fmt: skip
        expected = np.empty(21)
        expected[COM], expected[PELVIS], expected[UPPER] = com, pelvis, lumbar
        for rows in FOOT_ROWS:
            expected[rows] = foot
        assert table.tolist() == expected.tolist()


@pytest.mark.parametrize("name", ["two-part", "optimization", "soft-qp", "two-part-literal"])
def test_presets_are_defaults_that_changes_override(name):
    entry = controllers()[name]
    for key, value in entry.preset.items():
        assert getattr(entry.settings(), key) == value
    assert entry.settings({"guard": True}).guard is True
    assert entry.settings({"guard": False}).guard is False
