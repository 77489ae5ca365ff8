"""Commands in: each is obeyed between two ticks, a bad one loses nothing."""

import numpy as np
import pytest

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.commands import PlaceStone, PlaceStoneAtSole
from tests.support.playback import texts, ticks

ANKLE_Y = 0.11  # of the left foot, world


def state(playback):
    live, plant = playback.live, playback.live.simulation.plant
    asked = live.controller, live.settings, live.friction, live.scenario, playback.speed, playback.playing
    return (*asked, plant.stones.stones, plant.data.qpos.tobytes(), plant.data.qvel.tobytes())


def run_until_the_end(playback, most):
    while playback.playing and playback.live.simulation.time_s < most:
        playback.tick()


@pytest.mark.parametrize(
    "command",
    [
        cmd.SetController("no-such-controller"),
        cmd.ChangeSettings({"com_stiffness": 1e9}),
        cmd.ChangeSettings({"com_stiffness": float("nan")}),
        cmd.ChangeSettings({"no_such_setting": 1.0}),
        cmd.ChangeSettings({"saturation": "maybe"}),
        PlaceStone(x_m=0.0, y_m=0.0, height_m=-0.01, size_m=0.06),
        PlaceStone(x_m=0.0, y_m=0.0, height_m=0.01, size_m=9.0),
        PlaceStone(x_m=float("nan"), y_m=0.0, height_m=0.01, size_m=0.06),
        PlaceStoneAtSole(place="the moon", height_m=0.01, size_m=0.06),
        cmd.PushNow(direction_deg=0.0, impulse_ns=1e9),
        cmd.PushNow(direction_deg=0.0, impulse_ns=1.0, link="tail"),
        cmd.SetFriction(-1.0),
        cmd.SetSpeed(100.0),
        cmd.LoadScenario("no_such_scenario"),
    ],
    ids=lambda command: f"{command}"[:50],
)
def test_a_bad_command_is_a_line_of_the_log_and_changes_nothing(playback, command):
    ticks(playback, 20)
    before, lines = state(playback), len(playback.live.log.events)
    playback.apply(command)
    assert state(playback) == before
    assert len(playback.live.log.events) == lines + 1
    assert playback.live.log.events[0].kind == "error"
    ticks(playback, 20)


def test_a_stone_under_a_sole_rises_and_elsewhere_drops(playback):
    ticks(playback, 5)
    for x, y in ((0.05, ANKLE_Y + 0.07), (0.0, -ANKLE_Y), (0.6, 0.6)):
        playback.apply(PlaceStone(x_m=x, y_m=y, height_m=0.01, size_m=0.06))
    stance, swing, free = playback.live.simulation.plant.stones.stones
    assert (stance.drops, swing.drops, free.drops) == (False, False, True)
    assert stance.rise_start_s == pytest.approx(playback.live.simulation.time_s)
    assert stance.rise_duration_s == pytest.approx(0.3)
    first, second, third = reversed(texts(playback, "stone"))
    assert "rises under the left sole" in first
    assert "rises under the right sole" in second
    assert "drops" in third


def test_the_four_places_are_under_the_stance_sole(playback):
    for place in ("outer edge", "inner edge", "toe", "heel"):
        playback.apply(PlaceStoneAtSole(place=place, height_m=0.01, size_m=0.06))
    stones = playback.live.simulation.plant.stones.stones
    assert [stone.drops for stone in stones] == [False] * 4
    assert (stones[0].x_m, stones[0].y_m) == pytest.approx((0.05, ANKLE_Y + 0.07), abs=1e-3)
    assert stones[1].y_m < ANKLE_Y < stones[0].y_m
    assert stones[3].x_m < 0.0 < stones[2].x_m


def test_stones_are_removed_one_by_one_or_all_at_once(playback):
    for place in ("toe", "heel", "outer edge"):
        playback.apply(PlaceStoneAtSole(place=place, height_m=0.005, size_m=0.04))
    playback.apply(cmd.RemoveLastStone())
    assert len(playback.live.simulation.plant.stones.stones) == 2
    playback.apply(cmd.ClearStones())
    assert playback.live.simulation.plant.stones.stones == ()
    playback.apply(cmd.RemoveLastStone())
    assert "there is no stone" in playback.live.log.events[0].text


