"""Hands that pull and the past: taken back and run on, and hands that nobody confirms."""

import numpy as np

from surefoot.dashboard.messages import commands as ask

HOLD = ask.HoldLink(who="7", link="trunk", point=(0.0, 0.0, 0.1), target=(0.2, 0.11, 1.2))


def ticks(stage, count):
    for _ in range(count):
        stage.tick()


def test_a_hand_that_nobody_confirms_lets_go(stage):
    stage.apply(HOLD)
    ticks(stage, 1500)
    stage.apply(HOLD)
    ticks(stage, 1500)
    assert len(stage.observer.geometry().pulls) == 1
    ticks(stage, 600)
    assert len(stage.observer.geometry().pulls) == 0


def test_stones_hands_and_ground_come_again_to_the_bit_when_the_run_is_seen_again(stage):
    ticks(stage, 50)
    stage.apply(ask.PlaceStoneAtSole(place="toe", height_m=0.005, size_m=0.06, shape="wedge"))
    ticks(stage, 100)
    stage.apply(HOLD)
    ticks(stage, 200)
    stage.apply(ask.LetGo("7"))
    stage.apply(ask.TiltGround(slope_deg=1.0, direction_deg=0.0, duration_s=0.3))
    stage.apply(ask.MoveStone(number=0, x_m=0.5, y_m=0.5))
    ticks(stage, 400)
    then, seen = stage.simulation.plant.data.qpos.copy(), stage.observer.geometry()
    end = stage.simulation.time_s
    stage.apply(ask.Seek(0.2))
    held = stage.observer.geometry()
    assert len(held.pulls) == 1
    assert held.stones[0].stone.x_m != 0.5
    np.testing.assert_array_equal(held.ground_rotation, np.eye(3))
    stage.apply(ask.Seek(end))
    np.testing.assert_array_equal(stage.simulation.plant.data.qpos, then)
    again = stage.observer.geometry()
    assert again.stones == seen.stones
    np.testing.assert_array_equal(again.ground_rotation, seen.ground_rotation)
    assert len(again.pulls) == 0
