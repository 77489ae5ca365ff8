"""Every setting has its widget, made from its own description."""

import dataclasses

import pytest

from surefoot.control.registry import controllers
from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.panels.tuning.gains import effects_table
from surefoot.dashboard.panels.tuning.presets import preset_text, read_preset
from surefoot.dashboard.ui.plot_kinds import PLOTS
from surefoot.dashboard.ui.setting_labels import hint_of, label_of, unit_of
from surefoot.dashboard.ui.setting_widgets import fields_of
from surefoot.errors import InvalidInput
from surefoot.resources import help_text, logo

GROUPS = ("gains", "delta", "equations", "weights")


def test_every_setting_is_in_a_group_of_the_page():
    shown = [field.name for group in GROUPS for field in fields_of(group)]
    assert sorted(shown) == sorted(field.name for field in dataclasses.fields(ControllerSettings))


@pytest.mark.parametrize("field", dataclasses.fields(ControllerSettings), ids=lambda field: field.name)
def test_labels_carry_the_unit_and_hints_the_equation(field):
    unit = field.metadata.get("unit", "")
    assert not unit or "[" in label_of(field)
    assert field.metadata["help"] in hint_of(field)
    assert "equation (" in hint_of(field)


def test_texts_and_logo_are_there():
    assert "two-part" in help_text("start")
    assert logo().startswith("<svg")


@pytest.mark.parametrize("name", list(controllers()))
def test_saved_settings_load_again(name):
    settings = controllers()[name].settings()
    table = read_preset(preset_text(name, settings).encode())
    assert ControllerSettings(**table) == settings


@pytest.mark.parametrize("content", [b"", b"com_stiffness = 1.0", b"[controller]", b"controller = 3", b"\xff\xfe",
                                     b"[controller", b" " * 200_000])  # fmt: skip
def test_a_bad_settings_file_is_refused(content):
    with pytest.raises(InvalidInput, match="settings file"):
        read_preset(content)


@pytest.mark.parametrize("field", dataclasses.fields(ControllerSettings), ids=lambda field: field.name)
def test_every_hint_says_unit_effect_of_raising_it_and_plot_to_watch(field):
    hint, meta = hint_of(field), field.metadata
    plots = {plot.key: plot.name for plot in PLOTS}
    assert meta["watch"]
    assert all(f"“{plots[key]}”" in hint for key in meta["watch"])
    if meta["kind"] == "number":
        assert f"Raise it: {meta['raised']}." in hint
        assert len(meta["raised"]) > 10
        assert f"[{unit_of(field) or 'no unit'}]" in hint
        assert f"{meta['low']:g} to {meta['high']:g}" in hint


def test_the_table_of_effects_has_every_number():
    numbers = [field for field in dataclasses.fields(ControllerSettings) if field.metadata["kind"] == "number"]
    rows = effects_table().splitlines()[2:]
    assert len(rows) == len(numbers)
    assert all(any(row.startswith(f"| {label_of(field)} |") for row in rows) for field in numbers)


@pytest.mark.parametrize(("name", "axis", "sign"), [("sagittal", 0, -1.0), ("frontal", 1, 1.0)])
def test_a_raised_reference_moves_the_com_where_its_hint_says(name, axis, sign):
    playback = Playback("stand_left", "two-part", {f"delta_ref_{name}_nm": 20.0})
    assert sign * playback.live.bias.displacement_mm[axis] > 1.0
    field = next(field for field in fields_of("delta") if field.name == f"delta_ref_{name}_nm")
    assert ("backward", "to the left")[axis] in field.metadata["raised"]
