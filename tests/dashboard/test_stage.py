"""Commands in: each is obeyed between two ticks, a bad one loses nothing."""

import numpy as np
import pytest

from surefoot.dashboard.messages import commands as ask
from surefoot.dashboard.messages.commands import PlaceStone, PlaceStoneAtSole

ANKLE_Y = 0.11  # of the left foot, world


def ticks(stage, count):
    for _ in range(count):
        stage.tick()


def texts(stage, kind):
    return [event.text for event in stage.log.events if event.kind == kind]


def state(stage):
    data = stage.simulation.plant.data
    return (stage.controller, stage.settings, stage.friction, stage.scenario, stage.speed, stage.playing,
            stage.simulation.plant.stones.stones, data.qpos.tobytes(), data.qvel.tobytes())  # fmt: skip


def run_until_the_end(stage, most):
    while stage.playing and stage.simulation.time_s < most:
        stage.tick()


@pytest.mark.parametrize(
    "command",
    [
        ask.SetController("no-such-controller"),
        ask.ChangeSettings({"com_stiffness": 1e9}),
        ask.ChangeSettings({"com_stiffness": float("nan")}),
        ask.ChangeSettings({"no_such_setting": 1.0}),
        ask.ChangeSettings({"saturation": "maybe"}),
        PlaceStone(x_m=0.0, y_m=0.0, height_m=-0.01, size_m=0.06),
        PlaceStone(x_m=0.0, y_m=0.0, height_m=0.01, size_m=9.0),
        PlaceStone(x_m=float("nan"), y_m=0.0, height_m=0.01, size_m=0.06),
        PlaceStoneAtSole(place="the moon", height_m=0.01, size_m=0.06),
        ask.PushNow(direction_deg=0.0, impulse_ns=1e9),
        ask.PushNow(direction_deg=0.0, impulse_ns=1.0, link="tail"),
        ask.SetFriction(-1.0),
        ask.SetSpeed(100.0),
        ask.LoadScenario("no_such_scenario"),
    ],
    ids=lambda command: f"{command}"[:50],
)
def test_a_bad_command_is_a_line_of_the_log_and_changes_nothing(stage, command):
    ticks(stage, 20)
    before, lines = state(stage), len(stage.log.events)
    stage.apply(command)
    assert state(stage) == before
    assert len(stage.log.events) == lines + 1
    assert stage.log.events[0].kind == "error"
    ticks(stage, 20)


def test_a_stone_under_a_sole_rises_and_elsewhere_drops(stage):
    ticks(stage, 5)
    for x, y in ((0.05, ANKLE_Y + 0.07), (0.0, -ANKLE_Y), (0.6, 0.6)):
        stage.apply(PlaceStone(x_m=x, y_m=y, height_m=0.01, size_m=0.06))
    stance, swing, free = stage.simulation.plant.stones.stones
    assert (stance.drops, swing.drops, free.drops) == (False, False, True)
    assert stance.rise_start_s == pytest.approx(stage.simulation.time_s)
    assert stance.rise_duration_s == pytest.approx(0.3)
    first, second, third = reversed(texts(stage, "stone"))
    assert "rises under the left sole" in first
    assert "rises under the right sole" in second
    assert "drops" in third


def test_the_four_places_are_under_the_stance_sole(stage):
    for place in ("outer edge", "inner edge", "toe", "heel"):
        stage.apply(PlaceStoneAtSole(place=place, height_m=0.01, size_m=0.06))
    stones = stage.simulation.plant.stones.stones
    assert [stone.drops for stone in stones] == [False] * 4
    assert (stones[0].x_m, stones[0].y_m) == pytest.approx((0.05, ANKLE_Y + 0.07), abs=1e-3)
    assert stones[1].y_m < ANKLE_Y < stones[0].y_m
    assert stones[3].x_m < 0.0 < stones[2].x_m


def test_stones_are_removed_one_by_one_or_all_at_once(stage):
    for place in ("toe", "heel", "outer edge"):
        stage.apply(PlaceStoneAtSole(place=place, height_m=0.005, size_m=0.04))
    stage.apply(ask.RemoveLastStone())
    assert len(stage.simulation.plant.stones.stones) == 2
    stage.apply(ask.ClearStones())
    assert stage.simulation.plant.stones.stones == ()
    stage.apply(ask.RemoveLastStone())
    assert "there is no stone" in stage.log.events[0].text


