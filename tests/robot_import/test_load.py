"""A robot's file as the description that controllers and simulation take: against MuJoCo's model of the same text."""

import mujoco
import pytest

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import InvalidInput
from surefoot.robot.feet import Support
from surefoot.robot_import.load import load_robot_file
from surefoot.simulation.conventions import qpos_from_q
from surefoot.task.posture import solve_posture, standing_reference
from tests.support.small_biped import LEG, biped

POSTURE = "[posture]\nleft_knee = 0.5\nright_knee = 0.5\n"


@pytest.fixture
def load(tmp_path):
    """MJCF and robot.toml without its first line -> the description."""

    def run(mjcf: str, toml: str = ""):
        (tmp_path / "small.xml").write_text(mjcf)
        (tmp_path / "robot.toml").write_text(f'mjcf = "small.xml"\n{toml}')
        return load_robot_file(tmp_path / "robot.toml")

    return run


def test_what_the_controllers_take(load):
    robot = load(biped(joint='range="-1.5 1.5" armature="0.02" damping="0.3" frictionloss="0.1"'), POSTURE)
    assert (robot.name, robot.base, robot.trunk, robot.dofs) == ("small", "pelvis", "trunk", 20)
    assert robot.mass_kg == pytest.approx(19.8)
    knee = robot.joint_named("left_knee")
    assert (knee.torque_limit_nm, knee.rotor_inertia_kgm2, knee.damping, knee.friction_nm) == (60.0, 0.02, 0.3, 0.1)
    assert [robot.joints[dof - 6].name for dof in robot.feet[1].leg] == [f"right_{name}" for name, *_ in LEG]
    assert [robot.joints[dof - 6].name for dof in robot.upper] == ["waist", "shoulder"]
    left = robot.feet[0]
    assert (robot.joints[left.sagittal - 6].name, robot.joints[left.frontal - 6].name) == (
        "left_ankle_pitch",
        "left_ankle_roll",
    )
    assert left.ankle_height_m == pytest.approx(0.05)


def test_it_stands_with_level_soles_whatever_the_bend_in_its_posture(load):
    """The controllers' standing posture, its corners placed by MuJoCo: all eight in the plane z = 0."""
    robot = load(biped(), POSTURE)
    assert robot.posture_rad["left_knee"] == 0.5
    q = solve_posture(DynamicsModel(robot), standing_reference(robot, Support.DOUBLE)).q
    model = mujoco.MjModel.from_xml_string(robot.mjcf_xml)
    data = mujoco.MjData(model)
    data.qpos[:] = qpos_from_q(q)
    mujoco.mj_forward(model, data)
    for foot in robot.feet:
        body = data.body(foot.body)
        for corner in foot.corners_from_ankle:
            point = body.xpos + body.xmat.reshape(3, 3) @ (foot.ankle_in_body + foot.rotation_in_body @ corner)
            assert point[2] == pytest.approx(0.0, abs=1e-9)


def test_both_libraries_read_the_simulated_text_and_its_motors(load):
    robot = load(biped(), POSTURE)
    model = mujoco.MjModel.from_xml_string(robot.mjcf_xml)
    assert model.nu == len(robot.joints)
    assert [model.actuator(i).name for i in range(model.nu)] == [joint.name for joint in robot.joints]
    assert model.actuator_ctrlrange[:, 1] == pytest.approx(robot.torque_limits)
    assert robot.pinocchio_model.nv == model.nv == robot.dofs


def test_one_that_is_not_fit_is_refused_with_the_remedy(load):
    with pytest.raises(InvalidInput, match=r"five-joint legs.*surefoot robot check"):
        load(biped(leg=LEG[:5]))
