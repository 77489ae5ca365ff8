"""Undo and redo of controller and settings: one step a change, a drag is one change, and the past has its own."""

import pickle

import pytest

from surefoot.control.settings import settings_differences
from surefoot.dashboard.engine.coordinator import split
from surefoot.dashboard.engine.session import PAUSE_S, SliderDrags
from surefoot.dashboard.engine.worker import RequestRunner
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.live.undo import MOST_STEPS
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.snapshot import SettingsChange
from surefoot.dashboard.panels.tuning.undo import defaults_html
from surefoot.dashboard.ui.setting_labels import change_text
from tests.support.playback import bits, ticks


def stiffness(playback, value, drag_id=0):
    playback.apply(cmd.ChangeSettings({"com_stiffness": value}, drag_id))


def can_undo(playback):
    change = playback.live.tuning_view.undo
    return change_text(change, 9) if change else None


def can_redo(playback):
    change = playback.live.tuning_view.redo
    return change_text(change, 9) if change else None


def test_steps_are_taken_back_in_order_and_made_again(playback):
    stiffness(playback, 70.0)
    playback.apply(cmd.SetController("soft-qp"))
    playback.apply(cmd.ChangeSettings({"guard": True, "com_damping": 20.0}))
    playback.apply(cmd.ResetSettings())
    seen = []
    while can_undo(playback):
        seen.append(can_undo(playback))
        playback.apply(cmd.UndoSettings())
    assert seen == [
        "CoM K_P 70 → 60, CoM K_D 20 → 14, Capture guard on → off", "CoM K_D 14 → 20, Capture guard off → on",
        "two-part → soft-qp", "CoM K_P 60 → 70",
    ]  # fmt: skip
    assert (playback.live.controller, playback.live.settings) == ("two-part", playback.live.tuning_view.defaults)
    assert not playback.live.changes
    for _ in range(3):
        playback.apply(cmd.RedoSettings())
    assert (playback.live.controller, playback.live.settings.com_damping, playback.live.settings.guard) == (
        "soft-qp",
        20.0,
        True,
    )
    assert can_redo(playback) == "CoM K_P 70 → 60, CoM K_D 20 → 14, Capture guard on → off"
    stiffness(playback, 80.0)
    assert can_redo(playback) is None


def test_a_dragged_slider_is_one_step_and_back_where_it_began_none(playback):
    for value in (61.0, 65.0, 72.0):
        stiffness(playback, value, drag_id=1)
        ticks(playback, 30)
    for value in (75.0, 80.0):
        stiffness(playback, value, drag_id=2)
    stiffness(playback, 90.0, drag_id=3)
    stiffness(playback, 80.0, drag_id=3)
    assert (playback.live.tuning_view.steps, can_undo(playback)) == (2, "CoM K_P 72 → 80")
    playback.apply(cmd.UndoSettings())
    assert playback.live.settings.com_stiffness == 72.0
    playback.apply(cmd.UndoSettings())
    assert playback.live.settings.com_stiffness == 60.0


def test_strokes_end_when_the_hand_rests_or_takes_another_slider():
    strokes = SliderDrags()
    first = strokes.number(["com_stiffness"], 10.0)
    assert first > 0
    assert strokes.number(["com_stiffness"], 10.0 + 0.9 * PAUSE_S) == first
    assert strokes.number(["com_stiffness", "com_damping"], 10.0 + 1.8 * PAUSE_S) == first  # two hands at a time
    second = strokes.number(["com_stiffness"], 10.0 + 2.9 * PAUSE_S)
    third = strokes.number(["zmp_margin"], 10.0 + 2.9 * PAUSE_S)
    strokes.end()
    assert len({first, second, third, strokes.number(["zmp_margin"], 10.0 + 2.9 * PAUSE_S)}) == 4


def test_a_bad_change_is_no_step_and_nothing_to_undo_is_said(playback):
    playback.apply(cmd.UndoSettings())
    assert "nothing was changed" in playback.live.log.events[0].text
    playback.apply(cmd.RedoSettings())
    assert "nothing was undone" in playback.live.log.events[0].text
    stiffness(playback, 1e9)
    playback.apply(cmd.ChangeSettings({"com_stiffness": 60.0}))
    playback.apply(cmd.ResetSettings())
    assert playback.live.tuning_view.steps == 0


def test_the_stack_survives_reset_and_scenario_and_is_bounded(playback):
    stiffness(playback, 70.0)
    playback.apply(cmd.Reset())
    playback.apply(cmd.LoadScenario("push_left"))
    assert playback.live.settings.com_stiffness == 70.0
    playback.apply(cmd.UndoSettings())
    assert playback.live.settings.com_stiffness == 60.0
    for i in range(MOST_STEPS + 5):
        stiffness(playback, 61.0 + i)
    assert playback.live.tuning_view.steps == MOST_STEPS


