"""References: the quintic swing from rest to rest, with derivatives that are its own."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.robot.feet import Support
from surefoot.task.posture import standing_reference
from surefoot.task.reference import Hold, Swing, quintic

STEP = 1e-5
# Central differences over 1e-5: truncation STEP^2/6 times a third derivative of 60, rounding 1e-16/1e-5.
DIFFERENCE = {"rtol": 0, "atol": 1e-8}


@pytest.fixture
def swing(robot) -> Swing:
    posture = standing_reference(robot, Support.LEFT)
    return Swing(posture, axis=1, amplitude_m=-0.035, duration_s=0.45, start_s=0.2)


@pytest.mark.parametrize("phase", [0.01, 0.2, 0.5, 0.77, 0.99])
def test_quintic_derivatives_are_its_derivatives(phase):
    after, before = quintic(phase + STEP), quintic(phase - STEP)
    _, first, second = quintic(phase)
    assert (after[0] - before[0]) / (2 * STEP) == pytest.approx(first, abs=1e-8)
    assert (after[1] - before[1]) / (2 * STEP) == pytest.approx(second, abs=1e-7)


def test_quintic_goes_from_rest_to_rest_without_a_jump_of_acceleration():
    tiny = 1e-9
    for phase, value in ((0.0, 0.0), (1.0, 1.0)):
        assert quintic(phase) == (value, 0.0, 0.0)
        inner = quintic(phase + (tiny if phase == 0.0 else -tiny))
        assert_allclose(inner, (value, 0.0, 0.0), rtol=0, atol=1e-7)
    assert quintic(0.5)[0] == pytest.approx(0.5)
    assert quintic(-3.0) == (0.0, 0.0, 0.0)
    assert quintic(7.0) == (1.0, 0.0, 0.0)


def test_swing_derivatives_are_those_of_its_position(swing):
    for t in (0.21, 0.3, 0.425, 0.6):
        after, before, now = swing.at(t + STEP), swing.at(t - STEP), swing.at(t)
        assert_allclose((after.position_com - before.position_com) / (2 * STEP), now.velocity[:3], **DIFFERENCE)
        assert_allclose((after.velocity - before.velocity) / (2 * STEP), now.acceleration, rtol=0, atol=1e-6)
    assert np.abs(swing.at(0.3).acceleration).max() > 0.1


@pytest.mark.parametrize(("t", "displacement"), [(0.0, 0.0), (0.2, 0.0), (0.65, -0.035), (9.0, -0.035)])
def test_swing_rests_before_its_start_and_after_its_end(swing, t, displacement):
    at = swing.at(t)
    moved = at.position_com - swing.posture.position_com
    assert_allclose(moved, [0.0, displacement, 0.0], rtol=0, atol=1e-15)
    assert not at.velocity.any()
    assert not at.acceleration.any()


def test_swing_moves_nothing_but_the_centre_of_mass(swing):
    at = swing.at(0.4)
    assert at.rotation_pelvis_to_world is swing.posture.rotation_pelvis_to_world
    assert at.position_ankles is swing.posture.position_ankles
    assert not at.velocity[[0, *range(2, 21)]].any()
    assert not at.acceleration[[0, *range(2, 21)]].any()


def test_swing_leaves_its_posture_untouched(swing):
    before = swing.posture.position_com.copy()
    swing.at(0.4)
    assert_allclose(swing.posture.position_com, before, rtol=0, atol=0)


def test_hold_stays(swing):
    hold = Hold(swing.posture)
    assert hold.at(0.0) is hold.at(100.0) is swing.posture
