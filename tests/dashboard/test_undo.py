"""Undo and redo of controller and settings: one step a change, a drag is one change, and the past has its own."""

import pickle

import pytest

from surefoot.dashboard.engine.slider_drags import PAUSE_S, Strokes
from surefoot.dashboard.engine.twin_routing import split
from surefoot.dashboard.engine.worker import Player
from surefoot.dashboard.live.live_run import Stage
from surefoot.dashboard.live.observation.take_snapshot import picture_of
from surefoot.dashboard.live.undo import MOST_STEPS
from surefoot.dashboard.messages import commands as ask
from surefoot.dashboard.messages.snapshot import SettingsChange
from surefoot.dashboard.panels.tuning.undo import defaults_html
from surefoot.dashboard.ui.setting_text import change_text, compared


def ticks(stage, count):
    for _ in range(count):
        stage.tick()


def bits(stage):
    data = stage.simulation.plant.data
    return stage.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def stiffness(stage, value, stroke=0):
    stage.apply(ask.ChangeSettings({"com_stiffness": value}, stroke))


def can_undo(stage):
    change = stage.tuning.undo
    return change_text(change, 9) if change else None


def can_redo(stage):
    change = stage.tuning.redo
    return change_text(change, 9) if change else None


def test_steps_are_taken_back_in_order_and_made_again(stage):
    stiffness(stage, 70.0)
    stage.apply(ask.SetController("soft-qp"))
    stage.apply(ask.ChangeSettings({"guard": True, "com_damping": 20.0}))
    stage.apply(ask.ResetSettings())
    seen = []
    while can_undo(stage):
        seen.append(can_undo(stage))
        stage.apply(ask.UndoSettings())
    assert seen == [
        "CoM K_P 70 → 60, CoM K_D 20 → 14, Capture guard on → off", "CoM K_D 14 → 20, Capture guard off → on",
        "two-part → soft-qp", "CoM K_P 60 → 70",
    ]  # fmt: skip
    assert (stage.controller, stage.settings) == ("two-part", stage.tuning.usual)
    assert not stage.changes
    for _ in range(3):
        stage.apply(ask.RedoSettings())
    assert (stage.controller, stage.settings.com_damping, stage.settings.guard) == ("soft-qp", 20.0, True)
    assert can_redo(stage) == "CoM K_P 70 → 60, CoM K_D 20 → 14, Capture guard on → off"
    stiffness(stage, 80.0)
    assert can_redo(stage) is None


def test_a_dragged_slider_is_one_step_and_back_where_it_began_none(stage):
    for value in (61.0, 65.0, 72.0):
        stiffness(stage, value, stroke=1)
        ticks(stage, 30)
    for value in (75.0, 80.0):
        stiffness(stage, value, stroke=2)
    stiffness(stage, 90.0, stroke=3)
    stiffness(stage, 80.0, stroke=3)
    assert (stage.tuning.steps, can_undo(stage)) == (2, "CoM K_P 72 → 80")
    stage.apply(ask.UndoSettings())
    assert stage.settings.com_stiffness == 72.0
    stage.apply(ask.UndoSettings())
    assert stage.settings.com_stiffness == 60.0


def test_strokes_end_when_the_hand_rests_or_takes_another_slider():
    strokes = Strokes()
    first = strokes.number(["com_stiffness"], 10.0)
    assert first > 0
    assert strokes.number(["com_stiffness"], 10.0 + 0.9 * PAUSE_S) == first
    assert strokes.number(["com_stiffness", "com_damping"], 10.0 + 1.8 * PAUSE_S) == first  # two hands at a time
    second = strokes.number(["com_stiffness"], 10.0 + 2.9 * PAUSE_S)
    third = strokes.number(["zmp_margin"], 10.0 + 2.9 * PAUSE_S)
    strokes.end()
    assert len({first, second, third, strokes.number(["zmp_margin"], 10.0 + 2.9 * PAUSE_S)}) == 4


def test_a_bad_change_is_no_step_and_nothing_to_undo_is_said(stage):
    stage.apply(ask.UndoSettings())
    assert "nothing was changed" in stage.log.events[0].text
    stage.apply(ask.RedoSettings())
    assert "nothing was undone" in stage.log.events[0].text
    stiffness(stage, 1e9)
    stage.apply(ask.ChangeSettings({"com_stiffness": 60.0}))
    stage.apply(ask.ResetSettings())
    assert stage.tuning.steps == 0


