"""A saved run of a robot that did not know its state: the replay shows what was believed, from the record alone."""

import numpy as np
import pytest

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.replay.frames import ReplayFrames
from tests.support.playback import ticks


@pytest.fixture
def believed(playback):
    """A saved run, and the robot as it was believed to be in its last tick."""
    playback.apply(cmd.ChangeSensing({"preset": "cheap", "seed": 2}, "anchor"))
    ticks(playback, 150)
    return playback.saved_run(), playback.live.observer.geometry().believed


def test_the_believed_robot_is_where_it_was_believed_to_be(believed):
    run, then = believed
    frames = ReplayFrames(run)
    now = frames.geometry(len(frames) - 1).believed
    np.testing.assert_allclose(now.qpos[:7], then.qpos[:7], atol=1e-9)
    np.testing.assert_allclose(now.com, then.com, atol=1e-12)
    np.testing.assert_array_equal(now.qpos[7:], frames.geometry(len(frames) - 1).qpos[7:])  # as nothing else is kept
    assert np.abs(then.qpos[3:7] - frames.geometry(len(frames) - 1).qpos[3:7]).max() > 1e-5
    np.testing.assert_allclose(now.soles, then.soles, atol=0.02)
    assert np.isnan(now.capture).all()


def test_a_run_that_knew_its_state_has_none(playback):
    ticks(playback, 3)
    assert ReplayFrames(playback.saved_run()).geometry(0).believed is None
