"""A walk that is kept: its footprints come back as they were seen, and a page on disk keeps the robot in sight."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
import viser

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.dashboard.replay.html_export import replay_html
from surefoot.dashboard.replay.treadmill import Treadmill
from surefoot.dashboard.scene.markers.markers import Markers
from surefoot.dashboard.scene.scene import SceneView
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.partial_file import PartialRun
from surefoot.experiments.runs.recording import Recording
from surefoot.experiments.runs.run import run
from surefoot.experiments.runs.saved_run import INTERRUPTED, SavedRun
from surefoot.experiments.runs.saved_walk import FOOTSTEPS, SavedWalk, footsteps_entry
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.references import planned_footsteps
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import load_robot
from tests.support.playback import ticks

CHANGES = {"reference.steps": 3, "reference.step_period_s": 0.6, "reference.turn_deg_per_step": 5.0}


@pytest.fixture(scope="module")
def walked():
    """A saved walk, and what was seen of it live: geometry by time."""
    playback, seen = Playback(load_scenario("walk_flat", CHANGES), "two-part"), {}
    for _ in range(50):
        seen[round(playback.live.simulation.time_s, 6)] = playback.snapshot().geometry
        ticks(playback, 60)
    kept = playback.saved_run()
    return SavedRun(kept.columns, kept.table, json.loads(json.dumps(kept.manifest))), seen


def test_a_replay_shows_the_footprints_that_were_seen(walked):
    kept, seen = walked
    frames, counts = ReplayFrames(kept), []
    for time_s, geometry in seen.items():
        replayed = frames.geometry(frames.row_at(time_s - 1e-3) if time_s else 0).footprints  # the last tick's
        assert [one.foot for one in replayed] == [one.foot for one in geometry.footprints]
        for ours, theirs in zip(replayed, geometry.footprints, strict=True):
            np.testing.assert_allclose(ours.outline[:, :2], theirs.outline[:, :2], rtol=0, atol=1e-12)
            np.testing.assert_allclose(ours.outline[:, 2], theirs.outline[:, 2], rtol=0, atol=0.005)
        counts.append(len(replayed))
    assert sorted(set(counts), reverse=True) == [3, 2, 1, 0]


def test_each_step_is_kept_with_when_it_landed(walked):
    kept, _ = walked
    steps = kept.manifest[FOOTSTEPS]
    assert [step["foot"] for step in steps] == [0, 1, 0]
    told = [time_s for time_s, kind, _ in kept.manifest["events"] if kind == "step"]
    assert [step["landed_s"] for step in steps] == pytest.approx(told, abs=0.0015)


def test_a_step_that_was_moved_is_shown_where_it_was_led_and_an_older_file_shows_it_where_it_was_planned():
    push = {
        "direction_deg": 90.0,
        "impulse_ns": 20.0,
        "start_s": 0.95,
        "duration_s": 0.1,
    }
    scenario = load_scenario("walk_flat", {"reference.steps": 1, "reference.step_period_s": 0.6, "pushes": [push]})
    simulation = build_simulation(scenario, "two-part", rows=1).simulation
    walk = simulation.gait
    assert [entry["led_to_m"] for entry in footsteps_entry(walk)] == [None]
    while walk.made == 0:
        simulation.tick()
    foot, (entry,) = simulation.plant.feet()[0].position_ankle[:2], json.loads(json.dumps(footsteps_entry(walk)))
    (led,) = SavedWalk({FOOTSTEPS: [entry], "events": []}).steps_ahead(0.0)
    del entry["led_to_m"]
    (planned,) = SavedWalk({FOOTSTEPS: [entry], "events": []}).steps_ahead(0.0)
    np.testing.assert_array_equal(planned.point, planned_footsteps(scenario)[0].point)
    assert led.point[1] > planned.point[1] + 0.01  # to the side that the push goes to
    assert math.dist(led.point, foot) < 0.5 * math.dist(planned.point, foot)


def test_who_has_fallen_has_no_steps_to_come(walked):
    kept, _ = walked
    walk = SavedWalk({**kept.manifest, "events": [[0.5, "fall", "it fell"]]})
    assert len(walk.steps_ahead(0.499)) == 3
    assert walk.steps_ahead(0.5) == ()


def test_a_run_that_only_stands_keeps_none(playback):
    ticks(playback, 5)
    manifest = playback.saved_run().manifest
    assert FOOTSTEPS not in manifest
    assert SavedWalk(manifest).steps_ahead(0.0) == ()


@pytest.mark.parametrize("bad", [3, [{"foot": 0}], [{"foot": 7, "x_m": 0, "y_m": 0, "yaw_rad": 0, "landed_s": None}],
                                 [{"foot": 0, "x_m": "far", "y_m": 0, "yaw_rad": 0, "landed_s": None}]])  # fmt: skip
def test_footsteps_that_make_no_sense_are_refused(walked, bad):
    kept, _ = walked
    with pytest.raises(InvalidInput, match="footsteps"):
        ReplayFrames(SavedRun(kept.columns, kept.table, {**kept.manifest, FOOTSTEPS: bad}))


def test_a_page_on_disk_keeps_the_robot_in_sight(walked):
    kept, _ = walked
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        robot = load_robot()
        scene, markers = SceneView(server, robot), Markers(server, robot)
        treadmill, frames = Treadmill(scene, markers), ReplayFrames(kept)
        roots = [server.scene._handle_from_node_name[name] for name in ("/world", "/overlay")]
        farthest = 0.0
        for time_s in np.arange(0.0, float(frames.time_s[-1]), 0.04):
            com = frames.geometry(frames.row_at(time_s)).com[:2]
            treadmill.follow(com)
            farthest = max(farthest, float(np.linalg.norm(com + roots[0].position[:2])))
            assert roots[0].position == pytest.approx(roots[1].position)
        assert com[0] > 0.35
        assert roots[0].position[0] < -0.1
        assert farthest < 0.35
        lamp, last = server.scene._handle_from_node_name["/light/lamp"], frames.geometry(len(frames) - 1)
        before, far = lamp.position.copy(), replace(last, com=last.com + (5.0, 0.0, 0.0))
        treadmill.follow(far.com[:2])
        scene.update(far)
        assert lamp.position == pytest.approx(before)  # it stays with the robot, which stays where it is seen
    finally:
        server.stop()
    assert "window.__VISER_EMBED_DATA__=" in replay_html(kept)


def test_where_the_world_is_at_first_is_sent_too(walked):
    """A page on disk plays again and again: at each start it takes what was sent, and nothing else."""
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        scene, markers = SceneView(server, load_robot()), Markers(server, load_robot())
        treadmill, recorder = Treadmill(scene, markers), server.get_scene_serializer()
        known = len(recorder._messages)
        treadmill.follow(np.zeros(2))
        sent = {message["name"]: message["position"] for _, message in recorder._messages[known:]}
        assert sent == {"/world": pytest.approx((0.0, 0.0, 0.0)), "/overlay": pytest.approx((0.0, 0.0, 0.0))}
    finally:
        server.stop()


def test_a_file_knows_which_steps_have_landed_unless_its_run_was_killed(tmp_path):
    scenario = load_scenario("walk_flat", {"reference.steps": 1, "duration_s": 1.8})
    with Recording(tmp_path / "walk.npz", lambda: 0) as recording:
        run(scenario, "two-part", recording=recording)
        whole = PartialRun(recording.partial).manifest
        data = recording.partial.read_bytes()
    (step,) = whole[FOOTSTEPS]
    assert 1.3 < step["landed_s"] < 1.6
    killed = tmp_path / "killed.partial"
    killed.write_bytes(data[: len(data) - 200_000])  # its end was never written
    assert INTERRUPTED in PartialRun(killed).manifest
    assert SavedWalk(PartialRun(killed).manifest).steps_ahead(0.0) == ()