def test_the_stack_survives_reset_and_scenario_and_is_bounded(stage):
    stiffness(stage, 70.0)
    stage.apply(ask.Reset())
    stage.apply(ask.LoadScenario("push_left"))
    assert stage.settings.com_stiffness == 70.0
    stage.apply(ask.UndoSettings())
    assert stage.settings.com_stiffness == 60.0
    for i in range(MOST_STEPS + 5):
        stiffness(stage, 61.0 + i)
    assert stage.tuning.steps == MOST_STEPS


def test_a_scenario_with_settings_of_its_own_tells_what_undo_will_come_to(stage):
    stage.apply(ask.ChangeSettings({"delta_ref_frontal_nm": 5.0}))
    stage.apply(ask.LoadScenario("paper_delta_reference"))
    assert can_undo(stage) == "δ_P ref frontal 20 → 5"
    stage.apply(ask.UndoSettings())
    assert stage.settings.delta_ref_frontal_nm == 20.0


def test_what_a_link_brought_can_be_undone(stage):
    stage.apply(ask.OpenLink("scenario=push_left&controller=soft-qp&controller.com_stiffness=80"))
    assert (stage.controller, stage.settings.com_stiffness) == ("soft-qp", 80.0)
    stage.apply(ask.UndoSettings())
    assert (stage.controller, stage.settings.com_stiffness) == ("two-part", 60.0)


def test_the_past_has_the_stack_of_then_and_is_the_same_to_the_bit(stage):
    ticks(stage, 100)
    stiffness(stage, 70.0)
    ticks(stage, 100)
    stage.apply(ask.SetController("soft-qp"))
    ticks(stage, 60)
    stage.apply(ask.UndoSettings())
    ticks(stage, 60)
    stage.apply(ask.UndoSettings())
    ticks(stage, 80)
    end = bits(stage)
    assert (can_undo(stage), can_redo(stage)) == (None, "CoM K_P 60 → 70")
    for time_s, undo, redo in ((0.05, None, None), (0.15, "CoM K_P 60 → 70", None), (0.22, "two-part → soft-qp", None),
                               (0.3, "CoM K_P 60 → 70", "two-part → soft-qp")):  # fmt: skip
        stage.apply(ask.Seek(time_s))
        assert (can_undo(stage), can_redo(stage)) == (undo, redo), time_s
    stage.apply(ask.Seek(0.05))
    ticks(stage, 350)
    assert bits(stage) == end
    assert can_redo(stage) == "CoM K_P 60 → 70"


def test_undo_in_the_past_forks(stage):
    ticks(stage, 100)
    stiffness(stage, 70.0)
    ticks(stage, 100)
    stiffness(stage, 90.0)
    ticks(stage, 100)
    stage.apply(ask.Seek(0.15))
    stage.apply(ask.UndoSettings())
    assert stage.settings.com_stiffness == 60.0
    assert any("forked at 0.150 s" in event.text for event in stage.log.events)
    ticks(stage, 150)
    assert stage.settings.com_stiffness == 60.0
    assert can_redo(stage) == "CoM K_P 60 → 70"


def test_a_lost_performer_is_played_on_with_its_stack(stage):
    stiffness(stage, 70.0)
    recipe = Player(stage)._recipe_of(stage)
    again = pickle.loads(pickle.dumps(recipe))
    new = Stage(again.scenario, again.controller, again.changes, again.friction, again.undo)
    assert can_undo(new) == "CoM K_P 60 → 70"
    new.apply(ask.UndoSettings())
    assert new.settings.com_stiffness == 60.0


def test_the_twin_is_left_alone():
    asked = (ask.UndoSettings(), ask.RedoSettings(), ask.UseSettings(settings={}, label="A"))
    assert split(asked, playing=True, first_over=False, twin_over=False) == (asked, ())


def test_the_picture_sends_the_same_view_until_it_changes(stage):
    before = picture_of(stage).tuning
    ticks(stage, 5)
    assert picture_of(stage).tuning is before
    stiffness(stage, 70.0)
    assert picture_of(stage).tuning is not before


def test_the_line_counts_and_names_what_differs(stage):
    assert "All settings are the defaults of two-part" in defaults_html(picture_of(stage))
    stiffness(stage, 70.0)
    assert "1 setting</b> differs from the defaults: CoM K_P 60 → 70" in defaults_html(picture_of(stage))
    stage.apply(ask.ChangeSettings({"guard": False, "com_damping": 15.0, "zmp_margin": 0.9, "solver": "clarabel"}))
    said = defaults_html(picture_of(stage))
    assert "5 settings</b> differ from the defaults" in said
    assert said.rstrip("</div>").endswith("and 1 more")
    assert "CoM K_P 60 → 70 1/s²" in said  # in the tooltip, with the unit
    assert len(compared(stage.tuning.usual, stage.settings)) == 5


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
