"""The drawn shapes touch nothing and weigh nothing; soles and collision shapes touch the ground, never each other."""

from itertools import product
from xml.etree import ElementTree

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

VISUAL, SOLE, BODY_COLLISION = 2, 3, 4
FLOOR_CONTYPE, FLOOR_CONAFFINITY = 2, 1  # of ground and stones
SOLE_OUTLINE = [(-0.12, -0.06), (-0.12, 0.06), (0.17, -0.09), (0.17, 0.09)]  # published; from the ankle [m]


def geoms(model, *groups):
    return [k for k in range(model.ngeom) if model.geom_group[k] in groups]


def mesh_vertices(model, geom):
    mesh = model.geom_dataid[geom]
    return model.mesh_vert[model.mesh_vertadr[mesh] :][: model.mesh_vertnum[mesh]]


def lowest(model, data, geom, normal):
    """Smallest coordinate of the geom along a unit vector in the world."""
    a, b, c = normal @ data.geom_xmat[geom].reshape(3, 3)
    radius, length, _ = size = model.geom_size[geom]
    match mujoco.mjtGeom(model.geom_type[geom]):
        case mujoco.mjtGeom.mjGEOM_MESH:
            extent = -(mesh_vertices(model, geom) @ (a, b, c)).min()
        case mujoco.mjtGeom.mjGEOM_BOX:
            extent = size @ np.abs((a, b, c))
        case mujoco.mjtGeom.mjGEOM_CAPSULE:
            extent = radius + length * abs(c)
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            extent = radius * np.hypot(a, b) + length * abs(c)
        case other:
            raise AssertionError(f"no rule for {other}")
    return normal @ data.geom_xpos[geom] - extent


def set_joints(data, **angles):
    for joint, angle in angles.items():
        for side in ("left", "right"):
            data.joint(f"{side}_{joint}").qpos[0] = angle


def stand(model, **angles):
    """Both legs at these angles, the soles 0.1 mm in the floor."""
    data = mujoco.MjData(model)
    set_joints(data, **angles)
    mujoco.mj_kinematics(model, data)
    data.qpos[2] -= data.body("l_foot").xpos[2] - 0.083 + 1e-4
    mujoco.mj_forward(model, data)
    return data


@pytest.fixture(scope="module")
def bip_on_floor(bip_xml):
    spec = mujoco.MjSpec.from_file(bip_xml)
    floor = {"contype": FLOOR_CONTYPE, "conaffinity": FLOOR_CONAFFINITY}
    spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1], **floor)
    return spec.compile()


def test_every_shape_is_visual_or_sole_or_body_collision(bip_mujoco):
    assert len(geoms(bip_mujoco, VISUAL)) > 100
    assert [bip_mujoco.geom(k).name for k in geoms(bip_mujoco, SOLE)] == ["l_sole", "r_sole"]
    assert {bip_mujoco.body(bip_mujoco.geom_bodyid[k]).name for k in geoms(bip_mujoco, BODY_COLLISION)} == {
        *("pelvis", "trunk", "l_thigh", "r_thigh", "l_shank", "r_shank"),
    }
    assert len(geoms(bip_mujoco, VISUAL, SOLE, BODY_COLLISION)) == bip_mujoco.ngeom


def test_visual_shapes_touch_nothing(bip_mujoco):
    visuals = geoms(bip_mujoco, VISUAL)
    assert not bip_mujoco.geom_contype[visuals].any()
    assert not bip_mujoco.geom_conaffinity[visuals].any()


def test_soles_and_collision_shapes_touch_the_floor_but_not_each_other(bip_mujoco):
    solid = geoms(bip_mujoco, SOLE, BODY_COLLISION)
    contype, conaffinity = bip_mujoco.geom_contype[solid], bip_mujoco.geom_conaffinity[solid]
    assert not (contype[:, None] & conaffinity[None, :]).any()
    assert (contype & FLOOR_CONAFFINITY).all()
    assert (conaffinity & FLOOR_CONTYPE).all()


