"""MuJoCo and Pinocchio read the same robot from the one file.

Pelvis velocity: Pinocchio's is linear and angular in the pelvis frame; MuJoCo's linear is in the world, angular in the
pelvis. So v_mujoco = S v with S = diag(R, 1, 1), and the accelerations differ by S' v = (R (omega x v), 0, 0) too.
"""

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

EXACT = {"rtol": 0, "atol": 1e-9}


@pytest.fixture(params=range(8))
def both(request, bip, bip_mujoco):
    """One random state, evaluated by both engines: (q, v, S, S' v, MuJoCo's data)."""
    rng = np.random.default_rng(request.param)
    q = pin.integrate(bip, pin.neutral(bip), np.r_[rng.normal(size=6), np.zeros(15)])
    q[7:] = rng.uniform(bip.lowerPositionLimit[7:], bip.upperPositionLimit[7:])
    v = rng.normal(size=bip.nv)
    R = pin.Quaternion(q[3:7]).toRotationMatrix()
    S = np.eye(bip.nv)
    S[:3, :3] = R
    S_rate_v = np.r_[R @ np.cross(v[3:6], v[:3]), np.zeros(18)]
    data = mujoco.MjData(bip_mujoco)
    data.qpos = np.r_[q[:3], q[6], q[3:6], q[7:]]
    data.qvel = S @ v
    mujoco.mj_forward(bip_mujoco, data)
    return q, v, S, S_rate_v, data


def mujoco_mass_matrix(model, data):
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    return M


def test_mass_matrices_agree(both, bip, bip_mujoco):
    q, _, S, _, data = both
    upper = np.triu(pin.crba(bip, bip.createData(), q))
    M = upper + np.triu(upper, 1).T
    assert_allclose(S.T @ mujoco_mass_matrix(bip_mujoco, data) @ S, M, **EXACT)


def test_bias_forces_agree(both, bip, bip_mujoco):
    q, v, S, S_rate_v, data = both
    bias = pin.nonLinearEffects(bip, bip.createData(), q, v)
    M_mujoco = mujoco_mass_matrix(bip_mujoco, data)
    assert_allclose(S.T @ (data.qfrc_bias + M_mujoco @ S_rate_v), bias, **EXACT)


def test_every_link_is_at_the_same_place(both, bip, bip_mujoco):
    q, _, _, _, data = both
    kinematics = bip.createData()
    pin.framesForwardKinematics(bip, kinematics, q)
    for body in range(1, bip_mujoco.nbody):
        frame = kinematics.oMf[bip.getFrameId(bip_mujoco.body(body).name)]
        assert_allclose(data.xpos[body], frame.translation, **EXACT)
        assert_allclose(data.xmat[body].reshape(3, 3), frame.rotation, **EXACT)


def test_free_joint_position_is_absolute_in_both_engines(bip, bip_mujoco):
    """The pelvis body's ``pos`` is only the default of ``qpos``: q[:3] is the world position of the pelvis."""
    data = bip.createData()
    q = pin.neutral(bip)
    assert q[:3].tolist() == [0, 0, 0]
    q[:3] = 1, 2, 3
    pin.framesForwardKinematics(bip, data, q)
    assert data.oMf[bip.getFrameId("pelvis")].translation.tolist() == [1, 2, 3]
    assert bip_mujoco.qpos0[:3].tolist() == [0, 0, 0.903]
    assert bip.referenceConfigurations["qpos0"][:3].tolist() == [0, 0, 0.903]


def test_mass_and_gravity_agree(bip, bip_mujoco):
    assert_allclose(bip_mujoco.body_mass.sum(), 104.81, **EXACT)
    assert_allclose(bip_mujoco.opt.gravity, bip.gravity.linear, **EXACT)
    assert_allclose(bip.gravity.linear, [0, 0, -9.81], **EXACT)
