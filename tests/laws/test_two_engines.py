"""The dynamics terms of (1), from Pinocchio, against MuJoCo at random states, through the one layout conversion."""

import mujoco
import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.dynamics.links import evaluate_links
from surefoot.simulation.conventions import qpos_from_q, state_from_mujoco
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant

EXACT = {"rtol": 0, "atol": 1e-9}  # the same sums in another order, terms up to 1e3
SEEDS = range(8)


@pytest.fixture(scope="module")
def plant(robot):
    return Plant(robot, PhysicsSettings())


@pytest.fixture(params=SEEDS)
def both(request, plant, dynamics, random_state):
    """Terms at a random state, S with v_mujoco = S v, S' v, MuJoCo's model and its data there (in the air)."""
    state = random_state(request.param)
    state.q[2] = 10.0
    terms = dynamics.evaluate(state)
    R, v = terms.rotation_pelvis_to_world, state.v
    S = np.eye(21)
    S[:3, :3] = R
    S_rate_v = np.r_[R @ np.cross(v[3:6], v[:3]), np.zeros(18)]
    data = mujoco.MjData(plant.model)
    data.qpos, data.qvel = qpos_from_q(state.q), S @ v
    mujoco.mj_forward(plant.model, data)
    return terms, S, S_rate_v, plant.model, data


def full_mass_matrix(model, data) -> np.ndarray:
    M = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, M)
    return M


def test_state_survives_the_way_through_mujoco(both):
    terms, _, _, _, data = both
    state = state_from_mujoco(data.qpos, data.qvel, data.xmat[1].reshape(3, 3), 1.5)
    assert_allclose(state.q, terms.state.q, rtol=0, atol=1e-12)
    assert_allclose(state.v, terms.state.v, rtol=0, atol=1e-12)
    assert state.time_s == 1.5


def test_mass_matrix_is_mujocos(both):
    terms, S, _, model, data = both
    assert_allclose(terms.mass_matrix, S.T @ full_mass_matrix(model, data) @ S, **EXACT)


def test_bias_is_mujocos(both):
    terms, S, S_rate_v, model, data = both
    assert_allclose(terms.bias, S.T @ (data.qfrc_bias + full_mass_matrix(model, data) @ S_rate_v), **EXACT)


def test_centre_of_mass_and_its_velocity_are_mujocos(both):
    terms, S, _, model, data = both
    jacobian = np.zeros((3, model.nv))
    mujoco.mj_jacSubtreeCom(model, data, jacobian, 1)
    assert_allclose(terms.position_com_in_world, data.subtree_com[1], **EXACT)
    assert_allclose(terms.velocity_com_in_world, jacobian @ S @ terms.state.v, **EXACT)


def test_feet_are_mujocos(both, robot):
    terms, S, _, model, data = both
    for foot, at in zip(robot.feet, terms.feet, strict=True):
        body = model.body(foot.body).id
        translation, rotation = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        mujoco.mj_jacBody(model, data, translation, rotation, body)
        assert_allclose(at.position_ankle_in_world, data.xpos[body], **EXACT)
        assert_allclose(at.rotation_foot_to_world, data.xmat[body].reshape(3, 3), **EXACT)
        assert_allclose(at.jacobian, np.vstack((translation, rotation)) @ S, **EXACT)


def test_angular_momentum_is_mujocos(both):
    terms, _, _, model, data = both
    mujoco.mj_subtreeVel(model, data)
    assert_allclose(terms.centroidal_map @ terms.state.v, np.r_[terms.mass_kg * data.subtree_linvel[1],
                    data.subtree_angmom[1]], **EXACT)  # fmt: skip


def test_every_link_moves_as_in_mujoco(both, robot):
    terms, _, _, model, data = both
    links = evaluate_links(robot, terms.state, np.zeros(21))
    for i, name in enumerate(links.names):
        body = model.body(name).id
        twist = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, twist, 0)  # angular, linear at xipos
        R = links.rotation_link_to_world[i]
        inertial = data.ximat[body].reshape(3, 3)
        assert links.mass_kg[i] == pytest.approx(model.body_mass[body], rel=1e-12)
        assert_allclose(links.position_com[i], data.xipos[body], **EXACT)
        assert_allclose(R @ links.omega[i], twist[:3], **EXACT)
        assert_allclose(
            R @ links.inertia_at_com[i] @ R.T, inertial @ np.diag(model.body_inertia[body]) @ inertial.T, **EXACT
        )


def position_gap_after(step_s, terms, S, model, dynamics) -> tuple[np.ndarray, np.ndarray]:
    """Both engines move the configuration by the same velocity for a step: gap of the pelvis place, and of the rest."""
    qpos = qpos_from_q(terms.state.q)
    mujoco.mj_integratePos(model, qpos, S @ terms.state.v, step_s)
    gap = qpos - qpos_from_q(dynamics.integrate(terms.state.q, step_s * terms.state.v))
    return gap[:3], gap[3:]


def test_one_step_of_integration_agrees_to_second_order(both, dynamics):
    """MuJoCo moves the pelvis along a straight line, Pinocchio along the screw of its constant body velocity.

    So orientation and joints agree to rounding, and the place differs by R (omega x v) dt^2 / 2 + O(dt^3).
    """
    terms, S, S_rate_v, model, _ = both
    dt = 1e-3
    place, rest = position_gap_after(dt, terms, S, model, dynamics)
    assert_allclose(rest, 0.0, rtol=0, atol=1e-12)
    next_term = np.linalg.norm(terms.state.v[3:6]) ** 2 * np.linalg.norm(terms.state.v[:3]) * dt**3 / 6
    assert_allclose(place, -0.5 * S_rate_v[:3] * dt**2, rtol=0, atol=1.01 * next_term)


def test_free_flight_accelerates_alike(both):
    """Forward dynamics in both, no contact: q'' = -M^-1 bias is MuJoCo's qacc in our layout."""
    terms, S, S_rate_v, _, data = both
    ours = np.linalg.solve(terms.mass_matrix, -terms.bias)
    limited = np.flatnonzero(data.qfrc_constraint)
    assert limited.size == 0  # nothing touches, no joint stop acts
    assert_allclose(S @ ours + S_rate_v, data.qacc, rtol=0, atol=1e-8)  # cond(M) of some 1e3 on rounding
