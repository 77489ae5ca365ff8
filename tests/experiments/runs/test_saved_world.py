"""What a saved run shows of the world is what MuJoCo had: ground, stones, forces, and what happened when."""

import io
import json
from dataclasses import replace

import numpy as np
import pytest
from mcap.reader import make_reader

from surefoot.control.registry import controller_named
from surefoot.dashboard.messages.events import EventKind
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.dashboard.replay.html_export import replay_html
from surefoot.experiments.runs.mcap_file import mcap_bytes
from surefoot.experiments.runs.run import run
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.runs.saved_run import SavedRun, describe_run
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import scenario_from_table

TICKS = 440
SCENARIO = {
    "robot": "bip",
    "support": "double",
    "duration_s": 1e-3 * TICKS,
    "ground": {"slope_deg": 3.0, "direction_deg": 30.0, "tilt_start_s": 0.1, "tilt_duration_s": 0.25},
    "stones": [
        {"x_m": 0.5, "y_m": 0.1, "height_m": 0.02, "size_m": [0.06, 0.1], "lying": True},
        {"x_m": 0.4, "y_m": -0.3, "height_m": 0.03, "shape": "wedge", "rise_start_s": 0.2, "rise_duration_s": 0.15},
        {"x_m": -0.4, "y_m": 0.2, "height_m": 0.025, "shape": "half-ball", "lying": True},
    ],
    "pushes": [
        {"direction_deg": 90.0, "impulse_ns": 1.0, "start_s": 0.205, "duration_s": 0.004},
        {"direction_deg": 0.0, "impulse_ns": 2.0, "start_s": 0.35, "duration_s": 0.05, "link": "trunk"},
    ],
}


@pytest.fixture(scope="module")
def told():
    """A run of stones on ground that tilts, and MuJoCo's own geoms at every tick: name -> (position, rotation)."""
    scenario = scenario_from_table(SCENARIO, "tilting")
    simulation = build_simulation(scenario, "two-part", rows=TICKS).simulation
    plant = simulation.plant
    names = ["floor", *(f"stone_{placed.slot}" for placed in plant.stones.placed)]
    geoms = []
    for _ in range(TICKS):
        simulation.tick()
        here = {name: plant.data.geom(name) for name in names}
        geoms.append({name: (geom.xpos.copy(), geom.xmat.reshape(3, 3).copy()) for name, geom in here.items()})
    manifest = describe_run(simulation, scenario, "two-part", controller_named("two-part").settings({}))
    sizes = {name: plant.model.geom(name).size.copy() for name in names}
    return SavedRun(tuple(simulation.recorder.columns), simulation.recorder.table(), manifest), geoms, sizes


def messages(saved: SavedRun, topic: str) -> list[tuple[int, dict]]:
    """Row and content of every message of a topic."""
    found = make_reader(io.BytesIO(mcap_bytes(saved))).iter_messages(topics=[topic])
    return [(round(message.log_time / 1e6), json.loads(message.data)) for _, _, message in found]


def shapes(scene: dict, entity: str) -> list[dict]:
    """The solids and arrows of an entity."""
    (found,) = [one for one in scene["entities"] if one["id"] == entity]
    return [*found["cubes"], *found["spheres"], *found["arrows"]]


def rotation_of(pose: dict) -> np.ndarray:
    x, y, z, w = (pose["orientation"][a] for a in "xyzw")
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def vector(values: dict) -> np.ndarray:
    return np.array([values[a] for a in "xyz"])


