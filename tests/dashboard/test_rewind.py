"""Rewind: going back and on again is the same to the bit; forks drop and repeat what they should."""

import pytest

from app.dashboard import commands as ask
from app.dashboard.events import Event
from app.dashboard.history import EVERY_TICKS, HISTORY_TICKS
from app.dashboard.panels.event_steps import event_after, event_before, stops
from app.dashboard.panels.timeline_strip import span_of, strip_html
from app.dashboard.session import Session
from app.dashboard.snapshot import TimelineView


def bits(stage):
    data = stage.simulation.plant.data
    return stage.simulation.time_s, data.qpos.tobytes(), data.qvel.tobytes(), data.ctrl.tobytes()


def ticks(stage, count):
    """Tick on; what the world was after each."""
    seen = []
    for _ in range(count):
        stage.tick()
        seen.append(bits(stage))
    return seen


def first_difference(one, other):
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b), None)


def texts(stage, kind=None):
    return [event.text for event in stage.log.events if kind in (None, event.kind)]


def eventful(stage):
    """1.2 s in which a person does everything; what the world was after each tick."""
    seen = ticks(stage, 160)
    stage.apply(ask.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06))
    seen += ticks(stage, 210)
    stage.apply(ask.SetController("soft-qp"))
    seen += ticks(stage, 20)
    stage.apply(ask.ChangeSettings({"com_stiffness": 70.0}))
    stage.apply(ask.SetFriction(0.6))
    seen += ticks(stage, 180)
    stage.apply(ask.PushNow(direction_deg=90.0, impulse_ns=4.0))
    seen += ticks(stage, 300)
    stage.apply(ask.ClearStones())
    stage.apply(ask.SetController("two-part"))
    return seen + ticks(stage, 330)


def test_ten_seconds_back_and_on_is_the_same_future_to_the_bit(stage):
    ticks(stage, 150)
    once = eventful(stage)
    once += ticks(stage, 10_050 - len(once))
    log = stage.log.events
    assert stage.simulation.time_s == pytest.approx(10.2)
    stage.apply(ask.Seek(0.2))
    assert not stage.playing
    assert stage.simulation.time_s == pytest.approx(0.2)
    assert bits(stage) == once[49]
    assert stage.simulation.plant.stones.stones == ()
    assert not texts(stage, "stone")
    assert first_difference(once[50:], ticks(stage, 10_000)) is None
    assert stage.log.events == log
    assert len(stage.simulation.recorder) == 10_200


def test_every_instant_is_found_exactly(stage):
    once = eventful(stage)
    for tick, step in (
        (1, 10),
        (159, 1),
        (160, 1),
        (1190, -10),
        (161, -1),
        (400, -1),
        (380, 10),
        (871, -2),
        (1200, -1),
    ):
        stage.apply(ask.Seek(1e-3 * tick))
        assert bits(stage) == once[tick - 1]
        stage.apply(ask.Step(step))
        assert bits(stage) == once[tick + step - 1]


def test_steps_go_back_and_forth_and_stop_at_the_start(stage):
    once = ticks(stage, 250)
    for step, expected in ((-1, 249), (-10, 239), (1, 240), (10, 250), (10, 260), (-60, 200), (-1000, 0), (-1, 0)):
        stage.apply(ask.Step(step))
        assert stage.history.tick == expected
        if 0 < expected <= 250:
            assert bits(stage) == once[expected - 1]


def test_live_takes_up_where_the_past_was_left(stage):
    once = eventful(stage)
    stage.apply(ask.Seek(0.3))
    stage.apply(ask.GoLive())
    assert stage.playing
    assert bits(stage) == once[-1]


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


@pytest.mark.parametrize("time_s", [-0.1, 0.151, 1e9, float("nan"), "now"])
def test_what_is_not_kept_is_told_with_what_is(stage, time_s):
    ticks(stage, 150)
    before = bits(stage)
    stage.apply(ask.Seek(time_s))
    assert bits(stage) == before
    assert stage.playing
    assert stage.log.events[0].kind == "error"
    assert "seek.time_s" in texts(stage)[0]
    if isinstance(time_s, float) and time_s == time_s:
        assert "(valid: 0.000 to 0.150 s)" in texts(stage)[0]


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


def test_a_reset_forgets_the_past(stage):
    eventful(stage)
    stage.apply(ask.Reset())
    view = stage.history.view()
    assert (view.oldest_s, view.newest_s, view.marks) == (0.0, 0.0, ())
    ticks(stage, 50)
    stage.apply(ask.Seek(0.01))
    assert stage.simulation.time_s == pytest.approx(0.01)
    assert stage.friction == 0.6
    assert any(text.startswith("reset") for text in texts(stage))


