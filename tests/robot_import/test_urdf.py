"""A robot as URDF: against Pinocchio's own reader of URDFs, and what of a URDF is refused, changed or left out."""

import mujoco
import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.robot.pinocchio_library import pin
from surefoot.robot_import.describe import describe
from surefoot.robot_import.inspection import Inspection, inspect_robot
from surefoot.robot_import.report import report
from surefoot.robot_import.urdf_source import read_urdf
from tests.support.small_biped import LEG
from tests.support.small_urdf import JOINT, hinge, link, mesh, urdf, write_stl

NAMED_FEET = '[feet.left]\nbody = "left_ankle_roll_link"\n[feet.right]\nbody = "right_ankle_roll_link"\n'
FINGERS = (
    link("thumb", 0.1, "0 0 0", (1e-4, 1e-4, 1e-4))
    + link("finger", 0.1, "0 0 0", (1e-4, 1e-4, 1e-4))
    + hinge("grip", "arm", "thumb", "0.3 0 0", "0 0 1")
    + hinge("follow", "arm", "finger", "0.3 0 0", "0 0 1", JOINT + '<mimic joint="grip" multiplier="-1"/>')
)
IDLE = '<link name="tip"/>' + hinge("nod", "arm", "tip", "0.3 0 0", "0 0 1")


@pytest.fixture
def read(tmp_path):
    """URDF text, and robot.toml text without its first line -> what is found."""

    def run(text: str, toml: str = "") -> Inspection:
        (tmp_path / "small.urdf").write_text(text)
        (tmp_path / "robot.toml").write_text(f'mjcf = "small.urdf"\n{toml}')
        return inspect_robot(tmp_path / "robot.toml")

    return run


def reasons(inspection: Inspection) -> str:
    return "; ".join(f"{problem.topic}: {problem.reason}: {problem.remedy}" for problem in inspection.problems)


def against_pinocchio(inspection: Inspection, text: str) -> tuple[float, float]:
    """Largest difference of M and of the bias N q' + G, to Pinocchio's own model of the URDF, at random states."""
    robot = inspection.robot
    assert robot is not None
    mine, other = robot.pinocchio, pin.buildModelFromXML(text, pin.JointModelFreeFlyer())
    order = [mine.joints[mine.getJointId(name)].idx_v for name in list(other.names)[2:]]
    rows, random = [*range(6), *order], np.random.default_rng(3)
    data, twin, worst = mine.createData(), other.createData(), np.zeros(2)
    for _ in range(5):
        angles, v = random.uniform(-1.0, 1.0, other.nv - 6), random.normal(size=other.nv)
        base = np.concatenate((random.normal(size=3), (0.48, -0.6, 0.0, 0.64)))
        q, w = np.zeros(mine.nq), np.zeros(mine.nv)
        q[:7], w[rows] = base, v
        q[np.array(order) + 1] = angles
        pin.computeAllTerms(mine, data, q, w)
        pin.computeAllTerms(other, twin, np.concatenate((base, angles)), v)
        one, two = (np.triu(terms.M) + np.triu(terms.M, 1).T for terms in (data, twin))
        worst = np.maximum(
            worst, (np.abs(one[np.ix_(rows, rows)] - two).max(), np.abs(data.nle[rows] - twin.nle).max())
        )
    return float(worst[0]), float(worst[1])


def test_what_is_found(read):
    dynamics = '<dynamics damping="0.3" friction="0.1"/>'
    table = report(read(urdf(joint=JOINT + dynamics)))
    assert table["fit"], table["problems"]
    assert table["mass_kg"] == pytest.approx(19.8)
    assert (table["joint_count"], table["upper_joints"]) == (14, ["waist", "shoulder"])
    knee = next(joint for joint in table["joints"] if joint["name"] == "left_knee")
    assert (knee["torque_limit_nm"], knee["limit_source"]) == (60.0, "effort of the joint's <limit>")
    assert (knee["damping_nms"], knee["friction_nm"], knee["rotor_inertia_kgm2"]) == (0.3, 0.1, 0.0)
    assert table["feet"]["left"]["sole"]["length_m"] == pytest.approx(0.18)
    assert "velocity limits of joints: 14" in table["dropped"]
    assert not any("Pinocchio" in line for line in table["changed"])


def test_dynamics_are_those_that_pinocchio_reads_from_the_urdf(read):
    turned = urdf().replace('<origin xyz="0 0 0.15"/><mass', '<origin xyz="0 0.02 0.15" rpy="0.3 -0.4 0.5"/><mass')
    assert turned != urdf()
    assert max(against_pinocchio(read(turned), turned)) < 1e-9


