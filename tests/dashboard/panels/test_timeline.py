"""The timeline's slider follows the run, but is never taken out of a person's hand."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.messages.commands import Seek
from surefoot.dashboard.panels.header.timeline import TimelinePanel


def at(snapshot, now_s):
    """The same run, live, somewhat later."""
    return replace(snapshot, timeline=replace(snapshot.timeline, oldest_s=0.0, newest_s=now_s, now_s=now_s))


def timeline(playback, server):
    """A panel that follows a run, its slider, what it sent, and a picture of the run at 20 s."""
    first, sent = at(Session(playback).snapshot, 20.0), []
    panel = TimelinePanel(SimpleNamespace(gui=server.gui, send=sent.append, newest=lambda: first))
    (slider,) = (handle for handle in server.gui._gui_input_handle_from_uuid.values() if handle.label == "t [s]")
    return panel, slider, sent, first


def test_what_a_person_has_set_is_not_overwritten_before_its_callback_has_run(playback, server):
    panel, slider, sent, first = timeline(playback, server)
    panel.show(at(first, 20.5))
    assert slider.value == 20.5

    slider._impl.value = 10.0  # what viser does with a browser's message, before it looks for a thread for the callback
    panel.show(at(first, 20.6))
    assert slider.value == 10.0
    panel.show(replace(first, timeline=replace(first.timeline, newest_s=20.6, now_s=10.0)))  # the run has followed
    panel.show(at(first, 20.7))  # and goes on
    assert slider.value == 20.7
    assert not any(isinstance(command, Seek) for command in sent)  # that is the callback's


@pytest.mark.parametrize("callback_first", [True, False])
def test_it_follows_a_run_that_was_played_on_before_a_picture_showed_the_instant(playback, server, callback_first):
    panel, slider, sent, first = timeline(playback, server)

    def call_back():
        for callback in slider._impl.update_cb:
            callback(SimpleNamespace(client=object(), target=slider))

    for seeks in (1, 2):  # the same instant twice
        slider._impl.value = 10.0
        if callback_first:
            call_back()
        else:
            before = at(first, 20.0 + seeks)
            panel.show(replace(before, timeline=replace(before.timeline, seeks=seeks - 1, sought_s=10.0)))
            assert slider.value == 10.0
            call_back()
        assert sent == [Seek(10.0)] * seeks
        later = at(first, 10.1 + seeks)
        panel.show(replace(later, timeline=replace(later.timeline, seeks=seeks, sought_s=10.0)))
        assert slider.value == 10.1 + seeks


def test_a_history_says_how_often_and_where_it_was_gone_to(playback):
    for _ in range(50):
        playback.tick()
    assert playback.history.view().seeks == 0
    for seeks in (1, 2):
        playback.apply(Seek(0.02))
        playback.tick()
        view = playback.history.view()
        assert (view.seeks, view.sought_s, round(view.now_s, 6)) == (seeks, 0.02, 0.021)
