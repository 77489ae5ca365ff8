"""What the IMU sees of feet and base: against the robot's own kinematics, and its rates against differences."""

import numpy as np
import pytest

from surefoot.dynamics.imu_kinematics import ImuKinematics
from surefoot.errors import InvalidInput
from surefoot.estimation.base_state import ImuPose, imu_pose, robot_state
from surefoot.geometry.rotations import rotation_from_rpy, rotation_vector
from surefoot.robot.sensing import ImuMount

H = 1e-6


@pytest.fixture(params=["pelvis", "trunk", "l_shank"])
def on_link(request):
    return ImuMount(request.param, np.array((0.05, -0.03, 0.1)), rotation_from_rpy(0.4, -0.3, 1.2))


def test_feet_lie_from_the_imu_as_they_do_in_the_world(robot, dynamics, random_state, on_link):
    kinematics = ImuKinematics(robot, on_link)
    for seed in range(3):
        state = random_state(seed)
        terms, view = dynamics.evaluate(state), kinematics.at(state.q[7:], state.v[6:])
        pose = imu_pose(state, view)
        for i, foot in enumerate(terms.feet):
            place = pose.position + pose.rotation @ view.feet_position[i]
            assert np.allclose(place, foot.position_ankle_in_world, rtol=0.0, atol=1e-12)
            turned = pose.rotation @ view.feet_rotation[i]
            assert np.allclose(turned, foot.rotation_foot_to_world, rtol=0.0, atol=1e-12)


def test_rates_are_those_of_differences(robot, random_state, on_link):
    kinematics = ImuKinematics(robot, on_link)
    state = random_state(5)
    q, rates = state.q[7:], state.v[6:]
    view, before, after = (kinematics.at(q + h * rates, rates) for h in (0.0, -H, H))
    motions = view.feet_velocity
    assert np.allclose(kinematics.feet_jacobians(q) @ rates, motions, rtol=0.0, atol=1e-12)
    for i in range(2):
        moved = (after.feet_position[i] - before.feet_position[i]) / (2.0 * H)
        turned = rotation_vector(after.feet_rotation[i] @ before.feet_rotation[i].T) / (2.0 * H)
        assert np.allclose(motions[i], np.concatenate((moved, turned)), rtol=1e-6, atol=1e-7)
    moved = (after.base_position - before.base_position) / (2.0 * H)
    turned = rotation_vector(after.base_rotation @ before.base_rotation.T) / (2.0 * H)
    assert np.allclose(view.base_velocity, np.concatenate((moved, turned)), rtol=1e-6, atol=1e-7)


def test_state_and_pose_of_the_imu_are_each_others_inverse(robot, random_state, on_link):
    state = random_state(7)
    view = ImuKinematics(robot, on_link).at(state.q[7:], state.v[6:])
    pose: ImuPose = imu_pose(state, view)
    omega = view.base_rotation @ state.v[3:6] - view.base_velocity[3:]
    back = robot_state(pose, omega, view, (state.q[7:], state.v[6:]), 0.0)
    assert np.allclose(back.v, state.v, rtol=0.0, atol=1e-12)
    sign = np.sign(back.q[6] * state.q[6])
    assert np.allclose(sign * back.q[3:7], state.q[3:7], rtol=0.0, atol=1e-12)
    assert np.allclose(back.q[:3], state.q[:3], rtol=0.0, atol=1e-12)


def test_a_link_that_is_not_there_is_refused_with_those_that_are(robot):
    with pytest.raises(InvalidInput, match="pelvis"):
        ImuKinematics(robot, ImuMount("head", np.zeros(3), np.eye(3)))