def test_massless_links_between_hinges_and_point_masses_are_taken(read):
    """They get 1e-9 kg and kg m2: M and bias move by as little."""
    leg = [(*LEG[0][:3], 0.0), *LEG[1:]]
    text = urdf(leg=leg).replace('ixx="0.001" iyy="0.001" izz="0.001"', 'ixx="0" iyy="0" izz="0"')
    nothing = '<mass value="0.0"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/>'
    moments = '<mass value="0.0"/><inertia ixx="0.004" iyy="0.003" izz="0.002" ixy="0" ixz="0" iyz="0"/>'
    text = text.replace(moments, nothing, 1)  # the left link has nothing at all, the right one moments without mass
    assert text.count(nothing) == text.count(moments) == 1
    inspection = read(text)
    assert not inspection.problems, reasons(inspection)
    assert inspection.robot is not None
    changed = "; ".join(inspection.robot.plain.changed)
    assert "links that move and have no mass given 1e-09 kg: left_hip_yaw_link, right_hip_yaw_link" in changed
    assert "links with no inertia about an axis given 1e-09 kg m2 more: arm" in changed
    assert max(against_pinocchio(inspection, text)) < 1e-6


def test_links_without_inertial_weigh_nothing_whatever_their_shapes(read):
    shape = "<collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision>"
    camera = f'<link name="camera">{shape}</link>' + hinge("mount", "trunk", "camera", "0 0 0.4", "0 0 1", "", "fixed")
    root = '<link name="footprint"/>' + hinge("up", "footprint", "pelvis", "0 0 0", "0 0 1", "", "fixed")
    text = urdf(extra=camera + root)
    inspection = read(text)
    assert not inspection.problems, reasons(inspection)
    assert inspection.robot is not None
    assert inspection.robot.model.body_mass.sum() == pytest.approx(19.8)
    assert inspection.robot.tree.body_name(inspection.robot.tree.base) == "footprint"
    assert max(against_pinocchio(inspection, text)) < 1e-9


@pytest.mark.parametrize(
    ("extra", "topic", "said", "names"),
    [
        (FINGERS, "loops", "couples the joints follow and grip", '["follow", "grip"]'),
        (IDLE, "joints", "nothing that has mass hangs on the joints nod", '["nod"]'),
    ],
)
def test_coupled_and_idle_joints_are_refused_and_can_be_frozen(read, extra, topic, said, names):
    refused = read(urdf(extra=extra))
    assert [problem.topic for problem in refused.problems] == [topic]
    assert said in reasons(refused) and f"frozen = {names}" in reasons(refused)
    frozen = read(urdf(extra=extra), f"frozen = {names}\n")
    assert not frozen.problems, reasons(frozen)


@pytest.mark.parametrize(
    ("kind", "more", "said"),
    [
        ("prismatic", JOINT, "lift is a slide joint"),
        ("continuous", '<limit effort="5"/>', ""),
        ("revolute", '<limit lower="-1" upper="1"/>', "1 of 15 joints have no torque limit: lift"),
        ("planar", "", "lift_TX is a slide joint"),
    ],
)
def test_kinds_of_joints(read, kind, more, said):
    inspection = read(
        urdf(
            extra=link("head", 0.2, "0 0 0", (1e-3, 1e-3, 1e-3))
            + hinge("lift", "trunk", "head", "0 0 0.4", "0 0 1", more, kind)
        )
    )
    assert said in reasons(inspection) if said else not inspection.problems
    if kind == "continuous":
        assert inspection.robot is not None
        assert "joints without a range, -180 to 180 deg taken: lift" in inspection.robot.plain.changed


def test_a_floating_joint_below_the_world_frees_the_base(read):
    text = urdf(extra='<link name="world"/>' + hinge("root", "world", "pelvis", "0 0 0.6", "0 0 1", "", "floating"))
    inspection = read(text)
    assert not inspection.problems, reasons(inspection)
    assert inspection.robot is not None
    assert inspection.robot.tree.body_name(inspection.robot.tree.base) == "pelvis"
    assert not any("fixed to the world" in line for line in inspection.robot.plain.changed)


def test_joints_that_cannot_stand_at_zero_stand_a_little_inside_their_range(read):
    text = urdf().replace('lower="-2" upper="2"', 'lower="0.5" upper="2.5"')
    inspection = read(text)
    assert inspection.robot is not None
    assert inspection.robot.posture.angles(inspection.robot.model)["shoulder"] == pytest.approx(0.54)
    assert (
        "joints at or beyond an end of their range at 0, put 2 % of it inside: shoulder"
        in inspection.robot.plain.changed
    )
    said = read(text, "[posture]\nshoulder = 0.5\n")
    assert said.robot is not None and said.robot.posture.angles(said.robot.model)["shoulder"] == 0.5
    table = report(said)
    assert table["fit"], table["problems"]  # at the end of its range is not beyond it


