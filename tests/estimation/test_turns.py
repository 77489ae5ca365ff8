"""Pinocchio's exponential, logarithm and skew matrix are ours, from no turn at all to nearly half a turn."""

import numpy as np
import pytest

from surefoot.dynamics.turns import skew_of, turn_of, vector_of
from surefoot.geometry.rotations import rotation_from_vector, rotation_vector

AXIS = np.array((2.0, -1.0, 2.0)) / 3.0
ANGLES = (0.0, 1e-12, 1e-7, 1e-6, 1e-3, 0.1, 1.0, 3.0)


@pytest.mark.parametrize("angle", ANGLES)
def test_turns_and_their_vectors(angle):
    rotation = rotation_from_vector(angle * AXIS)
    assert np.allclose(turn_of(angle * AXIS), rotation, rtol=0.0, atol=1e-14)
    assert np.allclose(vector_of(rotation), rotation_vector(rotation), rtol=0.0, atol=1e-13)
    assert np.allclose(vector_of(rotation), angle * AXIS, rtol=0.0, atol=1e-13)


def test_the_skew_matrix_is_the_vector_product():
    assert np.allclose(skew_of(AXIS) @ np.array((0.5, 4.0, -1.0)), np.cross(AXIS, (0.5, 4.0, -1.0)), atol=1e-15)


def test_what_is_no_number_stays_none():
    """A reading that is no number is to be seen in the estimate."""
    assert np.isnan(turn_of(np.full(3, np.nan))).all()
    assert np.isnan(vector_of(np.full((3, 3), np.nan))).all()
