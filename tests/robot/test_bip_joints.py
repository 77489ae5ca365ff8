"""Every joint is the published one: number, axis, range, rotor inertia, direction; and the limits are those we chose.

Origin of the table: numbers and axes from the paper (doi 10.1533/abbi.2004.0055) and the published Bip model (P.-B.
Wieber, INRIA, 1999-2005), turned to x forward, y left, z up; ranges and reflected rotor inertias (at the start posture:
ankles sagittal -0.1, knees 0.2, hips sagittal -0.1 rad) from the published model; torque limits chosen by us.
"""

import mujoco
import numpy as np
import pinocchio as pin
import pytest

# name, paper number, axis, lower and upper end [rad], rotor inertia [kg m2], torque limit [N m]; in velocity order
JOINTS = (
    ("left_hip_frontal", 11, (1, 0, 0), -0.17, 0.17, 2.5735, 350),
    ("left_hip_yaw", 12, (0, 0, 1), -0.14, 0.14, 0.7475, 150),
    ("left_hip_sagittal", 8, (0, 1, 0), -1.17, 0.20, 0.7411, 350),
    ("left_knee", 7, (0, 1, 0), 0.11, 1.41, 0.4820, 350),
    ("left_ankle_sagittal", 6, (0, 1, 0), -0.64, 0.64, 0.5730, 250),
    ("left_ankle_frontal", 5, (1, 0, 0), -0.21, 0.21, 0.2327, 150),
    ("right_hip_frontal", 9, (-1, 0, 0), -0.17, 0.17, 2.5735, 350),
    ("right_hip_yaw", 10, (0, 0, -1), -0.14, 0.14, 0.7475, 150),
    ("right_hip_sagittal", 4, (0, 1, 0), -1.17, 0.20, 0.7411, 350),
    ("right_knee", 3, (0, 1, 0), 0.11, 1.41, 0.4820, 350),
    ("right_ankle_sagittal", 2, (0, 1, 0), -0.64, 0.64, 0.5730, 250),
    ("right_ankle_frontal", 1, (-1, 0, 0), -0.21, 0.21, 0.2327, 150),
    ("trunk_yaw", 13, (0, 0, 1), -0.17, 0.17, 0.6570, 300),
    ("trunk_frontal", 14, (1, 0, 0), -0.08, 0.08, 0.8883, 300),
    ("trunk_sagittal", 15, (0, -1, 0), -0.21, 0.08, 3.0073, 300),
)
NAMES = [joint[0] for joint in JOINTS]
UP, DOWN, LEFT, RIGHT, BACK = np.array([[0, 0, 1], [0, 0, -1], [0, 1, 0], [0, -1, 0], [-1, 0, 0]])

# What a positive angle does: joint -> which point (link, place in its frame [m]) moves where, at which lever [m].
POSITIVE_ANGLE = {
    "left_ankle_frontal": ("l_foot", (0.17, 0.09, -0.083), UP, 0.09),  # outer edge up
    "right_ankle_frontal": ("r_foot", (0.17, -0.09, -0.083), UP, 0.09),
    "left_ankle_sagittal": ("l_foot", (0.17, 0, -0.083), DOWN, 0.17),  # toes down
    "right_ankle_sagittal": ("r_foot", (0.17, 0, -0.083), DOWN, 0.17),
    "left_knee": ("l_shank", (0, 0, -0.41), BACK, 0.41),  # knee flexes, shank backward
    "right_knee": ("r_shank", (0, 0, -0.41), BACK, 0.41),
    "left_hip_sagittal": ("l_thigh", (0, 0, -0.41), BACK, 0.41),  # thigh backward
    "right_hip_sagittal": ("r_thigh", (0, 0, -0.41), BACK, 0.41),
    "left_hip_frontal": ("l_thigh", (0, 0, -0.41), LEFT, 0.41),  # leg outward
    "right_hip_frontal": ("r_thigh", (0, 0, -0.41), RIGHT, 0.41),
    "left_hip_yaw": ("l_foot", (0.17, 0, -0.083), LEFT, 0.17),  # toes out
    "right_hip_yaw": ("r_foot", (0.17, 0, -0.083), RIGHT, 0.17),
    "trunk_yaw": ("trunk", (0.15, 0, 0.66), LEFT, 0.15),  # trunk turns left
    "trunk_frontal": ("trunk", (0, 0, 0.66), RIGHT, 0.66),  # trunk leans right
    "trunk_sagittal": ("trunk", (0, 0, 0.66), BACK, 0.66),  # trunk leans backward
}


