"""Whole sets of settings: presets that ship, files, and the slots A and B."""

import dataclasses

import pytest

from surefoot.control.registry import controllers
from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.panels.compare.ab_slots import Slot, slots_html
from surefoot.dashboard.panels.tuning.presets import preset_html, preset_text, read_preset, shipped_presets
from surefoot.errors import InvalidInput
from surefoot.experiments.paper.plan import GAINS


def test_the_shipped_presets_are_described_and_hold_what_the_project_defines():
    presets = shipped_presets()
    assert len(presets) >= 5
    assert all(len(preset.text) > 20 for preset in presets.values())
    entries = controllers()
    assert presets["as_printed"].settings == entries["two-part-literal"].preset
    assert presets["equal_weights"].settings == entries["soft-qp"].preset
    sweep = [{key.partition(".")[2]: value for key, value in gains.changes} for gains in GAINS]
    com = [preset for name, preset in presets.items() if name.startswith("com_")]
    assert com
    assert all(dict(preset.settings) in sweep for preset in com)


@pytest.mark.parametrize("name", list(shipped_presets()))
def test_a_preset_becomes_the_defaults_and_what_it_names(playback, name):
    preset = shipped_presets()[name]
    playback.apply(cmd.ChangeSettings({"foot_damping": 20.0}))
    assert "differs from the defaults in" in preset_html(preset, playback.snapshot())
    playback.apply(cmd.UseSettings(settings=preset.settings, label=f"preset {name}"))
    assert playback.live.settings == controllers()["two-part"].settings(preset.settings)
    assert playback.live.changes == {
        k: v for k, v in preset.settings.items() if v != getattr(playback.live.tuning_view.defaults, k)
    }
    assert "at work now" in preset_html(preset, playback.snapshot())
    for _ in range(30):
        playback.tick()
    playback.apply(cmd.UndoSettings())
    assert playback.live.changes == {"foot_damping": 20.0}


def test_a_set_can_bring_its_controller_and_a_bad_one_changes_nothing(playback):
    settings = controllers()["soft-qp"].settings({"com_stiffness": 80.0})
    playback.apply(cmd.UseSettings(settings=dataclasses.asdict(settings), label="settings B", controller="soft-qp"))
    assert (playback.live.controller, playback.live.settings, dict(playback.live.changes)) == (
        "soft-qp",
        settings,
        {"com_stiffness": 80.0},
    )
    before = playback.live.settings, playback.live.tuning_view.steps
    for settings, controller in (({"no_such": 1.0}, ""), ({}, "nobody"), ({"com_stiffness": float("nan")}, "")):
        bad = cmd.UseSettings(settings=settings, label="x", controller=controller)
        playback.apply(bad)
        assert playback.live.log.events[0].kind == "error"
        assert "valid: " in playback.live.log.events[0].text
    assert (playback.live.settings, playback.live.tuning_view.steps) == before


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"[controller]\ncom_stifness = 1.0", "unknown setting (valid: com_stiffness"),
        (b"[controller]\ncom_stiffness = 1e9", "valid: 0 to 400 1/s2"),
        (b"[controller]\ncom_stiffness = nan", "valid: 0 to 400 1/s2"),
        (b'[controller]\nsaturation = "maybe"', "valid: none, clip, consistent"),
        (b"[controler]\ncom_stiffness = 60.0", "has no table [controller] with settings in it (valid: com_stiffness"),
        (b"[controller", "is not valid TOML"),
    ],
)
def test_a_bad_file_is_refused_with_what_would_be_right(content, reason):
    with pytest.raises(InvalidInput) as refused:
        read_preset(content)
    assert reason in str(refused.value)


def test_a_saved_file_is_read_back():
    settings = ControllerSettings(com_stiffness=12.5, guard=False, saturation="clip")
    assert ControllerSettings(**read_preset(preset_text("two-part", settings).encode())) == settings


def test_a_file_with_the_old_name_of_a_setting_is_read():
    assert read_preset(b'[controller]\nrest = "inverse-dynamics"') == {"other_joints": "inverse-dynamics"}


def test_the_table_of_a_and_b_names_units_and_what_is_at_work():
    a = Slot("two-part", ControllerSettings())
    b = Slot("two-part", ControllerSettings(com_stiffness=90.0, guard=False))
    assert "Nothing is stored yet" in slots_html({}, a)
    assert "A is at work; change something, and store it as B" in slots_html({"A": a}, a)
    both = slots_html({"A": a, "B": b}, b)
    assert "at work: <b>B</b>" in both
    assert "2 differ" in both
    row = both.split("CoM K_P [1/s²]</td>")[1].split("</tr>")[0]
    assert row.index(">60<") < row.index(">90<")
    assert "Controller" not in both
    neither = slots_html({"A": a, "B": b}, Slot("soft-qp", b.settings))
    assert "at work: neither" in neither
    assert neither.count(">two-part<") == 2
    assert neither.count(">soft-qp<") == 1
    assert "They are the same" in slots_html({"A": a, "B": a}, a)
    assert "at work: <b>A = B</b>" in slots_html({"A": a, "B": a}, a)
