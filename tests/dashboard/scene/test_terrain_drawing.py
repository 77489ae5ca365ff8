"""Uneven ground as it is drawn, kept and exported: where MuJoCo has its blocks."""

import io
import json

import mujoco
import numpy as np
import pytest
import viser
from mcap.reader import make_reader

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.scene.ground import pose_of_ground
from surefoot.dashboard.scene.terrain import TerrainView
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
