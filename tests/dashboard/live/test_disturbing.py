"""What a person does with stones, hands and the ground, command by command."""

import numpy as np
import pytest

from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.stone_view import SOLE_PLACES
from surefoot.dashboard.panels.disturb.stones import aimed_stone
from surefoot.dashboard.panels.help.tour import STEPS
from surefoot.dashboard.panels.scenarios.gallery import gallery
from surefoot.experiments.scenario.scenario import load_scenario, shipped_scenarios
from surefoot.simulation.stones import Stone
from tests.support.playback import ticks

ABOVE_TRUNK = (0.3, 0.11, 1.2)


@pytest.mark.parametrize("place", SOLE_PLACES)
def test_a_stone_comes_up_where_it_was_shown_before(playback, place):
    ticks(playback, 5)
    snapshot, robot = Session(playback).snapshot, playback.live.simulation.robot
    shown = aimed_stone(place, Stone(shape="half-ball"), snapshot, robot)
    playback.apply(cmd.PlaceStoneAtSole(place=place, height_m=0.01, size_m=0.06, shape="half-ball"))
    (placed,) = playback.live.simulation.plant.stones.stones
    assert (shown.stone.x_m, shown.stone.y_m) == pytest.approx((placed.x_m, placed.y_m), abs=1e-4)
    ticks(playback, 350)
    (view,) = playback.live.observer.geometry().stones
    assert view.top_m == pytest.approx(0.01) == shown.top_m
    assert view.lengths == shown.lengths


def test_what_is_no_stone_is_not_shown(playback):
    assert aimed_stone("heel", None, Session(playback).snapshot, playback.live.simulation.robot) is None


def test_a_stone_pushed_under_a_sole_rises_anew_and_elsewhere_just_lies(playback):
    playback.apply(cmd.PlaceStone(x_m=0.6, y_m=0.5, height_m=0.03, size_m=0.06, shape="wedge", slope_deg=20.0))
    ticks(playback, 1100)
    playback.apply(cmd.MoveStone(number=0, x_m=0.05, y_m=0.18))
    (moved,) = playback.live.simulation.plant.stones.stones
    assert (moved.shape, moved.slope_deg, moved.height_m) == ("wedge", 20.0, 0.03)
    assert moved.top_at(playback.live.simulation.time_s) == 0.0
    playback.apply(cmd.MoveStone(number=0, x_m=-0.6, y_m=0.5))
    (away,) = playback.live.simulation.plant.stones.stones
    assert away.top_at(playback.live.simulation.time_s) == 0.03
    ticks(playback, 5)


def test_a_hand_holds_moves_and_lets_go(playback):
    ticks(playback, 5)
    for x in (0.1, 0.2, 0.3):
        playback.apply(cmd.HoldLink(client_id="7", link="trunk", point=(0.0, 0.0, 0.1), target=(x, 0.11, 1.2)))
    assert [event.text for event in playback.live.log.events if event.kind == "push"] == ["pull at trunk"]
    (row,) = playback.live.observer.geometry().pulls
    np.testing.assert_allclose(row[3:6], ABOVE_TRUNK)
    assert row[6:9].dot(row[3:6] - row[:3]) > 0.0
    playback.apply(cmd.LetGo("another"))
    assert len(playback.live.simulation.pulls) == 1
    playback.apply(cmd.LetGo("7"))
    assert len(playback.live.observer.geometry().pulls) == 0
    ticks(playback, 5)


@pytest.mark.parametrize(
    "command",
    [
        cmd.PlaceStone(x_m=0.0, y_m=0.0, height_m=0.01, size_m=0.06, shape="cone"),
        cmd.PlaceStone(x_m=0.0, y_m=0.0, height_m=0.01, size_m=0.06, shape="wedge", slope_deg=80.0),
        cmd.MoveStone(number=3, x_m=0.0, y_m=0.0),
        cmd.MoveStone(number=0, x_m=float("nan"), y_m=0.0),
        cmd.RemoveStone(9),
        cmd.HoldLink(client_id="1", link="tail", point=(0.0, 0.0, 0.0), target=ABOVE_TRUNK),
        cmd.HoldLink(client_id="1", link="trunk", point=(0.0, 0.0, 0.0), target=(float("nan"), 0.0, 0.0)),
        cmd.TiltGround(slope_deg=90.0, direction_deg=0.0),
        cmd.TiltGround(slope_deg=1.0, direction_deg=0.0, duration_s=0.0),
    ],
    ids=lambda command: f"{command}"[:60],
)
def test_a_bad_wish_is_a_line_of_the_log_and_changes_nothing(playback, command):
    playback.apply(cmd.PlaceStone(x_m=0.6, y_m=0.5, height_m=0.01, size_m=0.06))
    plant = playback.live.simulation.plant
    before = (plant.stones.state(), plant.ground.tilts, dict(playback.live.simulation.pulls))
    lines = len(playback.live.log.events)
    playback.apply(command)
    assert (plant.stones.state(), plant.ground.tilts, dict(playback.live.simulation.pulls)) == before
    assert len(playback.live.log.events) == lines + 1
    assert playback.live.log.events[0].kind == "error"
    ticks(playback, 5)


def test_the_gallery_shows_every_shipped_scenario_once_and_the_paper_first():
    groups = gallery()
    names = [exhibit.name for exhibits in groups.values() for exhibit in exhibits]
    assert sorted(names) == sorted(shipped_scenarios())
    assert next(iter(groups)) == "The paper"
    assert names[0] == "paper_figure1_stone"
    assert all(exhibit.text and exhibit.title for exhibits in groups.values() for exhibit in exhibits)
    for name in names:
        load_scenario(name)


def test_the_tour_makes_the_baseline_fall_and_the_law_hold_and_walk(playback):
    """What "Do it for me" does, step by step, and that each step is noticed when it has been done."""
    for step in STEPS:
        then = now = playback.snapshot()
        for command in step.commands(now):
            playback.apply(command)
        for _ in range(5000):
            if step.done(now, then):
                break
            if playback.playing:
                playback.tick()
            now = (
                playback.snapshot() if playback.runs and round(1e3 * playback.live.simulation.time_s) % 50 == 0 else now
            )
        assert step.done(now, then), step.title
    assert playback.live.controller == "two-part"
    assert playback.live.simulation.fallen is None
    assert playback.live.simulation.gait.made >= 2
