"""Hands that pull and the past: taken back and run on, and hands that nobody confirms."""

import numpy as np

from surefoot.dashboard.messages import commands as cmd
from tests.support.playback import ticks

HOLD = cmd.HoldLink(client_id="7", link="trunk", point=(0.0, 0.0, 0.1), target=(0.2, 0.11, 1.2))


def test_a_hand_that_nobody_confirms_lets_go(playback):
    playback.apply(HOLD)
    ticks(playback, 1500)
    playback.apply(HOLD)
    ticks(playback, 1500)
    assert len(playback.live.observer.geometry().pulls) == 1
    ticks(playback, 600)
    assert len(playback.live.observer.geometry().pulls) == 0


def test_stones_hands_and_ground_come_again_to_the_bit_when_the_run_is_seen_again(playback):
    ticks(playback, 50)
    playback.apply(cmd.PlaceStoneAtSole(place="toe", height_m=0.005, size_m=0.06, shape="wedge"))
    ticks(playback, 100)
    playback.apply(HOLD)
    ticks(playback, 200)
    playback.apply(cmd.LetGo("7"))
    playback.apply(cmd.TiltGround(slope_deg=1.0, direction_deg=0.0, duration_s=0.3))
    playback.apply(cmd.MoveStone(number=0, x_m=0.5, y_m=0.5))
    ticks(playback, 400)
    then, seen = playback.live.simulation.plant.data.qpos.copy(), playback.live.observer.geometry()
    end = playback.live.simulation.time_s
    playback.apply(cmd.Seek(0.2))
    held = playback.live.observer.geometry()
    assert len(held.pulls) == 1
    assert held.stones[0].stone.x_m != 0.5
    np.testing.assert_array_equal(held.ground_rotation, np.eye(3))
    playback.apply(cmd.Seek(end))
    np.testing.assert_array_equal(playback.live.simulation.plant.data.qpos, then)
    again = playback.live.observer.geometry()
    assert again.stones == seen.stones
    np.testing.assert_array_equal(again.ground_rotation, seen.ground_rotation)
    assert len(again.pulls) == 0