def test_foxglove_shows_the_geoms_that_mujoco_had(told):
    saved, geoms, sizes = told
    scenes = messages(saved, "/scene")
    seen = {len(shapes(scene, "stones")) for _, scene in scenes}
    assert seen == {2, 3}  # the wedge comes later
    slots = {entry["number"]: f"stone_{entry['slot']}" for entry in saved.manifest["stones"]}
    order = [slots[0], slots[1], slots[2]]  # boxes and wedges, then half-balls; the wedge is number 1
    for row, scene in scenes:
        solids = shapes(scene, "stones")
        names = order if len(solids) == 3 else [slots[0], slots[2]]
        for name, solid in zip(names, solids, strict=True):
            position, rotation = geoms[row][name]
            np.testing.assert_allclose(vector(solid["pose"]["position"]), position, rtol=0, atol=1e-9)
            np.testing.assert_allclose(rotation_of(solid["pose"]), rotation, rtol=0, atol=1e-9)
            np.testing.assert_allclose(vector(solid["size"]), 2.0 * sizes[name], rtol=0, atol=1e-12)
        (slab,) = shapes(scene, "ground")
        position, rotation = geoms[row]["floor"]
        up = rotation_of(slab["pose"])[:, 2]
        np.testing.assert_allclose(up, rotation[:, 2], rtol=0, atol=1e-9)
        top = vector(slab["pose"]["position"]) + 0.5 * slab["size"]["z"] * up
        np.testing.assert_allclose((top - position).dot(up), 0.0, rtol=0, atol=1e-9)


def test_foxglove_and_replays_show_pushes(told):
    saved, _, _ = told
    arrows = {row: shapes(scene, "forces") for row, scene in messages(saved, "/scene")}
    assert {len(some) for some in arrows.values()} == {0, 1}
    assert arrows[200] == []
    (short,) = arrows[220]  # over by then, but no picture was taken while it lasted
    assert np.abs(rotation_of(short["pose"])[:, 0] - (0.0, 1.0, 0.0)).max() < 1e-9
    (long,) = arrows[360]
    assert np.abs(rotation_of(long["pose"])[:, 0] - (1.0, 0.0, 0.0)).max() < 1e-9
    assert short["shaft_length"] / long["shaft_length"] == pytest.approx(250.0 / 40.0)
    world = ReplayFrames(saved).world
    np.testing.assert_allclose(world.force(360).force, (40.0, 0.0, 0.0), rtol=0, atol=1e-9)
    assert not world.force(200).force.any()


def test_a_headless_run_keeps_what_happened(tmp_path):
    scenario = scenario_from_table(SCENARIO, "tilting")
    hard = replace(scenario.pushes[1], impulse_ns=150.0)
    result = run(replace(scenario, pushes=(scenario.pushes[0], hard), duration_s=3.0), "two-part")
    saved = SavedRun(tuple(result.recorder.columns), result.recorder.table(), result.manifest)
    write_run(saved, tmp_path / "run.npz")
    events = read_run(tmp_path / "run.npz").manifest["events"]
    times = [time_s for time_s, _, _ in events]
    assert times == sorted(times)
    kinds = [kind for _, kind, _ in events]
    assert {"stone", "run", "push", "limit", "fall"} <= set(kinds) <= set(EventKind)
    assert (kinds.count("stone"), kinds.count("push"), kinds.count("fall")) == (3, 2, 1)
    assert next(time_s for time_s, kind, _ in events if kind == "fall") == result.summary["fall_time_s"]
    logged = [message for _, message in messages(saved, "/events")]
    assert [message["message"] for message in logged] == [text for _, _, text in events]
    page = replay_html(SavedRun(saved.columns, saved.table[:100], saved.manifest))
    assert "__VISER_EMBED_DATA__" in page


def test_a_run_saved_before_the_world_was_recorded_still_opens(told, tmp_path):
    saved, geoms, _ = told
    kept = [i for i, name in enumerate(saved.columns) if not name.startswith(("ground_", "external_force_"))]
    assert len(kept) < len(saved.columns)
    write_run(SavedRun(tuple(saved.columns[i] for i in kept), saved.table[:, kept], saved.manifest), tmp_path / "r.npz")
    old = read_run(tmp_path / "r.npz")
    frames = ReplayFrames(old)
    for row in (0, 220, TICKS - 1):
        rotation = geoms[row]["floor"][1]
        np.testing.assert_allclose(frames.geometry(row).ground_rotation, rotation, rtol=0, atol=1e-9)
        assert not frames.world.force(row).force.any()
    assert mcap_bytes(old)
