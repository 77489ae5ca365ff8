"""Forks: a change in the past begins another future, which drops and repeats what it should."""

import pytest

from surefoot.dashboard.messages import commands as ask
from tests.dashboard.rewinding import eventful, first_difference, texts, ticks


def test_a_change_of_controller_in_the_past_forks_and_disturbances_come_again(stage):
    eventful(stage)
    stage.apply(ask.Seek(0.1))
    stage.apply(ask.ChangeSettings({"com_damping": 15.0}))
    assert "forked at 0.100 s: 4 later disturbances will be repeated" in texts(stage)
    assert stage.history.view().newest_s == pytest.approx(0.1)
    assert stage.history.view().coming_s == pytest.approx((0.16, 0.39, 0.57, 0.87))
    ticks(stage, 480)
    assert (stage.controller, stage.settings.com_damping, stage.settings.com_stiffness) == ("two-part", 15.0, 60.0)
    assert len(stage.simulation.plant.stones.stones) == 1
    assert stage.friction == 0.6
    assert texts(stage, "push")
    ticks(stage, 300)
    assert stage.simulation.plant.stones.stones == ()
    assert stage.history.view().coming_s == ()


def test_without_repeating_a_fork_is_left_alone(stage):
    eventful(stage)
    stage.apply(ask.RepeatDisturbances(False))
    stage.apply(ask.Seek(0.2))
    stage.apply(ask.SetController("optimization"))
    ticks(stage, 700)
    assert not texts(stage, "push")
    assert len(stage.simulation.plant.stones.stones) == 1  # that of 0.16 s, before the fork
    assert stage.friction == 0.9


def test_repeating_can_be_switched_off_before_they_come(stage):
    eventful(stage)
    stage.apply(ask.Seek(0.1))
    stage.apply(ask.SetController("optimization"))
    ticks(stage, 100)
    assert texts(stage, "stone")
    stage.apply(ask.RepeatDisturbances(False))
    once = ticks(stage, 600)
    assert not texts(stage, "push")
    stage.apply(ask.RepeatDisturbances(True))
    stage.apply(ask.Seek(0.2))  # seen again as it was, not as it would be now
    assert first_difference(once, ticks(stage, 600)) is None


def test_a_disturbance_in_the_past_forks_too(stage):
    eventful(stage)
    stage.apply(ask.Seek(0.15))
    stage.apply(ask.PushNow(direction_deg=0.0, impulse_ns=2.0))
    assert any(text.startswith("forked at 0.150 s") for text in texts(stage, "fork"))
    once = ticks(stage, 600)
    assert len(texts(stage, "push")) == 2
    assert stage.controller == "two-part"
    stage.apply(ask.Seek(0.1))  # and the fork itself can be rewound
    assert not texts(stage, "fork")
    assert first_difference(once, ticks(stage, 650)[50:]) is None
    assert texts(stage, "fork")


def test_what_changes_nothing_does_not_fork(stage):
    eventful(stage)
    stage.apply(ask.Seek(0.2))
    for command in (ask.SetController("two-part"), ask.ChangeSettings({"com_stiffness": 60.0}), ask.SetSpeed(0.5),
                    ask.SetController("no such"), ask.PushNow(direction_deg=0.0, impulse_ns=1e9)):  # fmt: skip
        stage.apply(command)
    assert not texts(stage, "fork")
    stage.apply(ask.GoLive())
    assert stage.simulation.time_s == pytest.approx(1.2)


def test_changes_while_paused_at_the_newest_instant_are_no_fork(stage):
    ticks(stage, 100)
    stage.apply(ask.Pause())
    stage.apply(ask.SetController("soft-qp"))
    stage.apply(ask.Step(-1))
    stage.apply(ask.Step(1))
    assert stage.controller == "soft-qp"
    assert not texts(stage, "fork")


def test_a_fall_can_be_undone_by_another_controller(stage):
    stage.apply(ask.SetController("optimization"))
    ticks(stage, 100)
    stage.apply(ask.PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
    while stage.playing:
        stage.tick()
    fall_s = stage.simulation.fall_time_s
    assert stage.ended
    first = stage.observer.verdict(ended=True)
    assert first.first_limit == stage.simulation.watch.first.name
    stage.apply(ask.Seek(first.first_limit_s))
    assert stage.simulation.fallen is None
    assert not texts(stage, "fall")
    assert any(mark.kind == "fall" and mark.time_s == fall_s for mark in stage.history.view().marks)
    stage.apply(ask.Seek(0.0))
    stage.apply(ask.SetController("two-part"))
    stage.apply(ask.Play())
    while stage.playing and stage.simulation.time_s < fall_s + 2.0:
        stage.tick()
    assert stage.simulation.fallen is None
    assert all(mark.kind != "fall" for mark in stage.history.view().marks)