def test_a_scenario_with_settings_of_its_own_tells_what_undo_will_come_to(playback):
    playback.apply(cmd.ChangeSettings({"delta_ref_frontal_nm": 5.0}))
    playback.apply(cmd.LoadScenario("paper_delta_reference"))
    assert can_undo(playback) == "δ_P ref frontal 20 → 5"
    playback.apply(cmd.UndoSettings())
    assert playback.live.settings.delta_ref_frontal_nm == 20.0


def test_what_a_link_brought_can_be_undone(playback):
    playback.apply(cmd.OpenLink("scenario=push_left&controller=soft-qp&controller.com_stiffness=80"))
    assert (playback.live.controller, playback.live.settings.com_stiffness) == ("soft-qp", 80.0)
    playback.apply(cmd.UndoSettings())
    assert (playback.live.controller, playback.live.settings.com_stiffness) == ("two-part", 60.0)


def test_the_past_has_the_stack_of_then_and_is_the_same_to_the_bit(playback):
    ticks(playback, 100)
    stiffness(playback, 70.0)
    ticks(playback, 100)
    playback.apply(cmd.SetController("soft-qp"))
    ticks(playback, 60)
    playback.apply(cmd.UndoSettings())
    ticks(playback, 60)
    playback.apply(cmd.UndoSettings())
    ticks(playback, 80)
    end = bits(playback)
    assert (can_undo(playback), can_redo(playback)) == (None, "CoM K_P 60 → 70")
    for time_s, undo, redo in ((0.05, None, None), (0.15, "CoM K_P 60 → 70", None), (0.22, "two-part → soft-qp", None),
                               (0.3, "CoM K_P 60 → 70", "two-part → soft-qp")):  # fmt: skip
        playback.apply(cmd.Seek(time_s))
        assert (can_undo(playback), can_redo(playback)) == (undo, redo), time_s
    playback.apply(cmd.Seek(0.05))
    ticks(playback, 350)
    assert bits(playback) == end
    assert can_redo(playback) == "CoM K_P 60 → 70"


def test_undo_in_the_past_forks(playback):
    ticks(playback, 100)
    stiffness(playback, 70.0)
    ticks(playback, 100)
    stiffness(playback, 90.0)
    ticks(playback, 100)
    playback.apply(cmd.Seek(0.15))
    playback.apply(cmd.UndoSettings())
    assert playback.live.settings.com_stiffness == 60.0
    assert any("forked at 0.150 s" in event.text for event in playback.live.log.events)
    ticks(playback, 150)
    assert playback.live.settings.com_stiffness == 60.0
    assert can_redo(playback) == "CoM K_P 60 → 70"


def test_a_lost_performer_is_played_on_with_its_stack(playback):
    stiffness(playback, 70.0)
    spec = RequestRunner(playback).spec_of(playback)
    again = pickle.loads(pickle.dumps(spec))
    new = Playback(again.scenario, again.controller, again.changes, again.friction, again.undo)
    assert can_undo(new) == "CoM K_P 60 → 70"
    new.apply(cmd.UndoSettings())
    assert new.live.settings.com_stiffness == 60.0


def test_the_twin_is_left_alone():
    asked = (cmd.UndoSettings(), cmd.RedoSettings(), cmd.UseSettings(settings={}, label="A"))
    assert split(asked, playing=True, first_over=False, twin_over=False) == (asked, ())


def test_the_picture_sends_the_same_view_until_it_changes(playback):
    before = playback.snapshot().tuning
    ticks(playback, 5)
    assert playback.snapshot().tuning is before
    stiffness(playback, 70.0)
    assert playback.snapshot().tuning is not before


def test_the_line_counts_and_names_what_differs(playback):
    assert "All settings are the defaults of two-part" in defaults_html(playback.snapshot())
    stiffness(playback, 70.0)
    assert "1 setting</b> differs from the defaults: CoM K_P 60 → 70" in defaults_html(playback.snapshot())
    playback.apply(cmd.ChangeSettings({"guard": False, "com_damping": 15.0, "zmp_margin": 0.9, "solver": "clarabel"}))
    said = defaults_html(playback.snapshot())
    assert "5 settings</b> differ from the defaults" in said
    assert said.rstrip("</div>").endswith("and 1 more")
    assert "CoM K_P 60 → 70 1/s²" in said  # in the tooltip, with the unit
    assert len(settings_differences(playback.live.tuning_view.defaults, playback.live.settings)) == 5


@pytest.mark.parametrize(
    ("controller", "values", "most", "text"),
    [
        (("a", "a"), (("com_stiffness", 9.0, 12.0),), 1, "CoM K_P 9 → 12"),
        (("a", "a"), (("com_stiffness", 9.0, 12.0), ("guard", True, False)), 1, "CoM K_P 9 → 12, 1 more"),
        (("a", "b"), (("com_stiffness", 9.0, 12.0), ("guard", True, False)), 1, "a → b, 2 more"),
        (("a", "b"), (), 1, "a → b"),
    ],
)
def test_a_change_in_words(controller, values, most, text):
    assert change_text(SettingsChange(controller=controller, values=values), most) == text
