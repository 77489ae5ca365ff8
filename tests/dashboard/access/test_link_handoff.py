"""Links: what they say, what they are refused for, and that only the page itself can cash them in."""

from dataclasses import replace
from urllib.parse import quote

import pytest

from surefoot.dashboard.access.link_handoff import LinkHandoff
from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.run_link import asks_for_run, link_query, link_target, read_link
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.scenario import load_scenario
from tests.support.small_biped import write_small_robot

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
        ("stones.0.height_m=9", "0.0003 to 0.1"),
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
    assert read_link(query) == replace(read_link(LINK), robot="bip")


WALK = {
    "reference.step_length_m": 0.1 + 0.2,
    "reference.first_foot": "right",
    "ground.tiles.amplitude_m": 0.01,
    "stones_under_steps.offset_x_m": 1 / 3000,
}


def test_a_link_brings_back_what_was_changed_of_the_scenario_to_the_last_digit(playback):
    playback.apply(cmd.LoadScenario("walk_flat", WALK))
    assert "step_length_m = 0.30000000000000004" in playback.live.log.events[1].text
    playback.apply(cmd.SetFriction(0.65))
    started = playback.live.scenario
    query = link_query(playback.snapshot())
    assert query is not None
    scenario, settings = link_target(read_link(query))
    assert settings == {}
    assert scenario == replace(started, physics=replace(started.physics, friction=0.65))
    playback.apply(cmd.OpenLink(query))
    assert playback.live.scenario == scenario
    assert link_query(playback.snapshot()) == query


def test_a_link_tells_only_what_a_link_may_say(playback):
    playback.apply(cmd.LoadScenario("stand_left", {"com_height_m": 0.85}))
    assert playback.live.scenario.com_height_m == 0.85
    assert link_query(playback.snapshot()) is None


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


def cookie_of(handoff, link=LINK):
    return handoff.issue_cookie(f"/?{link}", "document").partition(";")[0]


def test_a_ticket_is_good_for_once():
    handoff, sent = LinkHandoff(), []
    handoff._send = sent.append
    cookie = cookie_of(handoff)
    handoff.start_from_cookie("surefoot_link=guessed")
    handoff.start_from_cookie("surefoot_token=x")
    assert sent == []
    handoff.start_from_cookie(f"other=1; {cookie}")
    handoff.start_from_cookie(cookie)
    assert [command.query for command in sent] == [LINK]


class Newcomers:
    """A server whose clients are let in by hand, and what they are told."""

    def __init__(self):
        self.told = []

    def on_client_connect(self, greet):
        self._greet = greet

    def add_notification(self, title, text, *, color, auto_close_seconds):
        self.told.append((title, text, color))

    def let_one_in(self):
        self._greet(self)


@pytest.fixture
def hall(playback):
    """Links of a dashboard without a browser; its session runs."""
    session, handoff, newcomers = Session(playback), LinkHandoff(), Newcomers()
    handoff.connect(newcomers, session.send, lambda: None, lambda: session.snapshot)
    session.start()
    yield handoff, newcomers
    session.stop()


@pytest.mark.parametrize(
    ("link", "title", "says"),
    [
        (LINK, "Started from the link", "swing_inward"),
        ("controller=zzz", "The link could not be used", "no such controller"),
        ("controller.com_stiffness=-1", "The link could not be used", "com_stiffness"),
        ("reference.com_height_m=0.2", "The link could not be used", "com_height_m"),
        ("stones.7.height_m=0.01", "The link could not be used", "stones"),
        ("colour=red", "The link could not be used", "unknown key"),
    ],
)
def test_a_newcomer_is_told_once_what_has_become_of_the_link(hall, link, title, says):
    handoff, newcomers = hall
    handoff.start_from_cookie(cookie_of(handoff, f"scenario=stand_left&{link}" if "scenario" not in link else link))
    newcomers.let_one_in()
    newcomers.let_one_in()  # somebody else, without a link
    ((told, text, colour),) = newcomers.told
    assert (told, colour) == (title, "green" if title.startswith("Started") else "red")
    assert says in text


def test_nothing_is_told_of_a_link_before_it_was_tried(playback):
    session, handoff, newcomers = Session(playback), LinkHandoff(), Newcomers()
    looked = []

    def newest():
        looked.append(list(newcomers.told))
        before = session.snapshot
        if len(looked) == 3:
            session.start()  # only now the command is obeyed, perhaps at once
        return before

    handoff.connect(newcomers, session.send, lambda: None, newest)
    handoff.start_from_cookie(cookie_of(handoff))
    newcomers.let_one_in()
    session.stop()
    assert len(looked) > 3
    assert not any(looked)
    assert newcomers.told[0][2] == "green"


def test_a_link_starts_nothing_while_somebody_drives_alone():
    handoff, sent, newcomers = LinkHandoff(), [], Newcomers()
    handoff.connect(newcomers, sent.append, lambda: 2, lambda: pytest.fail("nothing to wait for"))
    handoff.start_from_cookie(cookie_of(handoff))
    newcomers.let_one_in()
    assert sent == []
    ((_, text, colour),) = newcomers.told
    assert colour == "red"
    assert "Visitor 2 drives" in text


def test_a_link_carries_the_name_of_a_robot(playback):
    playback.apply(cmd.LoadScenario("push_left"))
    assert read_link(link_query(playback.snapshot())).robot == "bip"
    playback.apply(cmd.ChooseRobot("offset"))
    query = link_query(playback.snapshot())
    assert read_link(query).robot == "offset"
    playback.apply(cmd.ChooseRobot("bip"))
    playback.apply(cmd.OpenLink(query))
    assert (playback.live.scenario.name, playback.live.scenario.robot) == ("push_left", "offset")
    assert link_query(playback.snapshot()) == query
    assert asks_for_run("robot=offset")
    assert read_link("robot=offset").robot == "offset"


def test_a_link_that_names_no_robot_keeps_the_one_that_is_there_in_proportion(tmp_path):
    write_small_robot(tmp_path)
    mine = str(tmp_path / "small" / "robot.toml")
    page = Playback(load_scenario("stand_left", {"robot": mine}, robot_files=True), "two-part")
    page.apply(cmd.OpenLink("scenario=push_left&controller=soft-qp&pushes.0.start_s=0.7"))
    changes = {"robot": mine, "pushes.0.start_s": 0.7}
    assert page.live.scenario == load_scenario("push_left", changes, robot_files=True)
    assert page.live.scenario.pushes[0].impulse_ns < 0.5 * load_scenario("push_left").pushes[0].impulse_ns
    page.apply(cmd.OpenLink("scenario=push_left&robot=bip"))
    assert page.live.scenario == load_scenario("push_left")
    page.apply(cmd.OpenLink("robot=" + quote(mine)))
    assert page.live.scenario.robot == "bip" and page.live.log.events[0].kind == "error"
    page.apply(cmd.ChooseRobot(mine))
    assert page.live.scenario.robot == mine


@pytest.mark.parametrize("robot", ["nobody", "/etc/passwd", "robot.toml", "../g1.xml", ""])
def test_a_link_names_no_file_of_a_robot(playback, robot):
    with pytest.raises(InvalidInput, match=r"no such robot.*bip, offset"):
        read_link(f"robot={robot}")
    with pytest.raises(InvalidInput, match="unknown key"):
        read_link(f"robot.path={robot}")
    playback.apply(cmd.OpenLink(f"robot={robot}"))
    assert playback.live.scenario.robot == "bip"
    assert playback.live.log.events[0].kind == "error"