def test_thirty_seconds_are_kept_and_no_more(stage):
    """The window slides; a cheap stand-in for the ticks themselves."""
    history, seconds = stage.history, 33
    stage.apply(ask.PushNow(direction_deg=0.0, impulse_ns=1.0))
    for _ in range(seconds * 1000):
        history.ticked()
    assert history.oldest == seconds * 1000 - HISTORY_TICKS
    assert len(history._kept) == HISTORY_TICKS // EVERY_TICKS + 1
    assert history.journal.entries == []
    assert history.view().marks == ()


def test_only_the_newest_of_many_seeks_is_obeyed(stage):
    ticks(stage, 300)
    session = Session(stage)
    gone = []
    stage.apply, obey = lambda command: (gone.append(command), obey(command)), stage.apply
    for i in range(50):
        session.send(ask.Seek(0.001 * i))
    session.send(ask.SetSpeed(0.5))
    for i in range(50):
        session.send(ask.Seek(0.002 * i))
    session._turn()
    assert gone == [ask.Seek(0.049), ask.SetSpeed(0.5), ask.Seek(0.098)]
    assert stage.history.tick == 98


class Forgetful:
    """A controller that cannot be copied."""

    def __init__(self, inner):
        self.inner, self.generator = inner, (i for i in range(3))

    def reset(self, last_torques=None):
        self.inner.reset(last_torques)

    def tick(self, terms, reference, sensing):
        return self.inner.tick(terms, reference, sensing)


def test_a_controller_that_cannot_be_copied_runs_without_rewind(stage):
    ticks(stage, 250)
    ours = stage.simulation.controller
    stage.simulation.controller = Forgetful(ours)
    ticks(stage, 250)
    assert sum("no rewind" in text for text in texts(stage, "error")) == 1
    stage.apply(ask.Seek(0.1))
    assert "cannot be copied" in texts(stage)[0]
    assert stage.simulation.time_s == pytest.approx(0.5)
    stage.simulation.controller = ours
    once = ticks(stage, 150)
    stage.apply(ask.Seek(0.6))
    assert bits(stage) == once[99]


def test_a_nan_can_be_rewound(stage):
    once = ticks(stage, 150)
    stage.simulation.plant.data.qvel[3] = float("nan")
    stage.tick()
    assert stage.simulation.fallen == "nan"
    stage.apply(ask.Seek(0.1))
    assert bits(stage) == once[99]
    assert stage.simulation.fallen is None
    assert first_difference(once[100:], ticks(stage, 50)) is None


def test_the_strip_shows_marks_once_those_ahead_paler_and_what_will_come_again():
    stone, push = Event(1.0, "stone", "a <stone>"), Event(3.0, "push", "a push")
    view = TimelineView(oldest_s=0.0, newest_s=4.0, now_s=2.0, marks=(stone, push, stone), coming_s=(8.0,), repeat=True)
    assert span_of(view) == (0.0, 8.0)
    text = strip_html(view)
    assert text.count("1.000 s a &lt;stone&gt;") == 1
    assert "8.000 s: comes again" in text
    by_title = {part.split('"')[0]: part for part in text.split('title="')[1:]}
    assert "opacity:1" in by_title["1.000 s a &lt;stone&gt;"]
    assert "opacity:0.55" in by_title["3.000 s a push"]
    assert "left:calc(12.5% " in by_title["1.000 s a &lt;stone&gt;"]
    assert "left:calc(25.0% - 1px);top:0" in text  # the present


def test_the_way_from_event_to_event_stops_once_at_what_belongs_together():
    times = ((1.0, "stone"), (2.0, "controller"), (2.06, "controller"), (2.12, "controller"), (2.12, "push"),
             (3.0, "limit"), (3.0001, "infeasible"))  # fmt: skip
    marks = tuple(Event(time_s, kind, f"{kind} {time_s}") for time_s, kind in times)

    def at(now_s, oldest_s=0.0):
        return TimelineView(oldest_s=oldest_s, newest_s=4.0, now_s=now_s, marks=marks, coming_s=(8.0,), repeat=True)

    assert stops(at(4.0)) == [1.0, 2.0, 2.12, 3.0]
    assert (event_before(at(4.0)), event_after(at(4.0))) == (3.0, None)
    assert (event_before(at(2.12)), event_after(at(2.12))) == (2.0, 3.0)
    assert (event_before(at(0.5)), event_after(at(0.5))) == (None, 1.0)
    assert event_before(at(1.5, oldest_s=1.2)) is None


def test_stepping_from_event_to_event_goes_through_a_real_run(stage):
    once = eventful(stage)
    seen = []
    while (time_s := event_before(stage.history.view())) is not None:
        stage.apply(ask.Seek(time_s))
        seen.append(round(stage.simulation.time_s, 3))
    assert seen == [0.87, 0.57, 0.37, 0.16]
    assert bits(stage) == once[159]
    assert event_after(stage.history.view()) == pytest.approx(0.37)
