"""Uneven ground as it is drawn, kept and exported: where MuJoCo has its blocks."""

import io
import json
import re
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import viser
from mcap.reader import make_reader

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages.snapshot import TwinView
from surefoot.dashboard.panels.balance.foot_plan import HEIGHT, WIDTH, foot_plan, plan_of
from surefoot.dashboard.scene.ground import pose_of_ground
from surefoot.dashboard.scene.terrain import TerrainView
from surefoot.dashboard.scene.twin_scene import BESIDE, GHOST, TwinScene
from surefoot.experiments.runs.mcap_file import mcap_bytes
from surefoot.experiments.runs.saved_world import SavedWorld
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.simulation.terrain import LEVEL
from surefoot.simulation.world import FLOOR, TERRAIN

ROUGH = {
    "reference.steps": 2,
    "ground.tiles": {"size_m": 0.2, "amplitude_m": 0.03, "seed": 1},
    "ground.slope_deg": 2.0,
    "stones_under_steps.height_m": 0.02,
}


@pytest.fixture(scope="module")
def rough():
    """A walk about to begin on sloped tiles, after a tick."""
    playback = Playback(load_scenario("walk_flat", ROUGH), "two-part")
    playback.tick()
    return playback


def blocks_of_mujoco(playback):
    """Centres (n, 3) in world and lengths (n, 3) [m] of the blocks."""
    plant = playback.live.simulation.plant
    mujoco.mj_kinematics(plant.model, plant.data)
    body = plant.model.body(TERRAIN).id
    geoms = np.flatnonzero(plant.model.geom_bodyid == body)
    return plant.data.geom_xpos[geoms].copy(), 2.0 * plant.model.geom_size[geoms]


@pytest.fixture
def server():
    server = viser.ViserServer(port=0, verbose=False)
    yield server
    server.stop()


def test_blocks_are_drawn_where_they_are_and_go_with_another_terrain(rough, server):
    snapshot = rough.snapshot()
    view = TerrainView(server, "/ground")
    view.show(snapshot.terrain)
    drawn = view._node
    position, wxyz = pose_of_ground(snapshot.geometry)
    turn = viser.transforms.SO3(wxyz).as_matrix()
    middles = position + drawn.batched_positions @ turn.T
    tops = middles + 0.5 * drawn.batched_scales[:, 2:] * turn[:, 2]
    expected, lengths = blocks_of_mujoco(rough)
    assert len(expected) > 50
    np.testing.assert_allclose(tops, expected + 0.5 * lengths[:, 2:] * turn[:, 2], atol=1e-6)
    np.testing.assert_allclose(drawn.batched_scales[:, :2], lengths[:, :2], atol=1e-6)
    view.show(LEVEL)
    assert view._node is None


@pytest.fixture
def twins(rough, server):
    """The walk beside itself, and the twin's scene."""
    snapshot = rough.snapshot()
    both = replace(snapshot, twin=TwinView(other=snapshot, table=np.empty((0, 1))))
    return both, TwinScene(server, rough.live.simulation.robot, lambda client, place: None)


def test_a_twin_beside_the_first_has_the_same_blocks_below_it_and_the_two_grounds_do_not_overlap(twins, rough):
    both, scene = twins
    scene.arrange(BESIDE, None)
    scene.update(both)
    drawn = scene._scenes[BESIDE]
    offset = np.array(drawn._root.position)
    frame, node = drawn._ground._frame, drawn._ground._terrain._node
    turn = viser.transforms.SO3(frame.wxyz).as_matrix()
    middles = offset + frame.position + node.batched_positions @ turn.T
    expected, lengths = blocks_of_mujoco(rough)
    here = middles + 0.5 * node.batched_scales[:, 2:] * turn[:, 2] - offset
    np.testing.assert_allclose(here, expected + 0.5 * lengths[:, 2:] * turn[:, 2], atol=1e-6)
    assert offset.dot(rough.live.simulation.plant.ground.up) == pytest.approx(0.0, abs=1e-9)  # along the slope
    sides = expected @ turn[:, 1], 0.5 * lengths[:, 1]
    assert (sides[0] - sides[1]).min() + np.linalg.norm(offset) > (sides[0] + sides[1]).max()


