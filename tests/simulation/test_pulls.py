"""Pulls: a spring on the held point, never too strong, and nothing at all when nobody pulls."""

import mujoco
import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.simulation.external_forces import LARGEST_N, STIFFNESS_N_PER_M, Pull


def position_of(simulation, pull, qpos) -> np.ndarray:
    """The held point (3,) in world for joint positions of MuJoCo's, by a model and data of our own."""
    model = simulation.plant.model
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    mujoco.mj_kinematics(model, data)
    body = model.body(pull.link).id
    return data.xpos[body] + data.xmat[body].reshape(3, 3) @ np.array(pull.point)


@pytest.mark.parametrize("link", ["trunk", "r_shank", "l_thigh"])
def test_its_generalized_force_does_the_work_of_the_force_at_the_held_point(simulate, link):
    simulation = simulate()
    for _ in range(5):
        simulation.tick()
    plant = simulation.plant
    here = position_of(simulation, Pull(link=link, point=(0.02, -0.03, 0.1), target=(0, 0, 0)), plant.data.qpos)
    target = here + (0.05, 0.04, -0.02)
    pull = Pull(link=link, point=(0.02, -0.03, 0.1), target=tuple(target.tolist()))
    qpos, qvel = plant.data.qpos.copy(), plant.data.qvel.copy()
    plant.step(np.zeros(15), (), (pull,))
    applied = plant.data.qfrc_applied.copy()
    force = STIFFNESS_N_PER_M * (target - here)  # at rest the damping has next to nothing to do
    assert np.linalg.norm(qvel) < 1e-2
    rng = np.random.default_rng(3)
    for _ in range(4):
        motion, step = rng.normal(size=21), 1e-6
        ahead, behind = qpos.copy(), qpos.copy()
        mujoco.mj_integratePos(plant.model, ahead, motion, step)
        mujoco.mj_integratePos(plant.model, behind, motion, -step)
        velocity = (position_of(simulation, pull, ahead) - position_of(simulation, pull, behind)) / (2.0 * step)
        assert applied.dot(motion) == pytest.approx(force.dot(velocity), rel=1e-2, abs=0.05)


def test_a_pulled_robot_moves_towards_the_hand_and_comes_back_when_let_go(simulate):
    simulation = simulate()
    simulation.tick()
    start = simulation.plant.position_com()
    trunk = simulation.plant.data.xpos[simulation.plant.model.body("trunk").id].copy()
    simulation.pulls["me"] = Pull(
        link="trunk", point=(0.0, 0.0, 0.0), target=tuple((trunk + (0.15, 0.0, 0.0)).tolist())
    )
    for _ in range(300):
        simulation.tick()
    assert simulation.plant.position_com()[0] > start[0] + 0.002
    del simulation.pulls["me"]
    for _ in range(2500):
        result = simulation.tick()
    assert simulation.fallen is None
    assert result.terms.position_com_in_world[0] == pytest.approx(start[0], abs=0.002)


def test_its_force_is_capped_and_damped():
    pull = Pull(link="trunk", point=(0.0, 0.0, 0.0), target=(3.0, 0.0, 0.0))
    np.testing.assert_allclose(pull.force(np.zeros(3), np.zeros(3)), (LARGEST_N, 0.0, 0.0), rtol=1e-12)
    weaker = Pull(link="trunk", point=(0.0, 0.0, 0.0), target=(3.0, 0.0, 0.0), strength=0.3)
    np.testing.assert_allclose(weaker.force(np.zeros(3), np.zeros(3)), (0.3 * LARGEST_N, 0.0, 0.0), rtol=1e-12)
    still = Pull(link="trunk", point=(0.0, 0.0, 0.0), target=(0.0, 0.0, 0.0))
    assert still.force(np.zeros(3), np.array((0.0, 1.0, 0.0)))[1] < 0.0


@pytest.mark.parametrize("wrong", [(0.0, float("nan"), 0.0), (0.0, 99.0, 0.0), (0.0, 0.0)])
def test_a_hand_that_is_nowhere_is_refused(wrong):
    with pytest.raises(InvalidInput, match=r"pull.target.*valid"):
        Pull(link="trunk", point=(0.0, 0.0, 0.0), target=wrong)
