"""Left and right are mirrored: the right ankle of the mirrored robot does what the left one did."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

from surefoot.control.balance.ankle_law import torques_point_at_ankle, torques_point_on_ground
from surefoot.control.balance.contact_wrench import required_wrench, share_between_feet
from surefoot.dynamics.model import DynamicsModel
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support

EXACT = {"rtol": 0, "atol": 1e-9}  # N m
FLIP = np.diag((1.0, -1.0, 1.0))  # the mirror: the plane y = 0
# Right joints are positive the same way as left ones; of the trunk's, yaw and frontal change sign.
LEFT, RIGHT, TRUNK = slice(6, 12), slice(12, 18), slice(18, 21)
TRUNK_SIGNS = np.array((-1.0, -1.0, 1.0))


@pytest.fixture(scope="module")
def mirrored_robot(robot):
    """Bip with its trunk, the one part that is not symmetric, mirrored."""
    model = robot.pinocchio_model.copy()
    for name in ("trunk", "trunk_cross", "lumbar_lever", "pelvis"):
        joint = model.frames[model.getFrameId(name)].parentJoint
        inertia = model.inertias[joint]
        model.inertias[joint] = pin.Inertia(inertia.mass, FLIP @ inertia.lever, FLIP @ inertia.inertia @ FLIP)
    return replace(robot, pinocchio_model=model)


def mirrored_velocity(v: np.ndarray) -> np.ndarray:
    """A velocity or acceleration (21,) of the mirrored motion."""
    out = v.copy()
    out[:3], out[3:6] = FLIP @ v[:3], -FLIP @ v[3:6]  # an angular velocity is a pseudo-vector
    out[LEFT], out[RIGHT], out[TRUNK] = v[RIGHT], v[LEFT], TRUNK_SIGNS * v[TRUNK]
    return out


def mirrored_state(state: RobotState) -> RobotState:
    q = state.q.copy()
    q[:3] = FLIP @ state.q[:3]
    rotation = pin.Quaternion(state.q[3:7]).toRotationMatrix()
    q[3:7] = pin.Quaternion(FLIP @ rotation @ FLIP).coeffs()
    joints = mirrored_velocity(np.r_[np.zeros(6), state.q[7:]])[6:]
    q[7:] = joints
    return RobotState(q, mirrored_velocity(state.v))


@pytest.fixture(params=range(20))
def mirrored_pair(request, robot, dynamics, mirrored_robot, random_state, on_its_feet):
    """(robot, terms, q'', share of the stance foot) of a left stance, and of its mirror image."""
    state = random_state(request.param)
    acceleration = np.random.default_rng(9000 + request.param).normal(scale=3.0, size=21)
    pair = []
    for it, model, support, s, a in (
        (robot, dynamics, Support.LEFT, state, acceleration),
        (mirrored_robot, DynamicsModel(mirrored_robot), Support.RIGHT, mirrored_state(state),
         mirrored_velocity(acceleration)),
    ):  # fmt: skip
        terms = model.evaluate(s)
        geometry, _ = on_its_feet(terms, support)
        wrench = required_wrench(terms, momentum_rate(terms, a), geometry)
        (share,) = share_between_feet(wrench, terms, geometry)
        pair.append((it, terms, a, share))
    return pair


def test_the_mirror_image_has_mirrored_feet_and_centre_of_mass(mirrored_pair):
    (_, left, _, _), (_, right, _, _) = mirrored_pair
    assert_allclose(right.position_com_in_world, FLIP @ left.position_com_in_world, **EXACT)
    for one, other in ((0, 1), (1, 0)):
        assert_allclose(
            right.feet[other].position_ankle_in_world, FLIP @ left.feet[one].position_ankle_in_world, **EXACT
        )


def test_ankle_torques_are_mirrored(mirrored_pair):
    (robot, left, a, share), (_, right, b, mirrored_share) = mirrored_pair
    here = torques_point_at_ankle(robot.feet[0], left, share, a)
    there = torques_point_at_ankle(robot.feet[1], right, mirrored_share, b)
    assert np.abs(here).max() > 1.0
    assert_allclose(there, here, **EXACT)


@pytest.mark.parametrize("tangential_term", [True, False])
def test_ankle_torques_with_the_point_on_the_ground_are_mirrored(mirrored_pair, tangential_term):
    (robot, left, _, share), (_, right, _, mirrored_share) = mirrored_pair
    here = torques_point_on_ground(robot.feet[0], left, share, tangential_term=tangential_term)
    there = torques_point_on_ground(robot.feet[1], right, mirrored_share, tangential_term=tangential_term)
    assert np.abs(here).max() > 1.0
    assert_allclose(there, here, **EXACT)
