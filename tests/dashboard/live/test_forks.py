"""Forks: a change in the past begins another future, which drops and repeats what it should."""

import pytest

from surefoot.dashboard.messages import commands as cmd
from tests.support.playback import recorded_ticks, texts, ticks
from tests.support.rewinding import eventful, first_difference


def test_a_change_of_controller_in_the_past_forks_and_disturbances_come_again(playback):
    eventful(playback)
    playback.apply(cmd.Seek(0.1))
    playback.apply(cmd.ChangeSettings({"com_damping": 15.0}))
    assert "forked at 0.100 s: 4 later disturbances will be repeated" in texts(playback)
    assert playback.history.view().newest_s == pytest.approx(0.1)
    assert playback.history.view().coming_s == pytest.approx((0.16, 0.39, 0.57, 0.87))
    ticks(playback, 480)
    assert (playback.live.controller, playback.live.settings.com_damping, playback.live.settings.com_stiffness) == (
        "two-part",
        15.0,
        60.0,
    )
    assert len(playback.live.simulation.plant.stones.stones) == 1
    assert playback.live.friction == 0.6
    assert texts(playback, "push")
    ticks(playback, 300)
    assert playback.live.simulation.plant.stones.stones == ()
    assert playback.history.view().coming_s == ()


def test_without_repeating_a_fork_is_left_alone(playback):
    eventful(playback)
    playback.apply(cmd.RepeatDisturbances(False))
    playback.apply(cmd.Seek(0.2))
    playback.apply(cmd.SetController("optimization"))
    ticks(playback, 700)
    assert not texts(playback, "push")
    assert len(playback.live.simulation.plant.stones.stones) == 1  # that of 0.16 s, before the fork
    assert playback.live.friction == 0.9


def test_repeating_can_be_switched_off_before_they_come(playback):
    eventful(playback)
    playback.apply(cmd.Seek(0.1))
    playback.apply(cmd.SetController("optimization"))
    ticks(playback, 100)
    assert texts(playback, "stone")
    playback.apply(cmd.RepeatDisturbances(False))
    once = recorded_ticks(playback, 600)
    assert not texts(playback, "push")
    playback.apply(cmd.RepeatDisturbances(True))
    playback.apply(cmd.Seek(0.2))  # seen again as it was, not as it would be now
    assert first_difference(once, recorded_ticks(playback, 600)) is None


def test_a_disturbance_in_the_past_forks_too(playback):
    eventful(playback)
    playback.apply(cmd.Seek(0.15))
    playback.apply(cmd.PushNow(direction_deg=0.0, impulse_ns=2.0))
    assert any(text.startswith("forked at 0.150 s") for text in texts(playback, "fork"))
    once = recorded_ticks(playback, 600)
    assert len(texts(playback, "push")) == 2
    assert playback.live.controller == "two-part"
    playback.apply(cmd.Seek(0.1))  # and the fork itself can be rewound
    assert not texts(playback, "fork")
    assert first_difference(once, recorded_ticks(playback, 650)[50:]) is None
    assert texts(playback, "fork")


def test_what_changes_nothing_does_not_fork(playback):
    eventful(playback)
    playback.apply(cmd.Seek(0.2))
    for command in (cmd.SetController("two-part"), cmd.ChangeSettings({"com_stiffness": 60.0}), cmd.SetSpeed(0.5),
                    cmd.SetController("no such"), cmd.PushNow(direction_deg=0.0, impulse_ns=1e9)):  # fmt: skip
        playback.apply(command)
    assert not texts(playback, "fork")
    playback.apply(cmd.GoLive())
    assert playback.live.simulation.time_s == pytest.approx(1.2)


def test_changes_while_paused_at_the_newest_instant_are_no_fork(playback):
    ticks(playback, 100)
    playback.apply(cmd.Pause())
    playback.apply(cmd.SetController("soft-qp"))
    playback.apply(cmd.Step(-1))
    playback.apply(cmd.Step(1))
    assert playback.live.controller == "soft-qp"
    assert not texts(playback, "fork")


def test_a_fall_can_be_undone_by_another_controller(playback):
    playback.apply(cmd.SetController("optimization"))
    ticks(playback, 100)
    playback.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
    while playback.playing:
        playback.tick()
    fall_s = playback.live.simulation.fall_time_s
    assert playback.live.ended
    first = playback.live.observer.balance_status(ended=True)
    assert first.first_limit == playback.live.simulation.watch.first.name
    playback.apply(cmd.Seek(first.first_limit_s))
    assert playback.live.simulation.fallen is None
    assert not texts(playback, "fall")
    assert any(mark.kind == "fall" and mark.time_s == fall_s for mark in playback.history.view().marks)
    playback.apply(cmd.Seek(0.0))
    playback.apply(cmd.SetController("two-part"))
    playback.apply(cmd.Play())
    while playback.playing and playback.live.simulation.time_s < fall_s + 2.0:
        playback.tick()
    assert playback.live.simulation.fallen is None
    assert all(mark.kind != "fall" for mark in playback.history.view().marks)