def test_a_ghost_stands_on_the_ground_of_the_first(twins):
    both, scene = twins
    scene.arrange(GHOST, None)
    scene.update(both)
    assert scene._scenes[GHOST]._ground is None


def test_a_ledge_is_not_drawn_again_beside_itself(server):
    playback = Playback(load_scenario("walk_flat", {"ledges": [{"x_m": 0.4, "height_m": 0.02}]}), "two-part")
    terrain = playback.snapshot().terrain
    again, once = TerrainView(server, "/twin", endless=False), TerrainView(server, "/first")
    again.show(terrain)
    once.show(terrain)
    assert again._node is None
    assert len(once._node.batched_positions) == len(terrain.blocks) == 1


def test_the_plan_of_the_feet_shows_the_blocks_below_it_at_their_places(rough):
    snapshot = rough.snapshot()
    plan = plan_of(snapshot.geometry, snapshot.support, snapshot.robot)
    svg = foot_plan(snapshot.geometry, snapshot.support, snapshot.robot, 0.05, snapshot.terrain)
    areas = re.search(r"<g data-terrain.*?</g>", svg)[0]
    drawn = [np.array(re.findall(r"-?[\d.]+", path), float).reshape(4, 2) for path in re.findall(r'd="([^"]+)"', areas)]
    expected, lengths = blocks_of_mujoco(rough)
    up, turn = rough.live.simulation.plant.ground.up, rough.live.simulation.plant.ground.rotation
    tops = expected + 0.5 * lengths[:, 2:] * up
    half = 0.5 * lengths[:, :1] * turn[:, 0] + 0.5 * lengths[:, 1:2] * turn[:, 1]
    corners = np.stack((plan.points(tops - half), plan.points(tops + half)))
    low, high = corners.min(axis=0), corners.max(axis=0)
    seen = ((high > 0.0) & (low < (WIDTH, HEIGHT))).all(axis=1)
    assert 5 < seen.sum() < len(seen)
    found = np.array([(*path.min(axis=0), *path.max(axis=0)) for path in drawn])
    wanted = np.hstack((low, high))[seen]
    np.testing.assert_allclose(found[np.lexsort(found.round().T)], wanted[np.lexsort(wanted.round().T)], atol=0.3)
    assert "data-terrain" not in foot_plan(snapshot.geometry, snapshot.support, snapshot.robot, 0.05)


def test_the_terrain_is_one_object_that_is_sent_once(rough):
    assert rough.snapshot().terrain is rough.snapshot().terrain is rough.live.simulation.plant.terrain


def test_a_saved_run_has_it_and_foxglove_is_told_once(rough):
    run = rough.saved_run()
    assert SavedWorld(run).terrain == rough.live.simulation.plant.terrain
    told = []
    for _, channel, message in make_reader(io.BytesIO(mcap_bytes(run))).iter_messages():
        if channel.topic == "/scene":
            entities = {entity["id"]: entity["cubes"] for entity in json.loads(message.data)["entities"]}
            told += [entities["terrain"]] if "terrain" in entities else []
            (slab,) = entities["ground"]
    (cubes,) = told
    expected, lengths = blocks_of_mujoco(rough)
    up = rough.live.simulation.plant.ground.up
    tops = np.array([[*cube["pose"]["position"].values()] for cube in cubes])
    heights = np.array([cube["size"]["z"] for cube in cubes])
    np.testing.assert_allclose(tops + 0.5 * heights[:, None] * up, expected + 0.5 * lengths[:, 2:] * up, atol=1e-9)
    floor = rough.live.simulation.plant.model.geom(FLOOR).id
    below = np.array([*slab["pose"]["position"].values()]) + 0.05 * up
    assert up @ (below - rough.live.simulation.plant.model.geom_pos[floor]) == pytest.approx(0.0, abs=1e-9)
