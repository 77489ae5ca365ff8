"""A slow page is sent less, a fast one everything again; what is hidden is not sent; bad reports are refused."""

import asyncio

import numpy as np
import pytest
from viser import _messages

from surefoot.dashboard.access.client_pace import IN_TIME_S, LATE_S, LEVELS, ClientPace
from surefoot.dashboard.access.frame_report import LONGEST_FRAME_MS, FrameReport, read_report
from surefoot.dashboard.access.paced_messages import HeldPlots, paced
from surefoot.errors import InvalidInput
from tests.support.requests import ask

OPEN = frozenset({"Plots"})
SLOW, FAST = FrameReport("k", 2 * LATE_S, False, OPEN), FrameReport("k", 0.5 * IN_TIME_S, False, OPEN)


def told(*reports):
    """A pace after one report a second."""
    pace = ClientPace()
    for second, report in enumerate(reports):
        pace.take(report, float(second))
    return pace


def data(uuid, value=0.0):
    return _messages.GuiUpdateMessage(uuid, {"data": (np.zeros(2), np.full(2, value))})


def test_a_page_that_says_nothing_is_sent_everything():
    pace = ClientPace()
    assert (pace.plots_s, pace.rest_s, pace.sees("Plots")) == (0.0, 0.0, True)


def test_a_page_that_names_no_tab_is_sent_the_plots():
    assert told(FrameReport("k", 0.01)).sees("Plots")
    assert not told(FrameReport("k", 0.01, hidden=True)).sees("Plots")


def test_of_a_late_page_the_plots_give_way_first_and_then_the_scene():
    paces = [told(*[SLOW] * count) for count in range(8)]
    assert [pace.plots_s for pace in paces] == sorted(pace.plots_s for pace in paces)
    assert paces[1].plots_s > 0.0 == paces[1].rest_s
    assert (paces[7].plots_s, paces[7].rest_s) == (LEVELS[-1].plots_s, LEVELS[-1].rest_s)
    assert paces[7].rest_s > 0.0


def test_a_page_that_is_fast_again_is_sent_everything_again():
    pace = told(*[SLOW] * 8, *[FAST] * (len(LEVELS) - 1))
    assert (pace.plots_s, pace.rest_s) == (0.0, 0.0)


def test_many_reports_at_once_count_as_one():
    pace = ClientPace()
    for _ in range(50):
        pace.take(SLOW, 1.0)
    assert pace.plots_s == LEVELS[1].plots_s


def test_plots_of_a_closed_tab_or_a_hidden_page_are_kept_back_and_the_newest_comes_when_they_are_seen():
    pace = told(FrameReport("k", 0.01, False, frozenset({"Balance"})))
    plots = HeldPlots(pace, {"a": "Plots"})
    other = _messages.GuiUpdateMessage("b", {"value": 1})
    newest = data("a", 2.0)
    assert plots.keep([data("a"), other, newest]) == [other]
    assert plots.due(1.0) == []
    pace.take(FrameReport("k", 0.0, True, OPEN), 2.0)
    assert plots.due(2.0) == []
    pace.take(FAST, 3.0)
    assert plots.due(3.0) == [newest]
    assert not plots


def test_plots_of_a_late_page_come_less_often():
    plots = HeldPlots(told(SLOW), {"a": "Plots"})
    plots.keep([data("a")])
    assert len(plots.due(5.0)) == 1
    plots.keep([data("a")])
    assert plots.due(5.0 + 0.5 * LEVELS[1].plots_s) == []
    assert len(plots.due(5.0 + LEVELS[1].plots_s)) == 1


def test_what_one_page_is_not_sent_another_one_is():
    tabs = {"a": "Plots"}
    hidden = HeldPlots(told(FrameReport("k", 0.01, True, OPEN)), tabs)
    seen = HeldPlots(ClientPace(), tabs)
    message = data("a")
    assert hidden.keep([message]) == seen.keep([message]) == []
    assert (hidden.due(1.0), seen.due(1.0)) == ([], [message])


def test_a_stream_ends_with_the_one_behind_it_and_loses_nothing_else():
    async def windows():
        yield ["one", data("a")]
        yield ["two"]

    async def all_sent():
        pace = told(FrameReport("k", 0.01, True, OPEN))
        pace.take(FrameReport("k", 0.01, False, frozenset({"Help"})), 1.0)
        return [window async for window in paced(windows(), pace, HeldPlots(pace, {"a": "Plots"}))]

    assert asyncio.run(all_sent()) == [["one"], ["two"]]


def test_a_report_is_read():
    report = read_report("/frame-lateness?key=abc&frame_ms=190.5&hidden=0&open=Plots,Disturb")
    assert report == FrameReport("abc", 0.1905, False, frozenset({"Plots", "Disturb"}))


@pytest.mark.parametrize("value", ["nan", "inf", "-1", "1e9", "", "fast"])
def test_a_report_without_a_real_time_is_refused_in_one_line(value):
    with pytest.raises(InvalidInput, match=f"0 to {LONGEST_FRAME_MS:g}") as refused:
        read_report(f"/frame-lateness?key=abc&frame_ms={value}")
    assert "\n" not in str(refused.value)


def test_the_server_refuses_bad_reports_and_unknown_pages(dashboard):
    assert ask(dashboard, "/frame-lateness?key=abc&frame_ms=nan")[0] == 400
    assert ask(dashboard, "/frame-lateness?key=abc&frame_ms=10")[0] == 404
    assert ask(dashboard, "/frame-lateness?" + "x" * 2000)[0] == 400
