"""The ghost of the believed robot: there while somebody believes something and it is wanted."""

from dataclasses import replace

import numpy as np

from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.scene.markers.markers import Markers
from surefoot.dashboard.scene.scene import SceneView
from surefoot.robot.description import load_robot
from tests.support.playback import ticks


def nodes(server, part):
    handles = server.scene._handle_from_node_name
    return {name: node for name, node in handles.items() if part in name}


def test_the_ghost_is_made_when_first_seen_and_stands_where_the_robot_is_believed_to_be(server, playback):
    robot = load_robot("bip")
    scene, markers = SceneView(server, robot), Markers(server, robot)

    def draw(geometry):
        markers.update(geometry)
        scene.update(geometry)

    ticks(playback, 3)
    draw(playback.live.observer.geometry())
    assert not nodes(server, "/believed/robot")
    assert not nodes(server, "believed_capture")["/overlay/believed_capture"].visible
    playback.apply(cmd.ChangeSensing({"preset": "cheap"}, "anchor"))
    ticks(playback, 30)
    geometry = playback.live.observer.geometry()
    draw(geometry)
    pelvis = nodes(server, "/believed/robot/pelvis")["/world/believed/robot/pelvis"]
    np.testing.assert_allclose(pelvis.position, geometry.believed.qpos[:3], atol=1e-4)
    assert nodes(server, "/world/believed")["/world/believed"].visible
    sign = nodes(server, "believed_capture")["/overlay/believed_capture"]
    assert sign.visible
    np.testing.assert_allclose(sign.position[:2], geometry.believed.capture, atol=1e-4)
    scene.show_believed(False)
    markers.show("believed", False)
    draw(geometry)
    assert not nodes(server, "/world/believed")["/world/believed"].visible
    assert not sign.visible
    scene.show_believed(True)
    draw(replace(geometry, believed=None))
    assert not nodes(server, "/world/believed")["/world/believed"].visible
