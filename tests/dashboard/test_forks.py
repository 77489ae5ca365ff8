"""Forks: a change in the past begins another future, which drops and repeats what it should."""

import pytest

from surefoot.dashboard.messages import commands as cmd
from tests.dashboard.rewinding import eventful, first_difference, texts, ticks


def test_a_change_of_controller_in_the_past_forks_and_disturbances_come_again(live):
    eventful(live)
    live.apply(cmd.Seek(0.1))
    live.apply(cmd.ChangeSettings({"com_damping": 15.0}))
    assert "forked at 0.100 s: 4 later disturbances will be repeated" in texts(live)
    assert live.history.view().newest_s == pytest.approx(0.1)
    assert live.history.view().coming_s == pytest.approx((0.16, 0.39, 0.57, 0.87))
    ticks(live, 480)
    assert (live.controller, live.settings.com_damping, live.settings.com_stiffness) == ("two-part", 15.0, 60.0)
    assert len(live.simulation.plant.stones.stones) == 1
    assert live.friction == 0.6
    assert texts(live, "push")
    ticks(live, 300)
    assert live.simulation.plant.stones.stones == ()
    assert live.history.view().coming_s == ()


def test_without_repeating_a_fork_is_left_alone(live):
    eventful(live)
    live.apply(cmd.RepeatDisturbances(False))
    live.apply(cmd.Seek(0.2))
    live.apply(cmd.SetController("optimization"))
    ticks(live, 700)
    assert not texts(live, "push")
    assert len(live.simulation.plant.stones.stones) == 1  # that of 0.16 s, before the fork
    assert live.friction == 0.9


def test_repeating_can_be_switched_off_before_they_come(live):
    eventful(live)
    live.apply(cmd.Seek(0.1))
    live.apply(cmd.SetController("optimization"))
    ticks(live, 100)
    assert texts(live, "stone")
    live.apply(cmd.RepeatDisturbances(False))
    once = ticks(live, 600)
    assert not texts(live, "push")
    live.apply(cmd.RepeatDisturbances(True))
    live.apply(cmd.Seek(0.2))  # seen again as it was, not as it would be now
    assert first_difference(once, ticks(live, 600)) is None


def test_a_disturbance_in_the_past_forks_too(live):
    eventful(live)
    live.apply(cmd.Seek(0.15))
    live.apply(cmd.PushNow(direction_deg=0.0, impulse_ns=2.0))
    assert any(text.startswith("forked at 0.150 s") for text in texts(live, "fork"))
    once = ticks(live, 600)
    assert len(texts(live, "push")) == 2
    assert live.controller == "two-part"
    live.apply(cmd.Seek(0.1))  # and the fork itself can be rewound
    assert not texts(live, "fork")
    assert first_difference(once, ticks(live, 650)[50:]) is None
    assert texts(live, "fork")


def test_what_changes_nothing_does_not_fork(live):
    eventful(live)
    live.apply(cmd.Seek(0.2))
    for command in (cmd.SetController("two-part"), cmd.ChangeSettings({"com_stiffness": 60.0}), cmd.SetSpeed(0.5),
                    cmd.SetController("no such"), cmd.PushNow(direction_deg=0.0, impulse_ns=1e9)):  # fmt: skip
        live.apply(command)
    assert not texts(live, "fork")
    live.apply(cmd.GoLive())
    assert live.simulation.time_s == pytest.approx(1.2)


def test_changes_while_paused_at_the_newest_instant_are_no_fork(live):
    ticks(live, 100)
    live.apply(cmd.Pause())
    live.apply(cmd.SetController("soft-qp"))
    live.apply(cmd.Step(-1))
    live.apply(cmd.Step(1))
    assert live.controller == "soft-qp"
    assert not texts(live, "fork")


def test_a_fall_can_be_undone_by_another_controller(live):
    live.apply(cmd.SetController("optimization"))
    ticks(live, 100)
    live.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
    while live.playing:
        live.tick()
    fall_s = live.simulation.fall_time_s
    assert live.ended
    first = live.observer.verdict(ended=True)
    assert first.first_limit == live.simulation.watch.first.name
    live.apply(cmd.Seek(first.first_limit_s))
    assert live.simulation.fallen is None
    assert not texts(live, "fall")
    assert any(mark.kind == "fall" and mark.time_s == fall_s for mark in live.history.view().marks)
    live.apply(cmd.Seek(0.0))
    live.apply(cmd.SetController("two-part"))
    live.apply(cmd.Play())
    while live.playing and live.simulation.time_s < fall_s + 2.0:
        live.tick()
    assert live.simulation.fallen is None
    assert all(mark.kind != "fall" for mark in live.history.view().marks)
