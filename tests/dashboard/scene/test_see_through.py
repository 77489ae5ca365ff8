"""What is see-through: plain to see on a light and on a dark page, of any robot, and one set of shapes at a time."""

import io

import numpy as np
import pytest
import trimesh

from surefoot.dashboard.scene.ground import _DARK, _LIGHT
from surefoot.dashboard.scene.marker_meshes import linear
from surefoot.dashboard.scene.robot import FEET, NOTHING
from surefoot.dashboard.scene.scene import SceneView
from surefoot.robot.description import load_robot

FOOT = "/world/robot/l_foot"
PLAIN = 30.0  # of 255: what a shape has to change of the ground's colour; 17 were taken for nothing at all


def visible(server, start=FOOT):
    """Names of the foot's shapes that are shown."""
    return {
        name.removeprefix(start)
        for name, node in server.scene._handle_from_node_name.items()
        if name.startswith(start) and node.visible
    }


def material(server, name):
    node = server.scene._handle_from_node_name[name]
    (mesh, *_) = trimesh.load(io.BytesIO(node.glb_data), file_type="glb").geometry.values()
    return np.asarray(mesh.visual.material.baseColorFactor) / 255.0


@pytest.mark.parametrize(("dark", "ghost", "ground"), [(False, "_ghost", _LIGHT), (True, "_ghost_on_dark", _DARK)])
def test_feet_are_plain_to_see_and_more_of_what_is_below_them_is_seen_than_of_them(server, dark, ghost, ground):
    scene = SceneView(server, load_robot("bip"))
    scene.set_dark(dark)
    assert visible(server) == {ghost}
    *colour, opacity = material(server, FOOT + ghost)
    levels = np.arange(256)
    shown = np.interp(colour, linear(levels / 255.0), levels)  # as written, 0 to 255
    assert opacity * np.abs(shown - ground["plane_color"]).min() > PLAIN
    assert opacity < 0.3


def test_the_page_s_colour_holds_for_another_robot_and_for_what_is_chosen(server):
    scene = SceneView(server, load_robot("bip"))
    scene.set_dark(True)
    scene.see_through(NOTHING)
    assert visible(server) == {""}
    scene.see_through(FEET)
    assert visible(server) == {"_ghost_on_dark"}
    scene.set_dark(False)
    assert visible(server) == {"_ghost"}
    scene.set_dark(True)
    scene.change_robot(load_robot("bip"))
    assert visible(server) == {"_ghost_on_dark"}
    scene.see_through(NOTHING)
    assert visible(server) == {""}
