"""What is drawn where: on a slope, on a narrow screen, in the materials that the robot's file gives."""

import io
import itertools

import mujoco
import numpy as np
import pytest
import trimesh

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.scene.ground import pose_of_ground
from surefoot.dashboard.scene.marker_meshes import glowing_glb, linear, quartered_ball, quartered_disc
from surefoot.dashboard.scene.markers.markers import MARKERS
from surefoot.dashboard.scene.markers.support_plane import SupportPlane
from surefoot.dashboard.scene.robot import link_glb
from surefoot.dashboard.scene.scene import CAMERA_LOOK_AT, CAMERA_POSITION
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.mobile_layout import placed_for
from surefoot.dashboard.ui.symbols import POINTS
from surefoot.robot.description import load_robot
from surefoot.simulation.world import FLOOR


@pytest.fixture(scope="module")
def sloped(tmp_path_factory):
    path = tmp_path_factory.mktemp("slope") / "slope.toml"
    path.write_text('robot = "bip"\nsupport = "double"\nduration_s = 1.0\n[ground]\nslope_deg = 8.0\n'
                    "direction_deg = 30.0\n[[stones]]\nx_m = 0.4\ny_m = 0.3\nheight_m = 0.02\nsize_m = [0.1, 0.1]\n"
                    "rise_start_s = 0.0\n", encoding="utf-8")  # fmt: skip
    playback = Playback(str(path), "two-part")
    for _ in range(20):
        playback.tick()
    return playback


def test_every_point_of_the_plan_of_the_feet_has_a_marker_of_its_colour():
    colours = {marker.key: marker.colour for marker in MARKERS}
    assert len(colours) == len(MARKERS)
    assert {point.key: colours.get(point.key) for point in POINTS} == {point.key: point.colour for point in POINTS}


def test_ground_and_points_are_drawn_on_the_slope_that_is_simulated(sloped):
    geometry, plant = sloped.live.observer.geometry(), sloped.live.simulation.plant
    position, wxyz = pose_of_ground(geometry)
    floor = plant.model.geom(FLOOR)
    np.testing.assert_allclose(np.abs(wxyz @ plant.model.geom_quat[floor.id]), 1.0, atol=1e-9)
    normal = geometry.ground_rotation[:, 2]
    assert normal.dot(plant.model.geom_pos[floor.id] - position) == pytest.approx(0.0, abs=1e-9)
    plane = SupportPlane(geometry)
    for place in itertools.product((-0.3, 0.4), (-0.2, 0.3)):
        drawn = plane.point(np.array(place))
        assert drawn[:2] == pytest.approx(place)
        assert normal.dot(drawn - geometry.support_origin) == pytest.approx(0.0, abs=1e-9)
    assert plane.point(np.array((0.5, 0.3)))[2] > plane.point(np.array((0.0, 0.0)))[2] + 0.05  # it rises that way


def test_soles_that_stand_are_on_the_drawn_ground(sloped):
    geometry = sloped.live.observer.geometry()
    normal, pivot = geometry.ground_rotation[:, 2], geometry.ground_pivot
    assert np.abs((geometry.soles - pivot) @ normal).max() < 0.003


def test_links_carry_the_materials_of_the_robot_s_file_and_a_tint_changes_them():
    model = mujoco.MjModel.from_xml_path(str(load_robot().mjcf_path))
    trunk = [
        g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body("trunk").id and model.geom_group[g] == 2
    ]
    scene = trimesh.load(io.BytesIO(link_glb(model, trunk)), file_type="glb")
    wanted = {int(model.geom_matid[geom]) for geom in trunk}
    metals = sorted(mesh.visual.material.metallicFactor for mesh in scene.geometry.values())
    np.testing.assert_allclose(metals, sorted(model.mat_metallic[list(wanted)]), atol=1e-6)
    faces = sum(len(mesh.faces) for mesh in scene.geometry.values())
    assert faces > 500
    ghost = trimesh.load(io.BytesIO(link_glb(model, trunk, tint=(10, 200, 30), mix=1.0, opacity=0.4)), file_type="glb")
    for mesh in ghost.geometry.values():
        colour = np.asarray(mesh.visual.material.baseColorFactor) / 255.0
        np.testing.assert_allclose(colour[:3], linear(np.array((10, 200, 30)) / 255.0), atol=0.005)
        assert colour[3] == pytest.approx(0.4, abs=0.005)
        assert mesh.visual.material.alphaMode == "BLEND"


def test_a_shape_s_normals_point_outward():
    """Else a link would look inside out: every face's normal and its vertices' normals agree."""
    model = mujoco.MjModel.from_xml_path(str(load_robot().mjcf_path))
    thigh = [
        g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body("l_thigh").id and model.geom_group[g] == 2
    ]
    scene = trimesh.load(io.BytesIO(link_glb(model, thigh)), file_type="glb")
    for mesh in scene.geometry.values():
        agreement = (mesh.vertex_normals[mesh.faces].mean(axis=1) * mesh.face_normals).sum(axis=1)
        assert (agreement > 0.5).all()


@pytest.mark.parametrize("sign", [quartered_disc(0.02, 0.004), quartered_ball(0.04)])
def test_the_sign_of_a_centre_of_mass_is_half_dark(sign):
    areas = [trimesh.Trimesh(*mesh, process=False).area for mesh in sign]
    assert areas[0] == pytest.approx(areas[1], rel=0.05)
    data = glowing_glb([(mesh, palette.COM) for mesh in sign])
    assert len(trimesh.load(io.BytesIO(data), file_type="glb").geometry) == 2


def test_a_narrow_screen_sees_the_whole_robot_in_its_upper_half():
    place = (CAMERA_POSITION, CAMERA_LOOK_AT)
    assert placed_for(place, 1.6) is place
    position, target = (np.array(p) for p in placed_for(place, 390 / 844))
    ahead = (target - position) / np.linalg.norm(target - position)
    right = np.cross(ahead, (0.0, 0.0, 1.0))
    up = np.cross(right / np.linalg.norm(right), ahead)
    for height, low, high in ((1.85, 0.55, 1.0), (0.0, -0.05, 0.5)):  # head and sole: between middle and top
        ray = np.array((0.0, 0.06, height)) - position
        share = ray.dot(up) / ray.dot(ahead) / np.tan(0.375)
        assert low < share < high
