"""The marker of the steps to come, in a real scene."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages.footprint import Footprint
from surefoot.dashboard.scene.markers.footprints import FootprintsMarker
from surefoot.dashboard.scene.markers.marker import Canvas
from surefoot.dashboard.scene.markers.support_plane import LIFT_M, SupportPlane
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import load_robot


@pytest.fixture(scope="module")
def geometry():
    return Playback(load_scenario("walk_flat", {"reference.steps": 3}), "two-part").snapshot().geometry


def test_each_foot_s_steps_are_drawn_and_what_stays_is_not_sent_again(server, geometry):
    marker = FootprintsMarker(Canvas(server.scene, "/marks", load_robot()))
    marker.update(geometry, SupportPlane(geometry))
    node = server.scene._handle_from_node_name
    for foot in (0, 1):
        wanted = np.vstack([footprint.outline for footprint in geometry.footprints if footprint.foot == foot])
        drawn = {
            name: getattr(node[f"/marks/footprints_{foot}{name}"], prop).reshape(-1, 3)
            for name, prop in (("", "points"), ("_area", "vertices"))
        }
        for points in drawn.values():
            assert all(np.abs(points - (corner + (0.0, 0.0, LIFT_M))).max(axis=1).min() < 1e-6 for corner in wanted)
            assert points[:, 0].max() == pytest.approx(wanted[:, 0].max())
        assert node[f"/marks/footprints_{foot}"].visible
    assert len({tuple(node[f"/marks/footprints_{foot}_area"].color) for foot in (0, 1)}) == 2

    sent = server._websock_server._broadcast_buffer.message_counter
    breathing = tuple(Footprint(one.foot, one.outline + (0.0, 0.0, 3e-5)) for one in geometry.footprints)
    marker.update(replace(geometry, footprints=breathing), SupportPlane(geometry))
    assert server._websock_server._broadcast_buffer.message_counter == sent


def test_they_are_hidden_when_unwanted_and_when_the_walk_is_over(server, geometry):
    marker = FootprintsMarker(Canvas(server.scene, "/marks", load_robot()))
    nodes = [server.scene._handle_from_node_name[f"/marks/footprints_{name}"] for name in ("0", "0_area", "1_area")]
    marker.update(geometry, SupportPlane(geometry))
    assert all(node.visible for node in nodes)
    marker.update(replace(geometry, footprints=()), SupportPlane(geometry))
    assert not any(node.visible for node in nodes)
    marker.shown = False
    marker.update(geometry, SupportPlane(geometry))
    assert not any(node.visible for node in nodes)
