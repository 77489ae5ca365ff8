"""Undo and redo of controller and settings: one step a change, a drag is one change, and the past has its own."""

import pickle

import pytest

from surefoot.dashboard.engine.slider_drags import PAUSE_S, SliderDrags
from surefoot.dashboard.engine.twin_routing import split
from surefoot.dashboard.engine.worker import BatchRunner
from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.observation.take_snapshot import take_snapshot
from surefoot.dashboard.live.undo import MOST_STEPS
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.snapshot import SettingsChange
from surefoot.dashboard.panels.tuning.undo import defaults_html
from surefoot.dashboard.ui.setting_text import change_text, compared


def ticks(live, count):
    for _ in range(count):
        live.tick()


def bits(live):
    data = live.simulation.plant.data
    return live.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def stiffness(live, value, drag_id=0):
    live.apply(cmd.ChangeSettings({"com_stiffness": value}, drag_id))


def can_undo(live):
    change = live.tuning.undo
    return change_text(change, 9) if change else None


def can_redo(live):
    change = live.tuning.redo
    return change_text(change, 9) if change else None


def test_steps_are_taken_back_in_order_and_made_again(live):
    stiffness(live, 70.0)
    live.apply(cmd.SetController("soft-qp"))
    live.apply(cmd.ChangeSettings({"guard": True, "com_damping": 20.0}))
    live.apply(cmd.ResetSettings())
    seen = []
    while can_undo(live):
        seen.append(can_undo(live))
        live.apply(cmd.UndoSettings())
    assert seen == [
        "CoM K_P 70 → 60, CoM K_D 20 → 14, Capture guard on → off", "CoM K_D 14 → 20, Capture guard off → on",
        "two-part → soft-qp", "CoM K_P 60 → 70",
    ]  # fmt: skip
    assert (live.controller, live.settings) == ("two-part", live.tuning.usual)
    assert not live.changes
    for _ in range(3):
        live.apply(cmd.RedoSettings())
    assert (live.controller, live.settings.com_damping, live.settings.guard) == ("soft-qp", 20.0, True)
    assert can_redo(live) == "CoM K_P 70 → 60, CoM K_D 20 → 14, Capture guard on → off"
    stiffness(live, 80.0)
    assert can_redo(live) is None


def test_a_dragged_slider_is_one_step_and_back_where_it_began_none(live):
    for value in (61.0, 65.0, 72.0):
        stiffness(live, value, drag_id=1)
        ticks(live, 30)
    for value in (75.0, 80.0):
        stiffness(live, value, drag_id=2)
    stiffness(live, 90.0, drag_id=3)
    stiffness(live, 80.0, drag_id=3)
    assert (live.tuning.steps, can_undo(live)) == (2, "CoM K_P 72 → 80")
    live.apply(cmd.UndoSettings())
    assert live.settings.com_stiffness == 72.0
    live.apply(cmd.UndoSettings())
    assert live.settings.com_stiffness == 60.0


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


def test_a_bad_change_is_no_step_and_nothing_to_undo_is_said(live):
    live.apply(cmd.UndoSettings())
    assert "nothing was changed" in live.log.events[0].text
    live.apply(cmd.RedoSettings())
    assert "nothing was undone" in live.log.events[0].text
    stiffness(live, 1e9)
    live.apply(cmd.ChangeSettings({"com_stiffness": 60.0}))
    live.apply(cmd.ResetSettings())
    assert live.tuning.steps == 0


def test_the_stack_survives_reset_and_scenario_and_is_bounded(live):
    stiffness(live, 70.0)
    live.apply(cmd.Reset())
    live.apply(cmd.LoadScenario("push_left"))
    assert live.settings.com_stiffness == 70.0
    live.apply(cmd.UndoSettings())
    assert live.settings.com_stiffness == 60.0
    for i in range(MOST_STEPS + 5):
        stiffness(live, 61.0 + i)
    assert live.tuning.steps == MOST_STEPS


