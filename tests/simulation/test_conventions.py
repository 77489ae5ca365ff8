"""The layout of a state on its way from and to MuJoCo."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from surefoot.simulation.conventions import qpos_from_q, state_from_mujoco


def test_quaternion_changes_place_of_its_real_part():
    q = np.arange(22.0)
    assert qpos_from_q(q)[:8].tolist() == [0, 1, 2, 6, 3, 4, 5, 7]
    assert qpos_from_q(q)[7:].tolist() == q[7:].tolist()


@pytest.mark.parametrize("seed", range(5))
def test_there_and_back_is_the_same_state(seed):
    rng = np.random.default_rng(seed)
    rotation = Rotation.random(rng=rng)
    q, v = rng.normal(size=22), rng.normal(size=21)
    q[3:7] = rotation.as_quat()  # x, y, z, w
    R = rotation.as_matrix()
    qvel = v.copy()
    qvel[:3] = R @ v[:3]  # MuJoCo: linear velocity in world axes, angular in the pelvis'
    state = state_from_mujoco(qpos_from_q(q), qvel, R, 0.25)
    assert_allclose(state.q, q, rtol=0, atol=0)
    assert_allclose(state.v, v, rtol=0, atol=1e-14)
    assert state.time_s == 0.25


def test_a_state_is_a_copy():
    qpos, qvel = np.arange(22.0), np.arange(21.0)
    state = state_from_mujoco(qpos, qvel, np.eye(3), 0.0)
    state.q[:], state.v[:] = -1.0, -1.0
    assert qpos.tolist() == list(range(22))
    assert qvel.tolist() == list(range(21))
    q = np.arange(22.0)
    qpos_from_q(q)[:] = -1.0
    assert q.tolist() == list(range(22))
