"""The model meets the published robot at 12 states, where that robot's own generated dynamics were evaluated."""

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

EXACT = {"rtol": 0, "atol": 1e-9}
TO_PUBLISHED = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # ours (x, y, z), z up -> published (x, z, -y), y up

# Index among the published contact points -> foot, corner relative to the ankle in the foot frame [m].
CORNERS = {
    0: ("r_foot", (0.17, -0.09, -0.083)),  # toe outer
    1: ("r_foot", (0.17, 0.09, -0.083)),  # toe inner
    2: ("r_foot", (-0.12, -0.06, -0.083)),  # heel outer
    3: ("r_foot", (-0.12, 0.06, -0.083)),  # heel inner
    10: ("l_foot", (0.17, 0.09, -0.083)),
    11: ("l_foot", (0.17, -0.09, -0.083)),
    12: ("l_foot", (-0.12, 0.06, -0.083)),
    13: ("l_foot", (-0.12, -0.06, -0.083)),
}


def mass_matrix(model, q):
    upper = np.triu(pin.crba(model, model.createData(), q))
    return upper + np.triu(upper, 1).T


def test_total_mass_is_the_published_one(bip):
    assert_allclose(sum(inertia.mass for inertia in bip.inertias), 104.81, **EXACT)


def test_masses_and_centres_of_mass_are_the_published_ones(bip, published_links):
    assert len(published_links) == 16
    for name, (mass, com, _) in published_links.items():
        inertia = bip.inertias[bip.frames[bip.getFrameId(name)].parentJoint]
        assert_allclose(inertia.mass, mass, **EXACT)
        assert_allclose(inertia.lever, com, **EXACT)


def test_centre_of_mass_meets_the_published_one(bip, published):
    com = pin.centerOfMass(bip, bip.createData(), published.configuration)
    assert_allclose(TO_PUBLISHED @ com, published.data["com"], **EXACT)


def test_sole_corners_meet_the_published_ones(bip, published):
    data = bip.createData()
    pin.framesForwardKinematics(bip, data, published.configuration)
    for index, (foot, corner) in CORNERS.items():
        position = data.oMf[bip.getFrameId(foot)].act(np.array(corner))
        assert_allclose(TO_PUBLISHED @ position, published.data["contact"][index], **EXACT)


def test_jacobians_of_the_sole_corners_meet_the_published_ones(bip, published):
    data = bip.createData()
    pin.computeJointJacobians(bip, data, published.configuration)
    pin.updateFramePlacements(bip, data)
    for index, (foot, corner) in CORNERS.items():
        frame = bip.getFrameId(foot)
        foot_jacobian = pin.getFrameJacobian(bip, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        lever = data.oMf[frame].rotation @ corner
        corner_jacobian = foot_jacobian[:3] - pin.skew(lever) @ foot_jacobian[3:]
        assert_allclose(TO_PUBLISHED @ corner_jacobian @ published.T, published.data["contact_jac"][index], **EXACT)


def test_gravity_meets_the_published_one(bip, published):
    gravity = pin.computeGeneralizedGravity(bip, bip.createData(), published.configuration)
    assert_allclose(published.T.T @ gravity, published.data["G"], **EXACT)


def test_bias_of_the_table_inertias_meets_the_published_one(bip_of_published_table, published):
    model = bip_of_published_table
    bias = pin.nonLinearEffects(model, model.createData(), published.configuration, published.velocity)
    M = mass_matrix(model, published.configuration)
    assert_allclose(
        published.T.T @ (M @ published.T_rate @ published.qdot + bias), published.data["N_norotor"], **EXACT
    )


def test_base_rows_of_the_mass_matrix_of_the_table_inertias_meet_the_published_ones(bip_of_published_table, published):
    M = published.T.T @ mass_matrix(bip_of_published_table, published.configuration) @ published.T
    assert_allclose(M[15:], published.data["M"][15:], **EXACT)


def test_joint_block_without_rotors_is_smaller_than_the_published_one_with_rotors(bip_of_published_table, published):
    M = published.T.T @ mass_matrix(bip_of_published_table, published.configuration) @ published.T
    rotors = (published.data["M"] - M)[:15, :15]
    assert np.linalg.eigvalsh(rotors).min() > 0.1  # smallest published reflected inertia: ankle frontal, 0.147 kg m2


@pytest.mark.parametrize("engine", ["pinocchio", "mujoco"])
def test_inertias_are_those_of_possible_bodies(engine, bip, bip_mujoco):
    bodies = (
        [inertia.inertia for inertia in list(bip.inertias)[1:]]
        if engine == "pinocchio"
        else [np.diag(moments) for moments in bip_mujoco.body_inertia[1:]]
    )
    assert len(bodies) == 16
    for inertia in bodies:
        second_moments = np.trace(inertia) / 2 * np.eye(3) - inertia  # positive for a body with mass in every direction
        assert np.linalg.eigvalsh(second_moments).min() > 0


def test_realizable_inertias_move_the_mass_matrix_by_less_than_a_thousandth(
    bip, bip_of_published_table, configurations_in_range
):
    rotors = np.diag(bip.armature)
    worst = max(
        np.abs(mass_matrix(bip, q) - rotors - mass_matrix(bip_of_published_table, q)).max()
        for q in configurations_in_range
    )
    assert worst < 1e-3  # kg m2, kg m
    assert worst == pytest.approx(5.06e-4, rel=0.01)  # what the README of the model says