def test_a_switch_fades_the_torques(stage):
    stage.apply(PlaceStoneAtSole(place="outer edge", height_m=0.005, size_m=0.06))
    ticks(stage, 250)
    before = stage.tick().applied
    steps = []
    stage.apply(ask.SetController("soft-qp"))
    for _ in range(60):
        result = stage.tick()
        wanted = result.output.torques
        steps.append((np.abs(result.applied - before), 0.1 * np.abs(wanted - before) + 2.0))
        before = result.applied
    assert stage.controller == "soft-qp"
    for change, allowed in steps:
        assert (change <= allowed).all()
    assert "two-part -> soft-qp" in stage.log.events[0].text


def test_settings_change_by_a_rebuilt_controller_and_can_be_reset(stage):
    ticks(stage, 10)
    old = stage.simulation.controller
    stage.apply(ask.ChangeSettings({"com_stiffness": 90.0, "guard": False}))
    assert stage.simulation.controller is not old
    assert (stage.settings.com_stiffness, stage.settings.guard) == (90.0, False)
    stage.apply(ask.SetController("optimization"))
    assert stage.settings.com_stiffness == 90.0
    stage.apply(ask.ResetSettings())
    assert stage.settings.com_stiffness == 60.0


def test_reset_goes_back_to_the_start_and_keeps_controller_settings_and_friction(stage):
    start = stage.simulation.plant.data.qpos.copy()
    stage.apply(ask.SetController("soft-qp"))
    stage.apply(ask.ChangeSettings({"com_damping": 20.0}))
    stage.apply(ask.SetFriction(0.5))
    stage.apply(PlaceStoneAtSole(place="heel", height_m=0.01, size_m=0.06))
    ticks(stage, 200)
    stage.apply(ask.Reset())
    assert stage.simulation.time_s == 0.0
    np.testing.assert_array_equal(stage.simulation.plant.data.qpos, start)
    assert stage.simulation.plant.stones.stones == ()
    assert (stage.controller, stage.settings.com_damping, stage.friction) == ("soft-qp", 20.0, 0.5)
    assert float(stage.simulation.plant.model.geom("floor").friction[0]) == 0.5


def test_step_pauses_and_advances(stage):
    stage.apply(ask.Step(10))
    assert not stage.playing
    assert stage.simulation.time_s == pytest.approx(0.010)


def test_a_push_now_moves_the_com(stage):
    ticks(stage, 50)
    stage.apply(ask.PushNow(direction_deg=90.0, impulse_ns=10.0, duration_s=0.1))
    for _ in range(100):
        result = stage.tick()
    assert result.terms.velocity_com_in_world[1] > 0.04  # 10 N s on 105 kg, less what the ankle takes
    assert texts(stage, "push")


@pytest.mark.parametrize("scenario", ["stand_left", "swing_inward"])
def test_optimization_falls_where_two_part_stands(stage, scenario):
    for controller, falls in (("optimization", True), ("two-part", False)):
        stage.apply(ask.SetController(controller))
        stage.apply(ask.LoadScenario(scenario))
        if scenario == "stand_left":
            ticks(stage, 100)
            stage.apply(PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
        lines = len(texts(stage, "fall"))
        run_until_the_end(stage, 6.0)
        assert (stage.simulation.fallen is not None) == falls
        assert len(texts(stage, "fall")) == lines + falls
        if falls:
            assert stage.ended and not stage.playing
            assert f"by {stage.simulation.fallen}" in texts(stage, "fall")[0]
            assert stage.simulation.time_s == pytest.approx(stage.simulation.fall_time_s + 1.5, abs=0.01)
            stage.apply(ask.Play())
            assert not stage.playing
            assert "Reset" in stage.log.events[0].text


def test_a_nan_pauses_at_once_and_a_reset_heals(stage):
    ticks(stage, 10)
    stage.simulation.plant.data.qvel[3] = np.nan
    stage.tick()
    assert stage.simulation.fallen == "nan"
    assert not stage.playing
    stage.observer.geometry()
    stage.observer.verdict(ended=True)
    stage.apply(ask.Reset())
    ticks(stage, 10)
    assert stage.simulation.fallen is None
    assert np.isfinite(stage.simulation.plant.data.qpos).all()


def test_a_dragged_slider_leaves_one_line(stage):
    lines = len(stage.log.events)
    for stiffness in (61.0, 62.0, 63.0):
        stage.apply(ask.ChangeSettings({"com_stiffness": stiffness}))
    assert len(stage.log.events) == lines + 1
    assert stage.log.events[0].text == "com_stiffness = 63.0"
    stage.apply(ask.ChangeSettings({"com_damping": 15.0}))
    assert len(stage.log.events) == lines + 2