def test_shapes_do_not_change_the_dynamics(bip_xml, bip, bip_mujoco, configurations_in_range, tmp_path):
    tree = ElementTree.parse(bip_xml)
    for body in tree.iter("body"):
        for geom in body.findall("geom"):
            body.remove(geom)
    bare_xml = tmp_path / "bare.xml"
    tree.write(bare_xml)
    bare_mujoco = mujoco.MjModel.from_xml_path(str(bare_xml))
    assert bare_mujoco.ngeom == 0
    for field in ("body_mass", "body_inertia", "body_ipos", "body_iquat"):
        assert_allclose(getattr(bip_mujoco, field), getattr(bare_mujoco, field), rtol=0, atol=1e-12)
    bare = pin.buildModelFromMJCF(str(bare_xml))
    for q in configurations_in_range[:20]:
        M, M_bare = (np.triu(pin.crba(model, model.createData(), q)) for model in (bip, bare))
        assert_allclose(M, M_bare, rtol=0, atol=1e-12)


@pytest.mark.parametrize("foot", ["l", "r"])
def test_sole_is_the_published_trapezium_on_the_ground_when_all_joints_are_zero(foot, bip_mujoco):
    data = mujoco.MjData(bip_mujoco)
    mujoco.mj_forward(bip_mujoco, data)
    geom = bip_mujoco.geom(f"{foot}_sole").id
    corners = mesh_vertices(bip_mujoco, geom) @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    corners = corners[corners[:, 2] < 0.01]
    assert_allclose(corners[:, 2], 0, rtol=0, atol=1e-7)  # MuJoCo keeps mesh vertices in single precision
    outline = sorted((corners[:, :2] - data.body(f"{foot}_foot").xpos[:2]).tolist())
    assert_allclose(outline, SOLE_OUTLINE, rtol=0, atol=1e-7)


@pytest.mark.parametrize("ankle", list(product((-0.64, 0, 0.64), (-0.21, 0, 0.21))), ids=str)
def test_nothing_of_the_leg_sticks_out_below_the_sole(ankle, bip_mujoco):
    data = mujoco.MjData(bip_mujoco)
    set_joints(data, ankle_sagittal=ankle[0], ankle_frontal=ankle[1])
    mujoco.mj_forward(bip_mujoco, data)
    for side in ("l", "r"):
        up = data.body(f"{side}_foot").xmat.reshape(3, 3)[:, 2]
        sole = lowest(bip_mujoco, data, bip_mujoco.geom(f"{side}_sole").id, up)
        links = {bip_mujoco.body(f"{side}_{link}").id for link in ("thigh", "shank", "ankle_cross", "foot")}
        others = [k for k in geoms(bip_mujoco, VISUAL, BODY_COLLISION) if bip_mujoco.geom_bodyid[k] in links]
        assert min(lowest(bip_mujoco, data, k, up) for k in others) > sole - 1e-7  # the drawn pad ends with the sole


@pytest.mark.parametrize("bend", [0.1, 0.35, 0.6])
def test_only_the_soles_touch_the_ground_in_standing(bend, bip_on_floor):
    data = stand(bip_on_floor, ankle_sagittal=-bend, knee=2 * bend, hip_sagittal=-bend)
    touching = [{bip_on_floor.geom(k).name for k in contact.geom} for contact in data.contact]
    assert len(touching) == 8
    assert all(pair in ({"floor", "l_sole"}, {"floor", "r_sole"}) for pair in touching)


@pytest.mark.parametrize("push", [(1.5, 0), (-1.5, 0), (0, 1.5), (0, -1.5)], ids=["front", "back", "left", "right"])
def test_fallen_robot_lies_on_the_floor(push, bip_on_floor):
    data = stand(bip_on_floor, ankle_sagittal=-0.35, knee=0.65, hip_sagittal=-0.3)
    data.qvel[:2] = push
    bip_on_floor.opt.timestep = 0.002
    while data.time < 4:
        mujoco.mj_step(bip_on_floor, data)
    assert data.body("trunk").xpos[2] < 0.4
    height = {
        k: lowest(bip_on_floor, data, k, np.array([0, 0, 1.0]))
        for k in geoms(bip_on_floor, VISUAL, SOLE, BODY_COLLISION)
    }
    assert min(height[k] for k in geoms(bip_on_floor, SOLE, BODY_COLLISION)) > -0.002
    assert min(height[k] for k in geoms(bip_on_floor, VISUAL)) > -0.02  # what is drawn sinks in no deeper than this
