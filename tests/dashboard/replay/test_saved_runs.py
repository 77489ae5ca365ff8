"""A run that is kept: what comes back is what was, as data, as a picture of every tick, for Foxglove, as a page."""

import io
import json
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from surefoot.dashboard.engine.session import Session
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.panels.export.run_files import file_name, run_bytes
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.dashboard.replay.html_export import replay_html
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.mcap_file import mcap_bytes
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.runs.saved_run import KINDS


@pytest.fixture
def lived(playback):
    """A live run that has been through something, and what was seen at two moments: geometry by time."""
    seen = {}
    playback.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.006, size_m=0.06, shape="wedge"))
    playback.apply(cmd.PlaceStone(x_m=0.6, y_m=0.5, height_m=0.02, size_m=0.08, shape="half-ball"))
    for tick in range(500):
        if tick == 200:
            playback.apply(cmd.RemoveStone(1))
            playback.apply(cmd.TiltGround(slope_deg=1.0, direction_deg=180.0, duration_s=0.2))
        if tick == 260:
            playback.apply(cmd.MoveStone(number=0, x_m=-0.5, y_m=0.4))
        before = playback.live.simulation.plant.data.qpos.copy(), playback.live.simulation.time_s
        if tick in (150, 330, 450):
            seen[before[1]] = (before[0], playback.live.observer.geometry())
        playback.tick()
    return playback, seen


@pytest.mark.parametrize("suffix", KINDS)
def test_what_is_read_is_what_was_written(lived, tmp_path, suffix):
    playback, _ = lived
    run, file = playback.saved_run(), tmp_path / f"run{suffix}"
    write_run(run, file)
    again = read_run(file)
    assert again.columns == run.columns
    np.testing.assert_array_equal(again.table, run.table)
    assert again.manifest == json.loads(json.dumps(run.manifest))
    manifest = again.manifest
    assert (manifest["scenario_name"], manifest["controller"]) == ("stand_left", "two-part")
    assert manifest["settings"]["com_stiffness"] == 60.0
    assert {"git_commit", "versions", "scenario", "events"} <= manifest.keys()


def test_a_replay_draws_what_was_there(lived, tmp_path):
    playback, seen = lived
    file = tmp_path / "run.npz"
    write_run(playback.saved_run(), file)
    frames = ReplayFrames(read_run(file))
    assert len(frames) == 500
    for time_s, (qpos, geometry) in seen.items():
        replayed = frames.geometry(frames.row_at(time_s))
        np.testing.assert_allclose(replayed.qpos, qpos, rtol=0, atol=1e-15)
        np.testing.assert_allclose(replayed.soles, geometry.soles, rtol=0, atol=1e-3)  # MuJoCo's are a step older
        np.testing.assert_allclose(replayed.ground_rotation, geometry.ground_rotation, rtol=0, atol=1e-3)
        assert [view.number for view in replayed.stones] == [view.number for view in geometry.stones]
        for ours, theirs in zip(replayed.stones, geometry.stones, strict=True):
            assert ours.stone == theirs.stone
            np.testing.assert_allclose(ours.position, theirs.position, rtol=0, atol=1e-3)
    shown = {time_s: [view.number for view in geometry.stones] for time_s, (_, geometry) in seen.items()}
    assert list(shown.values()) == [[0, 1], [0], [0]]


def test_foxglove_finds_frames_scene_numbers_and_events(lived):
    playback, _ = lived
    run = playback.saved_run()
    topics: dict[str, list[dict]] = {}
    schemas = {}
    for schema, channel, message in make_reader(io.BytesIO(mcap_bytes(run))).iter_messages():
        topics.setdefault(channel.topic, []).append(json.loads(message.data))
        schemas[channel.topic] = schema.name
    assert schemas["/tf"] == "foxglove.FrameTransforms"
    assert schemas["/scene"] == "foxglove.SceneUpdate"
    assert schemas["/events"] == "foxglove.Log"
    assert {t["child_frame_id"] for t in topics["/tf"][0]["transforms"]} >= {"pelvis", "trunk", "l_foot"}
    assert topics["/balance"][10]["com_z_m"] == pytest.approx(run.column("com_z_m")[50], abs=1e-9)
    cubes = [entity["cubes"] for entity in topics["/scene"][-1]["entities"] if entity["id"] == "stones"]
    assert len(cubes[0]) == 1


def test_a_replay_page_stands_alone(lived):
    playback, _ = lived
    page = replay_html(playback.saved_run())
    assert page.lstrip().lower().startswith("<!doctype html>")
    assert "window.__VISER_EMBED_DATA__=" in page
    assert 'src="http' not in page


def test_files_that_take_long_are_made_by_another_process(lived):
    playback, _ = lived
    run = playback.saved_run()
    assert file_name(run, "mcap") == "surefoot-stand_left-two-part.mcap"
    assert run_bytes(run, "mcap") == mcap_bytes(run)


def test_the_session_answers_with_the_run(playback):
    session = Session(playback, paced=False)
    question = session.saved_run()
    session.start()
    try:
        run = question.result(timeout=60.0)
    finally:
        session.stop()
    assert run.manifest["scenario_name"] == "stand_left"


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [("run.xls", b"", ".npz, .parquet"), ("missing.npz", None, "cannot be read"), ("run.npz", b"nonsense", "no saved"),
     ("run.parquet", b"nonsense", "no saved")],
)  # fmt: skip
def test_a_file_that_is_no_run_is_refused(tmp_path, name, content, says):
    file: Path = tmp_path / name
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(InvalidInput, match=says):
        read_run(file)


def test_an_npz_without_a_manifest_says_so(tmp_path):
    file = tmp_path / "old.npz"
    np.savez(file, table=np.zeros((3, 2)), columns=["a", "b"])
    with pytest.raises(InvalidInput, match="no manifest"):
        read_run(file)


class Burglar:
    """What unpickling it would do: make a file."""

    def __init__(self, file):
        self.file = file

    def __reduce__(self):
        return Path.touch, (self.file,)


def test_a_pickled_file_is_refused_and_never_unpickled(tmp_path):
    opened = tmp_path / "opened"
    table = np.array([Burglar(opened)], dtype=object)
    np.savez(tmp_path / "run.npz", table=table, columns=["a"], manifest="{}", allow_pickle=True)
    with pytest.raises(InvalidInput, match="is no saved run"):
        read_run(tmp_path / "run.npz")
    assert not opened.exists()
