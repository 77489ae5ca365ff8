"""Commands in: each is obeyed between two ticks, a bad one loses nothing."""

import numpy as np
import pytest

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.commands import PlaceStone, PlaceStoneAtSole

ANKLE_Y = 0.11  # of the left foot, world


def ticks(live, count):
    for _ in range(count):
        live.tick()


def texts(live, kind):
    return [event.text for event in live.log.events if event.kind == kind]


def state(live):
    data = live.simulation.plant.data
    return (live.controller, live.settings, live.friction, live.scenario, live.speed, live.playing,
            live.simulation.plant.stones.stones, data.qpos.tobytes(), data.qvel.tobytes())  # fmt: skip


def run_until_the_end(live, most):
    while live.playing and live.simulation.time_s < most:
        live.tick()


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
def test_a_bad_command_is_a_line_of_the_log_and_changes_nothing(live, command):
    ticks(live, 20)
    before, lines = state(live), len(live.log.events)
    live.apply(command)
    assert state(live) == before
    assert len(live.log.events) == lines + 1
    assert live.log.events[0].kind == "error"
    ticks(live, 20)


def test_a_stone_under_a_sole_rises_and_elsewhere_drops(live):
    ticks(live, 5)
    for x, y in ((0.05, ANKLE_Y + 0.07), (0.0, -ANKLE_Y), (0.6, 0.6)):
        live.apply(PlaceStone(x_m=x, y_m=y, height_m=0.01, size_m=0.06))
    stance, swing, free = live.simulation.plant.stones.stones
    assert (stance.drops, swing.drops, free.drops) == (False, False, True)
    assert stance.rise_start_s == pytest.approx(live.simulation.time_s)
    assert stance.rise_duration_s == pytest.approx(0.3)
    first, second, third = reversed(texts(live, "stone"))
    assert "rises under the left sole" in first
    assert "rises under the right sole" in second
    assert "drops" in third


def test_the_four_places_are_under_the_stance_sole(live):
    for place in ("outer edge", "inner edge", "toe", "heel"):
        live.apply(PlaceStoneAtSole(place=place, height_m=0.01, size_m=0.06))
    stones = live.simulation.plant.stones.stones
    assert [stone.drops for stone in stones] == [False] * 4
    assert (stones[0].x_m, stones[0].y_m) == pytest.approx((0.05, ANKLE_Y + 0.07), abs=1e-3)
    assert stones[1].y_m < ANKLE_Y < stones[0].y_m
    assert stones[3].x_m < 0.0 < stones[2].x_m


def test_stones_are_removed_one_by_one_or_all_at_once(live):
    for place in ("toe", "heel", "outer edge"):
        live.apply(PlaceStoneAtSole(place=place, height_m=0.005, size_m=0.04))
    live.apply(cmd.RemoveLastStone())
    assert len(live.simulation.plant.stones.stones) == 2
    live.apply(cmd.ClearStones())
    assert live.simulation.plant.stones.stones == ()
    live.apply(cmd.RemoveLastStone())
    assert "there is no stone" in live.log.events[0].text


def test_a_switch_fades_the_torques(live):
    live.apply(PlaceStoneAtSole(place="outer edge", height_m=0.005, size_m=0.06))
    ticks(live, 250)
    before = live.tick().applied
    steps = []
    live.apply(cmd.SetController("soft-qp"))
    for _ in range(60):
        result = live.tick()
        wanted = result.output.torques
        steps.append((np.abs(result.applied - before), 0.1 * np.abs(wanted - before) + 2.0))
        before = result.applied
    assert live.controller == "soft-qp"
    for change, allowed in steps:
        assert (change <= allowed).all()
    assert "two-part -> soft-qp" in live.log.events[0].text


def test_settings_change_by_a_rebuilt_controller_and_can_be_reset(live):
    ticks(live, 10)
    old = live.simulation.controller
    live.apply(cmd.ChangeSettings({"com_stiffness": 90.0, "guard": False}))
    assert live.simulation.controller is not old
    assert (live.settings.com_stiffness, live.settings.guard) == (90.0, False)
    live.apply(cmd.SetController("optimization"))
    assert live.settings.com_stiffness == 90.0
    live.apply(cmd.ResetSettings())
    assert live.settings.com_stiffness == 60.0


def test_reset_goes_back_to_the_start_and_keeps_controller_settings_and_friction(live):
    start = live.simulation.plant.data.qpos.copy()
    live.apply(cmd.SetController("soft-qp"))
    live.apply(cmd.ChangeSettings({"com_damping": 20.0}))
    live.apply(cmd.SetFriction(0.5))
    live.apply(PlaceStoneAtSole(place="heel", height_m=0.01, size_m=0.06))
    ticks(live, 200)
    live.apply(cmd.Reset())
    assert live.simulation.time_s == 0.0
    np.testing.assert_array_equal(live.simulation.plant.data.qpos, start)
    assert live.simulation.plant.stones.stones == ()
    assert (live.controller, live.settings.com_damping, live.friction) == ("soft-qp", 20.0, 0.5)
    assert float(live.simulation.plant.model.geom("floor").friction[0]) == 0.5


def test_step_pauses_and_advances(live):
    live.apply(cmd.Step(10))
    assert not live.playing
    assert live.simulation.time_s == pytest.approx(0.010)


def test_a_push_now_moves_the_com(live):
    ticks(live, 50)
    live.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=10.0, duration_s=0.1))
    for _ in range(100):
        result = live.tick()
    assert result.terms.velocity_com_in_world[1] > 0.04  # 10 N s on 105 kg, less what the ankle takes
    assert texts(live, "push")


@pytest.mark.parametrize("scenario", ["stand_left", "swing_inward"])
def test_optimization_falls_where_two_part_stands(live, scenario):
    for controller, falls in (("optimization", True), ("two-part", False)):
        live.apply(cmd.SetController(controller))
        live.apply(cmd.LoadScenario(scenario))
        if scenario == "stand_left":
            ticks(live, 100)
            live.apply(PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
        lines = len(texts(live, "fall"))
        run_until_the_end(live, 6.0)
        assert (live.simulation.fallen is not None) == falls
        assert len(texts(live, "fall")) == lines + falls
        if falls:
            assert live.ended and not live.playing
            assert f"by {live.simulation.fallen}" in texts(live, "fall")[0]
            assert live.simulation.time_s == pytest.approx(live.simulation.fall_time_s + 1.5, abs=0.01)
            live.apply(cmd.Play())
            assert not live.playing
            assert "Reset" in live.log.events[0].text


def test_a_nan_pauses_at_once_and_a_reset_heals(live):
    ticks(live, 10)
    live.simulation.plant.data.qvel[3] = np.nan
    live.tick()
    assert live.simulation.fallen == "nan"
    assert not live.playing
    live.observer.geometry()
    live.observer.verdict(ended=True)
    live.apply(cmd.Reset())
    ticks(live, 10)
    assert live.simulation.fallen is None
    assert np.isfinite(live.simulation.plant.data.qpos).all()


def test_a_dragged_slider_leaves_one_line(live):
    lines = len(live.log.events)
    for stiffness in (61.0, 62.0, 63.0):
        live.apply(cmd.ChangeSettings({"com_stiffness": stiffness}))
    assert len(live.log.events) == lines + 1
    assert live.log.events[0].text == "com_stiffness = 63.0"
    live.apply(cmd.ChangeSettings({"com_damping": 15.0}))
    assert len(live.log.events) == lines + 2