def test_a_scenario_with_settings_of_its_own_tells_what_undo_will_come_to(live):
    live.apply(cmd.ChangeSettings({"delta_ref_frontal_nm": 5.0}))
    live.apply(cmd.LoadScenario("paper_delta_reference"))
    assert can_undo(live) == "δ_P ref frontal 20 → 5"
    live.apply(cmd.UndoSettings())
    assert live.settings.delta_ref_frontal_nm == 20.0


def test_what_a_link_brought_can_be_undone(live):
    live.apply(cmd.OpenLink("scenario=push_left&controller=soft-qp&controller.com_stiffness=80"))
    assert (live.controller, live.settings.com_stiffness) == ("soft-qp", 80.0)
    live.apply(cmd.UndoSettings())
    assert (live.controller, live.settings.com_stiffness) == ("two-part", 60.0)


def test_the_past_has_the_stack_of_then_and_is_the_same_to_the_bit(live):
    ticks(live, 100)
    stiffness(live, 70.0)
    ticks(live, 100)
    live.apply(cmd.SetController("soft-qp"))
    ticks(live, 60)
    live.apply(cmd.UndoSettings())
    ticks(live, 60)
    live.apply(cmd.UndoSettings())
    ticks(live, 80)
    end = bits(live)
    assert (can_undo(live), can_redo(live)) == (None, "CoM K_P 60 → 70")
    for time_s, undo, redo in ((0.05, None, None), (0.15, "CoM K_P 60 → 70", None), (0.22, "two-part → soft-qp", None),
                               (0.3, "CoM K_P 60 → 70", "two-part → soft-qp")):  # fmt: skip
        live.apply(cmd.Seek(time_s))
        assert (can_undo(live), can_redo(live)) == (undo, redo), time_s
    live.apply(cmd.Seek(0.05))
    ticks(live, 350)
    assert bits(live) == end
    assert can_redo(live) == "CoM K_P 60 → 70"


def test_undo_in_the_past_forks(live):
    ticks(live, 100)
    stiffness(live, 70.0)
    ticks(live, 100)
    stiffness(live, 90.0)
    ticks(live, 100)
    live.apply(cmd.Seek(0.15))
    live.apply(cmd.UndoSettings())
    assert live.settings.com_stiffness == 60.0
    assert any("forked at 0.150 s" in event.text for event in live.log.events)
    ticks(live, 150)
    assert live.settings.com_stiffness == 60.0
    assert can_redo(live) == "CoM K_P 60 → 70"


def test_a_lost_performer_is_played_on_with_its_stack(live):
    stiffness(live, 70.0)
    spec = BatchRunner(live)._spec_of(live)
    again = pickle.loads(pickle.dumps(spec))
    new = LiveRun(again.scenario, again.controller, again.changes, again.friction, again.undo)
    assert can_undo(new) == "CoM K_P 60 → 70"
    new.apply(cmd.UndoSettings())
    assert new.settings.com_stiffness == 60.0


def test_the_twin_is_left_alone():
    asked = (cmd.UndoSettings(), cmd.RedoSettings(), cmd.UseSettings(settings={}, label="A"))
    assert split(asked, playing=True, first_over=False, twin_over=False) == (asked, ())


def test_the_picture_sends_the_same_view_until_it_changes(live):
    before = take_snapshot(live).tuning
    ticks(live, 5)
    assert take_snapshot(live).tuning is before
    stiffness(live, 70.0)
    assert take_snapshot(live).tuning is not before


def test_the_line_counts_and_names_what_differs(live):
    assert "All settings are the defaults of two-part" in defaults_html(take_snapshot(live))
    stiffness(live, 70.0)
    assert "1 setting</b> differs from the defaults: CoM K_P 60 → 70" in defaults_html(take_snapshot(live))
    live.apply(cmd.ChangeSettings({"guard": False, "com_damping": 15.0, "zmp_margin": 0.9, "solver": "clarabel"}))
    said = defaults_html(take_snapshot(live))
    assert "5 settings</b> differ from the defaults" in said
    assert said.rstrip("</div>").endswith("and 1 more")
    assert "CoM K_P 60 → 70 1/s²" in said  # in the tooltip, with the unit
    assert len(compared(live.tuning.usual, live.settings)) == 5


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