def test_both_engines_have_the_joints_in_the_order_left_leg_right_leg_trunk(bip, bip_mujoco):
    assert list(bip.names) == ["universe", "root", *NAMES]
    assert [bip_mujoco.joint(k).name for k in range(bip_mujoco.njnt)] == ["root", *NAMES]
    assert [bip_mujoco.actuator(k).name for k in range(bip_mujoco.nu)] == NAMES
    assert (bip.nq, bip.nv, bip_mujoco.nq, bip_mujoco.nv) == (22, 21, 22, 21)


@pytest.mark.parametrize(("name", "number", "axis", "lower", "upper", "rotor", "limit"), JOINTS, ids=NAMES)
def test_joint_has_the_tabled_numbers_in_both_engines(
    name, number, axis, lower, upper, rotor, limit, bip, bip_mujoco
):  # fmt: skip
    joint, motor = bip_mujoco.joint(name), bip_mujoco.actuator(name)
    assert joint.user[0] == number
    assert joint.axis.tolist() == list(axis)
    assert joint.range.tolist() == [lower, upper]
    assert bip_mujoco.dof_armature[joint.dofadr[0]] == rotor
    assert bip_mujoco.joint(motor.trnid[0]).name == name
    assert motor.gear[0] == 1
    assert motor.ctrlrange.tolist() == [-limit, limit]

    joint = bip.joints[bip.getJointId(name)]
    straight = pin.computeJointJacobians(bip, bip.createData(), pin.neutral(bip))
    assert straight[3:, joint.idx_v] == pytest.approx(axis, rel=0, abs=1e-15)
    assert (bip.lowerPositionLimit[joint.idx_q], bip.upperPositionLimit[joint.idx_q]) == (lower, upper)
    assert bip.armature[joint.idx_v] == rotor


@pytest.mark.parametrize("name", NAMES)
def test_positive_angle_moves_the_robot_as_described(name, bip):
    link, place, direction, lever = POSITIVE_ANGLE[name]
    data, heights = bip.createData(), []
    for angle in (0.0, 0.05):
        q = pin.neutral(bip)
        q[bip.joints[bip.getJointId(name)].idx_q] = angle
        pin.framesForwardKinematics(bip, data, q)
        heights.append(direction @ data.oMf[bip.getFrameId(link)].act(np.array(place, dtype=float)))
    # The second-order term is at most (distance to the axis) x 0.05^2 / 2 < 0.02 x 0.05 x lever.
    assert heights[1] - heights[0] == pytest.approx(0.05 * lever, rel=0.03)


def test_paper_numbers_are_one_to_fifteen_each_once(bip_mujoco):
    assert sorted(bip_mujoco.jnt_user[1:, 0]) == list(range(1, 16))


def test_readme_of_the_model_says_what_the_table_says(bip_readme_tables):
    rows = {cells[1].strip("`"): cells for cells in bip_readme_tables if len(cells) == 6 and cells[0].isdigit()}
    limits = {
        cells[0].strip("`"): float(cells[1]) for cells in bip_readme_tables if len(cells) == 3 and cells[0][0] == "`"
    }
    assert set(rows) == set(NAMES)
    for name, number, axis, lower, upper, rotor, limit in JOINTS:
        k, _, axis_text, _, range_text, rotor_text = rows[name]
        assert int(k) == number
        assert [float(x) for x in axis_text.strip("()").split(",")] == list(axis)
        assert [float(x) for x in range_text.strip("[]").split(",")] == [lower, upper]
        assert float(rotor_text) == rotor
        assert limits[name.replace("left", "*").replace("right", "*")] == limit


def test_names_of_the_free_joint_and_ankle_sites_are_kept(bip, bip_mujoco):
    assert bip_mujoco.jnt_type[0] == mujoco.mjtJoint.mjJNT_FREE
    assert [bip_mujoco.site(k).name for k in range(bip_mujoco.nsite)] == ["l_ankle", "r_ankle"]
    assert bip.existFrame("l_ankle") and bip.existFrame("r_ankle")
