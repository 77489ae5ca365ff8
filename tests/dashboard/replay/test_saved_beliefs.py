"""A saved run of a robot that did not know its state: the replay shows what was believed, from the record alone."""

import io
import json

import numpy as np
import pytest
from mcap.reader import make_reader

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.experiments.runs.mcap_file import NUMBERS_EVERY, mcap_bytes
from surefoot.experiments.runs.saved_run import imperfection_note
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


def test_its_file_says_what_it_knew_by(believed, playback):
    run, _ = believed
    assert imperfection_note(run.manifest) == "sensors cheap, estimator anchor, motors perfect, model error perfect"
    playback.apply(cmd.ChangeSensing({"preset": "perfect"}, "truth"))
    ticks(playback, 2)
    assert imperfection_note(playback.saved_run().manifest) is None
    assert imperfection_note({"scenario": {}}) is None  # an older file
    motors = {"preset": "perfect", "bandwidth_hz": 40.0}
    assert "motors perfect (changed)" in imperfection_note({"scenario": {"motors": motors}})


def test_foxglove_gets_the_errors_that_the_record_has(believed):
    run, _ = believed
    messages = [
        json.loads(message.data) for *_, message in make_reader(io.BytesIO(mcap_bytes(run))).iter_messages("/estimate")
    ]
    assert len(messages) == len(run.table[::NUMBERS_EVERY])
    last = run.table[::NUMBERS_EVERY][-1]
    for name in ("dcm_error_x_m", "dcm_sigma_y_m", "orientation_error_z_rad", "believed_com_z_m", "position_error_x_m"):
        assert messages[-1][name] == pytest.approx(last[run.columns.index(name)], abs=1e-9)


def test_a_run_that_knew_its_state_has_none(playback):
    ticks(playback, 3)
    run = playback.saved_run()
    assert ReplayFrames(run).geometry(0).believed is None
    topics = {channel.topic for channel in make_reader(io.BytesIO(mcap_bytes(run))).get_summary().channels.values()}
    assert "/balance" in topics and "/estimate" not in topics
