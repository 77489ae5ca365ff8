"""Law of (18)-(25), algebra: what the tracking law commands is what q'' brings about, and the error obeys it."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.settings import ControllerSettings
from surefoot.control.task_acceleration import GainTable, acceleration_response, commanded_output_acceleration
from surefoot.dynamics.terms import COM, LEFT_FOOT, PELVIS, RIGHT_FOOT, UPPER
from surefoot.geometry.rotations import rotation_from_vector
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.task.posture import standing_reference
from surefoot.task.reference import task_error, tracking_acceleration

SEEDS = range(10)
STEP = 1e-5
DIFFERENCE = {"rtol": 0, "atol": 1e-8}  # central differences over 1e-5: truncation 1e-10, rounding 1e-11, times tens
ORIENTATIONS = np.r_[PELVIS, 9:12, 15:18]
PLACES = np.setdiff1d(np.arange(21), ORIENTATIONS)


@pytest.fixture(params=SEEDS)
def off_reference(request, robot, dynamics, standing):
    """Terms some centimetres and hundredths of a rad away from a moving reference, and that reference."""
    rng = np.random.default_rng(5000 + request.param)
    at_rest = standing(Support.LEFT)
    q = dynamics.integrate(at_rest.state.q, 0.03 * rng.normal(size=21))
    terms = dynamics.evaluate(RobotState(q, 0.3 * rng.normal(size=21)))
    reference = standing_reference(robot, Support.LEFT)
    reference = replace(reference, velocity=rng.normal(size=21), acceleration=rng.normal(size=21))
    return terms, reference


def gains(seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.uniform(10.0, 100.0, size=21), rng.uniform(5.0, 20.0, size=21)


def test_error_is_zero_at_the_target(robot, standing):
    for support in Support:
        assert_allclose(task_error(standing(support), standing_reference(robot, support)), 0.0, rtol=0, atol=1e-9)


def test_error_is_actual_minus_wanted(off_reference):
    """(18): how kappa must be moved to get from the reference to the actual one, with its sign."""
    terms, reference = off_reference
    e = task_error(terms, reference)
    assert_allclose(e[COM], terms.position_com_in_world - reference.position_com, rtol=0, atol=1e-15)
    assert_allclose(
        rotation_from_vector(e[PELVIS]) @ reference.rotation_pelvis_to_world,
        terms.rotation_pelvis_to_world, rtol=0, atol=1e-12,
    )  # fmt: skip
    for i, rows in enumerate((LEFT_FOOT, RIGHT_FOOT)):
        foot = terms.feet[i]
        assert_allclose(e[rows][:3], foot.position_ankle_in_world - reference.position_ankles[i], rtol=0, atol=1e-15)
        turned = rotation_from_vector(e[rows][3:]) @ reference.rotation_feet_to_world[i]
        assert_allclose(turned, foot.rotation_foot_to_world, rtol=0, atol=1e-12)
    assert_allclose(e[UPPER], terms.state.q[-3:] - reference.upper_rad, rtol=0, atol=1e-15)


def test_error_rate_is_the_rate_of_the_error(dynamics, off_reference):
    """(19): e' = H v - kappa_d'. For orientations to first order in the error, which is all that decay needs."""
    terms, reference = off_reference
    still = replace(reference, velocity=np.zeros(21))
    q, v = terms.state.q, terms.state.v
    after, before = (
        task_error(dynamics.evaluate(RobotState(dynamics.integrate(q, s * STEP * v), v)), still) for s in (1.0, -1.0)
    )
    by_difference, rate = (after - before) / (2.0 * STEP), terms.output_velocity
    assert_allclose(by_difference[PLACES], rate[PLACES], **DIFFERENCE)
    angles = np.abs(task_error(terms, still)[ORIENTATIONS]).max() * np.sqrt(3.0)
    assert np.abs((by_difference - rate)[ORIENTATIONS]).max() <= angles * np.linalg.norm(rate[ORIENTATIONS])


def test_commanded_acceleration_makes_the_error_a_damped_oscillator(off_reference):
    """(20), (21), (23): with kappa'' as commanded, e'' + K_D e' + K_P e = 0 on every row."""
    terms, reference = off_reference
    K_P, K_D = gains()
    kappa_dd = tracking_acceleration(terms, reference, K_P, K_D)
    e, e_dot = task_error(terms, reference), terms.output_velocity - reference.velocity
    e_ddot = kappa_dd - reference.acceleration
    assert_allclose(e_ddot + K_D * e_dot + K_P * e, 0.0, rtol=0, atol=1e-12)
    assert np.abs(e_ddot).max() > 1.0


def test_acceleration_realises_the_command(off_reference):
    """(22), (24), (25): H q'' + h equals v + kappa_d''."""
    terms, reference = off_reference
    command = tracking_acceleration(terms, reference, *gains())
    acceleration = acceleration_response(terms, command).acceleration
    achieved = terms.output_jacobian @ acceleration + terms.output_drift
    assert_allclose(achieved, command, rtol=0, atol=1e-10)  # rounding times a condition number of 50


def test_response_to_the_centre_of_mass_leaves_everything_else_alone(off_reference):
    terms, reference = off_reference
    response = acceleration_response(terms, reference.acceleration)
    unit = np.zeros((21, 2))
    unit[0, 0] = unit[1, 1] = 1.0
    assert_allclose(terms.output_jacobian @ response.per_com_acceleration, unit, rtol=0, atol=1e-11)
    inverse = response.inverse_output_jacobian()
    assert_allclose(inverse @ terms.output_jacobian, np.eye(21), rtol=0, atol=1e-10)


@pytest.mark.parametrize("support", Support)
def test_stance_feet_are_asked_for_contact_and_all_else_for_tracking(support, robot, dynamics, standing, on_its_feet):
    rng = np.random.default_rng(0)
    q = dynamics.integrate(standing(support).state.q, 0.02 * rng.normal(size=21))
    terms = dynamics.evaluate(RobotState(q, 0.3 * rng.normal(size=21)))
    reference = standing_reference(robot, support)
    settings = ControllerSettings(com_stiffness=50.0, foot_damping=9.0, stance_foot_damping=17.0)
    geometry, _ = on_its_feet(terms, support)
    command = commanded_output_acceleration(terms, reference, GainTable(robot, settings), geometry)
    expected = tracking_acceleration(terms, reference, settings.stiffness(21), settings.damping(21))
    for i in support.stance:
        expected[(LEFT_FOOT, RIGHT_FOOT)[i]] = -17.0 * terms.feet[i].velocity
    assert_allclose(command, expected, rtol=0, atol=1e-12)
