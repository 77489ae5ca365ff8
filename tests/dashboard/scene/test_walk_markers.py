"""The markers of capture regions and plan, in a real scene."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.scene.markers import capture_regions
from surefoot.dashboard.scene.markers.capture_regions import CaptureRegionsMarker, foot_on_ground
from surefoot.dashboard.scene.markers.marker import Canvas
from surefoot.dashboard.scene.markers.plan import PlanMarker
from surefoot.dashboard.scene.markers.support_plane import SupportPlane
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.emergency_step import step_region
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.momentum.zmp import natural_frequency
from surefoot.robot.description import load_robot
from tests.support.playback import ticks

ROBOT = load_robot()


@pytest.fixture(scope="module")
def walking():
    playback = Playback(load_scenario("walk_flat", {"reference.steps": 3}), "two-part")
    ticks(playback, 1_100)
    return playback


def node(server, name):
    return server.scene._handle_from_node_name[f"/marks/{name}"]


def shown(server, geometry):
    marker = CaptureRegionsMarker(Canvas(server.scene, "/marks", ROBOT))
    marker.shown = True
    marker.update(geometry, SupportPlane(geometry))
    return marker


@pytest.mark.parametrize("foot", [0, 1])
def test_a_foot_is_found_from_the_corners_of_its_sole(foot):
    sole, turn, at = ROBOT.feet[foot], rotation_from_rpy(0.0, 0.0, 0.7), np.array((0.4, -1.3, 0.01))
    ankle = at + (0.0, 0.0, sole.ankle_height_m)
    point, axes = foot_on_ground(sole, ankle + sole.corners_from_ankle @ turn.T)
    assert point == pytest.approx(at[:2])
    assert axes == pytest.approx(turn[:2, :2])


def test_k_1_is_drawn_from_the_foot_that_is_to_stand_where_it_stands(server, walking):
    geometry, plant = walking.snapshot().geometry, walking.live.simulation.plant
    shown(server, geometry)
    assert [node(server, f"region_1_{foot}").visible for foot in (0, 1)] == [False, True]
    truth, foot = plant.feet()[1], ROBOT.feet[1]
    below = truth.position_ankle - foot.ankle_height_m * truth.rotation[:, 2]
    omega = natural_frequency(float(plant.position_com()[2] - below[2]), ROBOT.gravity)
    yaw = np.arctan2(truth.rotation[1, 0], truth.rotation[0, 0])
    axes = rotation_from_rpy(0.0, 0.0, float(yaw))[:2, :2]
    region = step_region(ROBOT, 1, omega).moved(axes, below[:2])
    for drawn in (node(server, "region_1_1_area").vertices, node(server, "region_1_1").points.reshape(-1, 3)):
        apart = np.linalg.norm(drawn[:, None, :2] - region.vertices[None], axis=2)  # same corners, whatever their order
        assert apart.min(axis=0).max() < 1e-4
        assert apart.min(axis=1).max() < 1e-4
        assert np.abs(drawn[:, 2] - below[2]).max() < 0.01
    assert region.contains(geometry.capture)  # a step can catch what a walk does
    polygon = node(server, "region_0").points[:, 0]
    assert all(np.abs(polygon - corner).max(axis=1).min() < 0.01 for corner in geometry.support_polygon)


def test_from_two_feet_either_may_step(server, walking):
    geometry = replace(walking.snapshot().geometry, standing=(0, 1))
    marker = shown(server, geometry)
    nodes = [node(server, f"region_1_{foot}{kind}") for foot in (0, 1) for kind in ("", "_area")]
    assert all(it.visible for it in nodes)
    marker.update(replace(geometry, com=np.full(3, np.nan)), SupportPlane(geometry))
    assert not any(it.visible for it in (*nodes, node(server, "region_0")))


def test_regions_that_nobody_wants_are_neither_computed_nor_seen(server, walking, monkeypatch):
    geometry = walking.snapshot().geometry
    marker = CaptureRegionsMarker(Canvas(server.scene, "/marks", ROBOT))
    monkeypatch.setattr(capture_regions, "step_region", None)
    marker.update(geometry, SupportPlane(geometry))
    names = ("region_0", "region_1_0", "region_1_1", "region_1_0_area", "region_1_1_area")
    assert not any(node(server, name).visible for name in names)
    marker.shown = True
    with pytest.raises(TypeError):
        marker.update(geometry, SupportPlane(geometry))


def test_the_plan_is_drawn_along_its_points_to_its_end_and_only_where_there_is_one(server, walking):
    geometry = walking.snapshot().geometry
    marker = PlanMarker(Canvas(server.scene, "/marks", ROBOT))
    marker.update(geometry, SupportPlane(geometry))
    for name, column in (("plan_zmp", 0), ("plan_capture", 2)):
        path = geometry.plan_ahead[:, column : column + 2]
        points = node(server, name).points
        assert points[0, 0, :2] == pytest.approx(path[0], abs=1e-5)
        assert points[-1, 1, :2] == pytest.approx(path[-1], abs=1e-5)
        lengths = [np.linalg.norm(np.diff(it, axis=0), axis=1).sum() for it in (path, *points[:, :, :2])]
        assert sum(lengths[1:]) == pytest.approx(lengths[0], abs=1e-4)
        assert np.abs(points[:, :, 2] - geometry.support_origin[2]).max() < 0.01
        assert node(server, name).visible
    marker.update(replace(geometry, plan_ahead=geometry.plan_ahead[:0]), SupportPlane(geometry))
    assert not node(server, "plan_zmp").visible and not node(server, "plan_capture").visible


def test_the_longest_plan_has_segments_enough(server):
    playback = Playback("walk_flat", "two-part")
    longest = 0
    for _ in range(30):
        ticks(playback, 50)
        longest = max(longest, len(playback.snapshot().geometry.plan_ahead))
    marker = PlanMarker(Canvas(server.scene, "/marks", ROBOT))
    assert longest > 40
    assert longest - 1 <= len(node(server, "plan_zmp").points)
    assert marker.shown