def test_a_switch_fades_the_torques(playback):
    playback.apply(PlaceStoneAtSole(place="outer edge", height_m=0.005, size_m=0.06))
    ticks(playback, 250)
    before = playback.tick().applied
    steps = []
    playback.apply(cmd.SetController("soft-qp"))
    for _ in range(60):
        result = playback.tick()
        wanted = result.output.torques
        steps.append((np.abs(result.applied - before), 0.1 * np.abs(wanted - before) + 2.0))
        before = result.applied
    assert playback.live.controller == "soft-qp"
    for change, allowed in steps:
        assert (change <= allowed).all()
    assert "two-part -> soft-qp" in playback.live.log.events[0].text


def test_settings_change_by_a_rebuilt_controller_and_can_be_reset(playback):
    ticks(playback, 10)
    old = playback.live.simulation.controller
    playback.apply(cmd.ChangeSettings({"com_stiffness": 90.0, "guard": False}))
    assert playback.live.simulation.controller is not old
    assert (playback.live.settings.com_stiffness, playback.live.settings.guard) == (90.0, False)
    playback.apply(cmd.SetController("optimization"))
    assert playback.live.settings.com_stiffness == 90.0
    playback.apply(cmd.ResetSettings())
    assert playback.live.settings.com_stiffness == 60.0


def test_reset_goes_back_to_the_start_and_keeps_controller_settings_and_friction(playback):
    start = playback.live.simulation.plant.data.qpos.copy()
    playback.apply(cmd.SetController("soft-qp"))
    playback.apply(cmd.ChangeSettings({"com_damping": 20.0}))
    playback.apply(cmd.SetFriction(0.5))
    playback.apply(PlaceStoneAtSole(place="heel", height_m=0.01, size_m=0.06))
    ticks(playback, 200)
    playback.apply(cmd.Reset())
    assert playback.live.simulation.time_s == 0.0
    np.testing.assert_array_equal(playback.live.simulation.plant.data.qpos, start)
    assert playback.live.simulation.plant.stones.stones == ()
    assert (playback.live.controller, playback.live.settings.com_damping, playback.live.friction) == (
        "soft-qp",
        20.0,
        0.5,
    )
    assert float(playback.live.simulation.plant.model.geom("floor").friction[0]) == 0.5


def test_step_pauses_and_advances(playback):
    playback.apply(cmd.Step(10))
    assert not playback.playing
    assert playback.live.simulation.time_s == pytest.approx(0.010)


def test_a_push_now_moves_the_com(playback):
    ticks(playback, 50)
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=10.0, duration_s=0.1))
    for _ in range(100):
        result = playback.tick()
    assert result.terms.velocity_com_in_world[1] > 0.04  # 10 N s on 105 kg, less what the ankle takes
    assert texts(playback, "push")


@pytest.mark.parametrize("scenario", ["stand_left", "swing_inward"])
def test_optimization_falls_where_two_part_stands(playback, scenario):
    for controller, falls in (("optimization", True), ("two-part", False)):
        playback.apply(cmd.SetController(controller))
        playback.apply(cmd.LoadScenario(scenario))
        if scenario == "stand_left":
            ticks(playback, 100)
            playback.apply(PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
        lines = len(texts(playback, "fall"))
        run_until_the_end(playback, 6.0)
        assert (playback.live.simulation.fallen is not None) == falls
        assert len(texts(playback, "fall")) == lines + falls
        if falls:
            assert playback.live.ended and not playback.playing
            assert f"by {playback.live.simulation.fallen}" in texts(playback, "fall")[0]
            assert playback.live.simulation.time_s == pytest.approx(
                playback.live.simulation.fall_time_s + 1.5, abs=0.01
            )
            playback.apply(cmd.Play())
            assert not playback.playing
            assert "Reset" in playback.live.log.events[0].text


def test_a_nan_pauses_at_once_and_a_reset_heals(playback):
    ticks(playback, 10)
    playback.live.simulation.plant.data.qvel[3] = np.nan
    playback.tick()
    assert playback.live.simulation.fallen == "nan"
    assert not playback.playing
    playback.live.observer.geometry()
    playback.live.observer.balance_status(ended=True)
    playback.apply(cmd.Reset())
    ticks(playback, 10)
    assert playback.live.simulation.fallen is None
    assert np.isfinite(playback.live.simulation.plant.data.qpos).all()


def test_a_dragged_slider_leaves_one_line(playback):
    lines = len(playback.live.log.events)
    for stiffness in (61.0, 62.0, 63.0):
        playback.apply(cmd.ChangeSettings({"com_stiffness": stiffness}))
    assert len(playback.live.log.events) == lines + 1
    assert playback.live.log.events[0].text == "com_stiffness = 63.0"
    playback.apply(cmd.ChangeSettings({"com_damping": 15.0}))
    assert len(playback.live.log.events) == lines + 2
