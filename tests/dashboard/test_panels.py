"""Every setting has its widget, made from its own description."""

import dataclasses

import pytest

from app.control.registry import controllers
from app.control.settings import ControllerSettings
from app.dashboard.panels.fields import fields_of
from app.dashboard.panels.help import help_text, logo
from app.dashboard.panels.labels import hint_of, label_of
from app.dashboard.preset_file import preset_text, read_preset
from app.errors import InvalidInput

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
