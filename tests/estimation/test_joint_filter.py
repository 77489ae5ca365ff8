"""Angles and velocities of the joints with less noise than their sensors have."""

import numpy as np
import pytest

from surefoot.estimation.joint_filter import FINEST_VELOCITY_RAD_S, JointFilter

STEP_S = 1e-3


def test_without_noise_nothing_is_changed(sheet):
    joints = JointFilter(sheet())
    for k in range(5):
        angles, rates = np.array((0.1 * k, -0.2)), np.array((3.0, 0.1 * k))
        found = joints.update(angles, rates, STEP_S)
        assert np.array_equal(found[0], angles)
        assert np.array_equal(found[1], rates)


def test_white_noise_comes_down_to_what_the_best_filter_leaves(sheet):
    """Of r = sigma_q^2 T and q = sigma_v^2 T the Kalman filter leaves the variance sqrt(q r)."""
    rng, sigma_q, sigma_v = np.random.default_rng(4), 1e-3, 0.02
    joints = JointFilter(sheet(joint_position=sigma_q, joint_velocity=sigma_v))
    joints.start(np.zeros(15), np.zeros(15))
    left = []
    for k in range(4000):
        found, _ = joints.update(sigma_q * rng.normal(size=15), sigma_v * rng.normal(size=15), STEP_S)
        if k > 500:
            left.append(found)
    assert np.std(left) == pytest.approx(np.sqrt(sigma_q * sigma_v * STEP_S), rel=0.1)


def test_angles_do_not_lag_a_motion_and_velocities_lag_by_the_time_that_is_told(sheet):
    joints = JointFilter(sheet(joint_position=1e-3, joint_velocity=0.02))
    for k in range(1000):
        t = k * STEP_S
        angle, rate = np.array((0.5 * 2.0 * t * t,)), np.array((2.0 * t,))
        found, smooth = joints.update(angle, rate, STEP_S)
    assert found[0] == pytest.approx(angle[0], abs=1e-6)
    assert (rate[0] - smooth[0]) / 2.0 == pytest.approx(0.004, abs=2e-4)


def test_encoders_are_followed_however_good_the_velocities_are(sheet):
    """Angles that were told wrong come right.

    Of the encoders' noise half the variance is left that the floor counts on: velocities, whose half it would be too,
    have none.
    """
    rng, sigma_q = np.random.default_rng(5), 1e-3
    joints = JointFilter(sheet(joint_position=sigma_q))
    joints.start(np.full(15, 5e-3), np.zeros(15))
    left = []
    for k in range(8000):
        found, rates = joints.update(sigma_q * rng.normal(size=15), np.zeros(15), STEP_S)
        if k > 4000:
            left.append(found)
    assert not rates.any()
    expected = np.sqrt(0.5 * sigma_q * FINEST_VELOCITY_RAD_S * STEP_S)
    assert np.sqrt(np.mean(np.square(left))) == pytest.approx(expected, rel=0.25)
