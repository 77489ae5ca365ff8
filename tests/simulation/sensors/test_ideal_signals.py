"""Ideal sensors: by MuJoCo's own, by differences of the state, and by what an estimator makes of them."""

import mujoco
import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.geometry.rotations import rotation_from_vector
from surefoot.robot.description import BASE_DOFS
from surefoot.robot.feet import Support
from surefoot.robot.sensing import ImuMount
from surefoot.simulation.imperfections import Imperfections
from surefoot.simulation.physics import TIMESTEP_S, PhysicsSettings
from surefoot.simulation.plant import Plant
from surefoot.simulation.world import IMU

TILTED = rotation_from_vector(np.array((0.3, -0.2, 0.5)))
AT = np.array((0.05, -0.03, 0.2))
MOUNTS = {
    "base": ImuMount("pelvis", np.zeros(3), np.eye(3)),
    "base, aside and tilted": ImuMount("pelvis", AT, TILTED),
    "trunk, aside and tilted": ImuMount("trunk", AT, TILTED),
}


@pytest.fixture(params=MOUNTS.values(), ids=MOUNTS.keys())
def mount(request) -> ImuMount:
    return request.param


def falling(robot, standing, mount) -> Plant:
    """A robot without torques, in the middle of its fall."""
    plant = Plant(robot, PhysicsSettings(), imperfections=Imperfections(imu=mount))
    plant.reset(standing(Support.DOUBLE).state.q)
    plant.data.qvel[3:6] = (0.4, 0.8, -0.3)
    torques = np.zeros(15)
    torques[12:] = (8.0, -5.0, 6.0)
    for _ in range(150):
        plant.step(torques)
    return plant


def site(plant: Plant) -> tuple[np.ndarray, np.ndarray]:
    """Position and orientation of the IMU now, without touching what the last step left behind."""
    data = mujoco.MjData(plant.model)
    data.qpos[:] = plant.data.qpos
    mujoco.mj_kinematics(plant.model, data)
    return data.site(IMU).xpos.copy(), data.site(IMU).xmat.reshape(3, 3).copy()


def test_at_rest_the_accelerometer_says_that_gravity_is_held(robot, standing, mount):
    plant = Plant(robot, PhysicsSettings(), imperfections=Imperfections(imu=mount))
    plant.reset(standing(Support.DOUBLE).state.q)
    signals, (_, axes) = plant.signals(), site(plant)
    assert_allclose(axes.dot(signals.accelerometer), (0.0, 0.0, robot.gravity), rtol=0, atol=1e-12)
    assert_allclose(signals.gyro, 0.0, rtol=0, atol=1e-15)
    assert sum(signals.feet.normal_forces) == pytest.approx(robot.mass_kg * robot.gravity, rel=1e-3)


def test_the_gyro_says_by_which_turn_the_body_came_to_where_it_is(robot, standing, mount):
    plant = falling(robot, standing, mount)
    (_, before), _ = site(plant), plant.step(np.zeros(15))
    _, after = site(plant)
    gyro = plant.signals().gyro
    assert np.linalg.norm(gyro) > 0.3
    turned = before.dot(rotation_from_vector(TIMESTEP_S * gyro))
    exact = mount.body == robot.base
    assert_allclose(turned, after, rtol=0, atol=1e-12 if exact else 3e-6)


def test_the_accelerometer_says_by_how_much_the_velocity_of_its_place_changed(robot, standing, mount):
    plant = falling(robot, standing, mount)
    places, axes = [], []
    for _ in range(4):
        place, turned = site(plant)
        places.append(place)
        axes.append(turned)
        plant.step(np.zeros(15))
    said = plant.signals().accelerometer  # of the last step, in the axes at its beginning
    velocity = np.diff([*places, site(plant)[0]], axis=0) / TIMESTEP_S
    acceleration = (velocity[-1] - velocity[-2]) / TIMESTEP_S
    assert np.linalg.norm(acceleration) > 1.0
    # places lie on an arc: its bend within a step is of the order of |omega|^2 |arm| T |omega|
    assert_allclose(axes[-1].dot(said) - (0.0, 0.0, robot.gravity), acceleration, rtol=0, atol=0.05)


def test_joints_and_feet_are_those_of_the_truth(robot, standing, mount):
    plant = falling(robot, standing, mount)
    signals, (state, sensing) = plant.signals(), plant.sense()
    assert signals.joint_positions.tobytes() == state.q[BASE_DOFS + 1 :].tobytes()
    assert signals.joint_velocities.tobytes() == state.v[BASE_DOFS:].tobytes()
    assert signals.feet.wrenches.tobytes() == sensing.wrenches.tobytes()


def test_perfect_sensors_and_plain_integration_know_the_state(simulate):
    simulation = simulate(
        estimator={"kind": "strapdown"},
        pushes=[{"link": "trunk", "impulse_ns": 4.0, "start_s": 0.1, "duration_s": 0.1, "direction_deg": 60.0}],
    )
    beliefs = [simulation.tick().belief for _ in range(600)]
    assert max(np.abs(belief.position_error).max() for belief in beliefs) < 1e-6
    assert max(np.abs(belief.orientation_error).max() for belief in beliefs) < 1e-9
    assert max(np.abs(belief.dcm_error).max() for belief in beliefs) < 1e-6


def test_an_imu_changes_no_digit_of_a_run(robot, standing):
    plants = [
        Plant(robot, PhysicsSettings(), imperfections=Imperfections(imu=mount)) for mount in (None, MOUNTS["base"])
    ]
    for plant in plants:
        plant.reset(standing(Support.DOUBLE).state.q)
    for _ in range(400):
        for plant in plants:
            plant.step(np.full(15, 2.0))
            plant.feet()
        plants[1].signals()
    assert plants[0].data.qpos.tobytes() == plants[1].data.qpos.tobytes()
    assert plants[0].data.qvel.tobytes() == plants[1].data.qvel.tobytes()
