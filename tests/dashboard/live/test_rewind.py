"""Rewind: going back and on again is the same to the bit; forks drop and repeat what they should."""

from dataclasses import replace

import pytest

from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.live.rewind.history import EVERY_TICKS, HISTORY_TICKS
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import Event, EventKind
from surefoot.dashboard.messages.snapshot import TimelineView
from surefoot.dashboard.panels.balance.events import event_after, event_before, stops
from surefoot.dashboard.panels.header.timeline import span_of, strip_html
from surefoot.dashboard.ui.palette import EVENT_STYLES
from tests.support.playback import bits, recorded_ticks, texts, ticks
from tests.support.rewinding import eventful, first_difference


def test_ten_seconds_back_and_on_is_the_same_future_to_the_bit(playback):
    ticks(playback, 150)
    once = eventful(playback)
    once += recorded_ticks(playback, 10_050 - len(once))
    log = playback.live.log.events
    assert playback.live.simulation.time_s == pytest.approx(10.2)
    playback.apply(cmd.Seek(0.2))
    assert not playback.playing
    assert playback.live.simulation.time_s == pytest.approx(0.2)
    assert bits(playback) == once[49]
    assert playback.live.simulation.plant.stones.stones == ()
    assert not texts(playback, "stone")
    assert first_difference(once[50:], recorded_ticks(playback, 10_000)) is None
    assert playback.live.log.events == log
    assert len(playback.live.simulation.recorder) == 10_200


def test_every_instant_is_found_exactly(playback):
    once = eventful(playback)
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
        playback.apply(cmd.Seek(1e-3 * tick))
        assert bits(playback) == once[tick - 1]
        playback.apply(cmd.Step(step))
        assert bits(playback) == once[tick + step - 1]


def test_steps_go_back_and_forth_and_stop_at_the_start(playback):
    once = recorded_ticks(playback, 250)
    for step, expected in ((-1, 249), (-10, 239), (1, 240), (10, 250), (10, 260), (-60, 200), (-1000, 0), (-1, 0)):
        playback.apply(cmd.Step(step))
        assert playback.history.tick == expected
        if 0 < expected <= 250:
            assert bits(playback) == once[expected - 1]


def test_live_takes_up_where_the_past_was_left(playback):
    once = eventful(playback)
    playback.apply(cmd.Seek(0.3))
    playback.apply(cmd.GoLive())
    assert playback.playing
    assert bits(playback) == once[-1]


@pytest.mark.parametrize("time_s", [-0.1, 0.151, 1e9, float("nan"), "now"])
def test_what_is_not_kept_is_told_with_what_is(playback, time_s):
    ticks(playback, 150)
    before = bits(playback)
    playback.apply(cmd.Seek(time_s))
    assert bits(playback) == before
    assert playback.playing
    assert playback.live.log.events[0].kind == "error"
    assert "seek.time_s" in texts(playback)[0]
    if isinstance(time_s, float) and time_s == time_s:
        assert "(valid: 0.000 to 0.150 s)" in texts(playback)[0]


def test_a_reset_forgets_the_past(playback):
    eventful(playback)
    playback.apply(cmd.Reset())
    view = playback.history.view()
    assert (view.oldest_s, view.newest_s, view.marks) == (0.0, 0.0, ())
    ticks(playback, 50)
    playback.apply(cmd.Seek(0.01))
    assert playback.live.simulation.time_s == pytest.approx(0.01)
    assert playback.live.friction == 0.6
    assert any(text.startswith("reset") for text in texts(playback))


def test_thirty_seconds_are_kept_and_no_more(playback):
    """The window slides; a cheap stand-in for the ticks themselves."""
    history, seconds = playback.history, 33
    playback.apply(cmd.PushNow(direction_deg=0.0, impulse_ns=1.0))
    for _ in range(seconds * 1000):
        history.ticked()
    assert history.oldest == seconds * 1000 - HISTORY_TICKS
    assert len(history._kept) == HISTORY_TICKS // EVERY_TICKS + 1
    assert history.journal.whole  # what was done is kept: with the start it makes the run again
    assert history.view().marks == ()


def test_only_the_newest_of_many_seeks_is_obeyed(playback):
    ticks(playback, 300)
    session = Session(playback)
    gone = []
    playback.apply, obey = lambda command: (gone.append(command), obey(command)), playback.apply
    for i in range(50):
        session.send(cmd.Seek(0.001 * i))
    session.send(cmd.SetSpeed(0.5))
    for i in range(50):
        session.send(cmd.Seek(0.002 * i))
    session._turn()
    assert gone == [cmd.Seek(0.049), cmd.SetSpeed(0.5), cmd.Seek(0.098)]
    assert playback.history.tick == 98


class Forgetful:
    """A controller that cannot be copied."""

    def __init__(self, inner):
        self.inner, self.generator = inner, (i for i in range(3))

    def reset(self, last_torques=None):
        self.inner.reset(last_torques)

    def tick(self, terms, reference, sensing):
        return self.inner.tick(terms, reference, sensing)


def test_a_controller_that_cannot_be_copied_runs_without_rewind(playback):
    ticks(playback, 250)
    ours = playback.live.simulation.controller
    playback.live.simulation.controller = Forgetful(ours)
    ticks(playback, 250)
    assert sum("no rewind" in text for text in texts(playback, "error")) == 1
    playback.apply(cmd.Seek(0.1))
    assert "cannot be copied" in texts(playback)[0]
    assert playback.live.simulation.time_s == pytest.approx(0.5)
    playback.live.simulation.controller = ours
    once = recorded_ticks(playback, 150)
    playback.apply(cmd.Seek(0.6))
    assert bits(playback) == once[99]


def test_a_nan_can_be_rewound(playback):
    once = recorded_ticks(playback, 150)
    playback.live.simulation.plant.data.qvel[3] = float("nan")
    playback.tick()
    assert playback.live.simulation.fallen == "nan"
    playback.apply(cmd.Seek(0.1))
    assert bits(playback) == once[99]
    assert playback.live.simulation.fallen is None
    assert first_difference(once[100:], recorded_ticks(playback, 50)) is None


def test_the_strip_shows_marks_once_those_ahead_paler_and_what_will_come_again():
    stone, push = Event(1.0, EventKind.STONE, "a <stone>"), Event(3.0, EventKind.PUSH, "a push")
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


def test_stepping_from_event_to_event_goes_through_a_real_run(playback):
    once = eventful(playback)
    seen = []
    while (time_s := event_before(playback.history.view())) is not None:
        playback.apply(cmd.Seek(time_s))
        seen.append(round(playback.live.simulation.time_s, 3))
    assert seen == [0.87, 0.57, 0.37, 0.16]
    assert bits(playback) == once[159]
    assert event_after(playback.history.view()) == pytest.approx(0.37)


@pytest.mark.parametrize("kind", list(EventKind))
def test_every_kind_of_event_has_a_style_and_can_be_drawn(kind):
    bare = TimelineView(oldest_s=0.0, newest_s=4.0, now_s=2.0, marks=(), coming_s=(), repeat=True)
    marked = replace(bare, marks=(Event(1.0, kind, "something"),))
    colour = EVENT_STYLES[kind].colour
    assert strip_html(marked).count(colour) == strip_html(bare).count(colour) + 1
