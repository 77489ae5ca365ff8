"""Rotations against SciPy's, at random, near no turn and near half a turn."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from surefoot.geometry.rotations import (
    cross,
    heading,
    quaternion_xyzw,
    roll_about_forward_axis,
    rotation_from_rpy,
    rotation_from_vector,
    rotation_from_xyzw,
    rotation_vector,
    skew,
    turn_by,
)  # fmt: skip

ROUNDING = {"rtol": 0, "atol": 1e-14}
ANGLES = {
    "ordinary": (0.3, 1.0, 2.0, 3.0),
    "near no turn": (0.0, 1e-12, 1e-9, 1e-7, 9.99e-7, 1.001e-6, 1e-5),
    "near half a turn": tuple(np.pi - d for d in (1e-2, 1e-4, 1e-5, 1.001e-6, 1e-6, 9.99e-7, 1e-7, 1e-9, 0.0)),
}
CASES = [(angle, seed) for angles in ANGLES.values() for angle in angles for seed in range(4)]


def axis_of(seed: int) -> np.ndarray:
    axis = np.random.default_rng(seed).normal(size=3) if seed else np.array((0.0, 0.0, 1.0))
    return axis / np.linalg.norm(axis)


@pytest.mark.parametrize(("angle", "seed"), CASES)
def test_exponential_is_scipys(angle, seed):
    vector = angle * axis_of(seed)
    # half of K squared stands for (1 - cos a)/a^2 below 1e-6: the next term is a^3/6 = 2e-19
    assert_allclose(rotation_from_vector(vector), Rotation.from_rotvec(vector).as_matrix(), **ROUNDING)


@pytest.mark.parametrize(("angle", "seed"), CASES)
def test_logarithm_is_the_inverse_of_the_exponential(angle, seed):
    vector = angle * axis_of(seed)
    matrix = Rotation.from_rotvec(vector).as_matrix()
    found = rotation_vector(matrix)
    if np.pi - angle > 1e-8:
        # Near half a turn the antisymmetric part is sin(angle): its rounding of 1e-16 costs 1e-16/1e-6 of direction
        assert_allclose(found, vector, rtol=0, atol=1e-9)
    else:  # the axis of half a turn has no sign
        assert min(np.abs(found - vector).max(), np.abs(found + vector).max()) < 1e-7
    assert_allclose(rotation_from_vector(found), matrix, rtol=0, atol=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_logarithm_is_scipys_at_random(seed):
    rotation = Rotation.random(rng=np.random.default_rng(seed))
    assert_allclose(rotation_vector(rotation.as_matrix()), rotation.as_rotvec(), rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_logarithm_of_a_tiny_turn_keeps_its_digits(seed):
    vector = 1e-7 * axis_of(seed)
    assert_allclose(rotation_vector(rotation_from_vector(vector)), vector, rtol=1e-9, atol=1e-22)


@pytest.mark.parametrize("seed", range(10))
def test_roll_pitch_yaw_is_scipys_extrinsic_xyz(seed):
    angles = np.random.default_rng(seed).uniform(-1.5, 1.5, size=3)
    assert_allclose(rotation_from_rpy(*angles), Rotation.from_euler("xyz", angles).as_matrix(), **ROUNDING)


@pytest.mark.parametrize(("roll", "pitch", "yaw"), [(0.3, 0.0, 0.0), (-0.2, 0.0, 1.0), (0.03, 0.2, -2.0)])
def test_roll_lifts_the_left_side_whatever_pitch_and_yaw(roll, pitch, yaw):
    rotation = rotation_from_rpy(roll, pitch, yaw)
    assert roll_about_forward_axis(rotation) == pytest.approx(roll, abs=1e-14)
    left_side = rotation @ np.array((0.0, 1.0, 0.0))
    assert np.sign(left_side[2]) == np.sign(roll)


@pytest.mark.parametrize("yaw", [0.0, 0.4, -1.2, 3.0])
def test_heading_is_the_yaw_and_nothing_else(yaw):
    c, s = np.cos(yaw), np.sin(yaw)
    assert_allclose(heading(rotation_from_rpy(0.2, -0.3, yaw)), [[c, -s], [s, c]], **ROUNDING)


@pytest.mark.parametrize("seed", range(10))
def test_vector_product_is_numpys(seed):
    a, b = np.random.default_rng(seed).normal(size=(2, 3))
    assert_allclose(cross(a, b), np.cross(a, b), **ROUNDING)
    assert_allclose(skew(a) @ b, np.cross(a, b), **ROUNDING)


@pytest.mark.parametrize(("angle", "seed"), CASES)
def test_a_turn_by_way_of_the_quaternion_is_the_same_turn(angle, seed):
    vector = angle * axis_of(seed)
    assert_allclose(turn_by(vector), rotation_from_vector(vector), rtol=0.0, atol=2e-14)


@pytest.mark.parametrize(("angle", "seed"), CASES)
def test_a_rotation_and_its_quaternion_are_each_others_inverse_and_scipys(angle, seed):
    turn = Rotation.from_rotvec(angle * axis_of(seed))
    quaternion = np.array(quaternion_xyzw(turn.as_matrix()))
    assert_allclose(rotation_from_xyzw(quaternion), turn.as_matrix(), rtol=0.0, atol=2e-14)
    scipys = turn.as_quat()
    assert_allclose(np.sign(quaternion @ scipys) * quaternion, scipys, rtol=0.0, atol=2e-14)