def test_shapes_of_meshes_are_drawn_or_touch(read, tmp_path):
    """Two meshes of one file name; a link whose only shape touches shows that one."""
    write_stl(tmp_path / "visual" / "a.stl")
    write_stl(tmp_path / "collision" / "a.stl", size_m=0.2)
    trunk = mesh("visual", "visual/a.stl") + mesh("collision", "collision/a.stl")
    text = urdf(trunk=trunk).replace('<link name="arm">', f'<link name="arm">{mesh("collision", "collision/a.stl")}')
    inspection = read(text)
    robot = inspection.robot
    assert robot is not None and not inspection.problems, reasons(inspection)
    model = mujoco.MjModel.from_xml_string(describe(robot).mjcf_xml)
    found = {}
    for geom in np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_MESH):
        body = model.body(int(model.geom_bodyid[geom])).name
        size = float(np.ptp(model.mesh_vert[model.mesh_vertadr[model.geom_dataid[geom]] :][:4]))
        found.setdefault(body, []).append(
            (bool(model.geom_group[geom] < 3), bool(model.geom_contype[geom]), size > 0.1)
        )
    assert sorted(found["trunk"]) == [(False, True, True), (True, False, False)]
    assert found["arm"] == [(True, True, True)]


def test_meshes_that_mujoco_does_not_decode_are_left_out_and_told(read, tmp_path):
    (tmp_path / "a.dae").write_text("<COLLADA/>")
    (tmp_path / "b.stl").write_text("solid b\nendsolid b\n" + " " * 100)
    inspection = read(urdf(trunk=mesh("visual", "a.dae") + mesh("collision", "b.stl")))
    assert inspection.robot is not None and not inspection.problems, reasons(inspection)
    told = "; ".join(inspection.robot.plain.dropped)
    assert "visual shapes that MuJoCo does not decode (.dae): 1 (a.dae); " in told
    assert "collision shapes that MuJoCo does not decode (ASCII STL): 1 (b.stl); to have those shapes, convert" in told
    assert told.count("convert") == 1


def test_a_sole_that_mujoco_does_not_decode_asks_for_corners(read, tmp_path):
    (tmp_path / "foot.dae").write_text("<COLLADA/>")
    assert "say its corners" in reasons(read(urdf(sole=mesh("collision", "foot.dae")), NAMED_FEET))


def test_a_mesh_that_is_nowhere_is_named_with_the_places(read, tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/opt/none")
    with pytest.raises(InvalidInput) as refused:
        read(urdf(trunk=mesh("collision", "package://robo/gone.stl")))
    for words in ("package://robo/gone.stl", str(tmp_path), "ROS_PACKAGE_PATH (/opt/none)"):
        assert words in str(refused.value)
    inspection = read(urdf(trunk=mesh("visual", "package://robo/gone.stl")))
    assert inspection.robot is not None and not inspection.problems, reasons(inspection)
    assert any(
        "visual meshes not found: 1 (package://robo/gone.stl)" in line for line in inspection.robot.plain.dropped
    )


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.urdf.xacro", urdf()),
        ("a.urdf", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="b"/></robot>'),
        ("a.urdf", '<robot><xacro:include filename="b"/></robot>'),
        ("a.urdf", urdf(trunk=mesh("visual", "$(find robo)/a.stl"))),
    ],
)
def test_xacro_is_to_be_expanded_first(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    with pytest.raises(InvalidInput, match=r"must be expanded first: xacro .* > a\.urdf"):
        inspect_robot(tmp_path / name)


def test_what_xacro_leaves_behind_is_no_xacro(tmp_path):
    text = urdf(extra='<!-- <xacro:include filename="${x}"/> --><gazebo reference="arm"/>')
    (tmp_path / "a.urdf").write_text(text.replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'))
    assert "<gazebo>: 1" in read_urdf(tmp_path / "a.urdf").left_out


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("<robot><link", "is no XML"),
        ("<mujoco/>", "is no URDF: its first element is <mujoco>"),
        ('<robot name="a"><joint name="j" type="fixed"/></robot>', "is no URDF that MuJoCo reads"),
        (urdf().replace('mass value="0.4"', 'mass value="heavy"'), "is no URDF that MuJoCo reads"),
    ],
)
def test_what_is_no_urdf(tmp_path, text, said):
    (tmp_path / "a.urdf").write_text(text)
    with pytest.raises(InvalidInput, match=said):
        inspect_robot(tmp_path / "a.urdf")
