"""Links: what they say, what they are refused for, and that only the page itself can cash them in."""

import pytest

from surefoot.dashboard.access.link_handoff import LinkHandoff, _message
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.run_link import asks_for_run, link_query, link_target, read_link
from surefoot.errors import InvalidInput

LINK = "scenario=swing_inward&controller=optimization&controller.com_stiffness=75&physics.friction=0.7"


def test_a_link_names_scenario_controller_and_changed_values():
    link = read_link(LINK)
    scenario, settings = link_target(link)
    assert (scenario.name, link.controller, settings) == ("swing_inward", "optimization", {"com_stiffness": 75})
    assert scenario.physics.friction == 0.7
    assert read_link("").scenario == "stand_left"


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("scenario=no_such", "no such scenario.*stand_left"),
        ("scenario=/etc/passwd", "no such scenario.*stand_left"),
        ("controller=no_such", "two-part"),
        ("controller.no_such=1", "com_stiffness"),
        ("controller.guard=perhaps", "true, false"),
        ("stones.0.height_m=9", "0.001 to 0.1"),
        ("colour=red", "unknown key.*scenario, controller"),
        ("x.y=1", "unknown key"),
        ("controller.guard=false&" * 70, "too many"),
        ("a" * 9000, "too long"),
    ],
)
def test_a_bad_link_is_refused_with_the_choices_listed(playback, query, says):
    with pytest.raises(InvalidInput, match=says):
        link_target(read_link(query))
    before = (playback.live.scenario, playback.live.controller, playback.live.settings, playback.live.simulation)
    playback.apply(cmd.OpenLink(query))
    assert (
        playback.live.scenario,
        playback.live.controller,
        playback.live.settings,
        playback.live.simulation,
    ) == before
    assert playback.live.log.events[0].kind == "error"


def test_the_stage_starts_what_a_link_asks_for_and_the_same_link_comes_back(playback):
    playback.apply(cmd.OpenLink(LINK))
    assert (playback.live.scenario.name, playback.live.controller) == ("swing_inward", "optimization")
    assert (playback.live.settings.com_stiffness, playback.live.friction) == (75.0, 0.7)
    assert "opened by a link" in playback.live.log.events[1].text
    query = link_query(Session(playback).snapshot)
    assert query is not None
    assert read_link(query) == read_link(LINK)


def test_only_pages_with_a_run_in_their_address_get_a_ticket():
    handoff = LinkHandoff()
    assert not asks_for_run("token=abc&x=1")
    assert handoff.issue_cookie("/?token=abc", "document") is None
    assert handoff.issue_cookie("/", "document") is None
    for embedded in ("image", "iframe", "empty", "script"):
        assert handoff.issue_cookie(f"/?{LINK}", embedded) is None
    cookie = handoff.issue_cookie(f"/?{LINK}", "document")
    assert cookie is not None
    assert "HttpOnly" in cookie and "SameSite=Strict" in cookie


def test_a_ticket_is_good_for_once():
    handoff, sent = LinkHandoff(), []
    handoff._send = sent.append
    cookie = handoff.issue_cookie(f"/?{LINK}", "document").partition(";")[0]
    handoff.start_from_cookie("surefoot_link=guessed")
    handoff.start_from_cookie("surefoot_token=x")
    assert sent == []
    handoff.start_from_cookie(f"other=1; {cookie}")
    handoff.start_from_cookie(cookie)
    assert sent == [cmd.OpenLink(LINK)]


def test_a_link_starts_nothing_while_somebody_drives_alone():
    handoff, sent = LinkHandoff(), []
    handoff._send, handoff._driver = sent.append, lambda: 2
    handoff.start_from_cookie(handoff.issue_cookie(f"/?{LINK}", "document").partition(";")[0])
    assert sent == []
    _, text, good = _message(*handoff._arrived.popleft())
    assert not good
    assert "Visitor 2 drives" in text
