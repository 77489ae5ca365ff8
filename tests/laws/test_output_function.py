"""Law of (2): H = dkappa/dq and h = H' v, against differences on the manifold; where kappa is a diffeomorphism."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from surefoot.dynamics.terms import COM, FOOT_ROWS, PELVIS, UPPER
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support

SEEDS = range(8)
STEP = 1e-5
# Central differences over 1e-5: truncation of order STEP^2 = 1e-10, rounding of order 1e-16 / STEP = 1e-11, both
# times derivatives of up to some tens.
DIFFERENCE = {"rtol": 0, "atol": 1e-8}


def output_change(after, before) -> np.ndarray:
    """kappa(after) - kappa(before) (21,), orientations as the world rotation vector from before to after."""
    change = np.empty(len(after.output_velocity))
    change[COM] = after.position_com_in_world - before.position_com_in_world
    change[PELVIS] = turn(after.rotation_pelvis_to_world, before.rotation_pelvis_to_world)
    for rows, foot, foot_before in zip(FOOT_ROWS, after.feet, before.feet, strict=True):
        change[rows.start : rows.start + 3] = foot.position_ankle_in_world - foot_before.position_ankle_in_world
        change[rows.start + 3 : rows.stop] = turn(foot.rotation_foot_to_world, foot_before.rotation_foot_to_world)
    change[UPPER] = after.upper_rad - before.upper_rad
    return change


def turn(after: np.ndarray, before: np.ndarray) -> np.ndarray:
    return Rotation.from_matrix(after @ before.T).as_rotvec()


@pytest.mark.parametrize("seed", SEEDS)
def test_output_jacobian_is_the_derivative_of_kappa_on_the_manifold(dynamics, random_state, seed):
    state = random_state(seed)
    H = dynamics.evaluate(state).output_jacobian
    for k in range(21):
        step = STEP * np.eye(21)[k]
        after = dynamics.evaluate(RobotState(dynamics.integrate(state.q, step), state.v))
        before = dynamics.evaluate(RobotState(dynamics.integrate(state.q, -step), state.v))
        assert_allclose(output_change(after, before) / (2 * STEP), H[:, k], **DIFFERENCE)


@pytest.mark.parametrize("seed", SEEDS)
def test_output_drift_is_the_rate_of_the_output_velocity_without_acceleration(dynamics, random_state, seed):
    """h = d(H v)/dt along the path of constant v."""
    state = random_state(seed)
    after = dynamics.evaluate(RobotState(dynamics.integrate(state.q, STEP * state.v), state.v))
    before = dynamics.evaluate(RobotState(dynamics.integrate(state.q, -STEP * state.v), state.v))
    rate = (after.output_velocity - before.output_velocity) / (2 * STEP)
    drift = dynamics.evaluate(state).output_drift
    assert np.abs(drift).max() > 0.1
    assert_allclose(rate, drift, **DIFFERENCE)


@pytest.mark.parametrize("seed", SEEDS)
def test_output_velocity_is_what_com_pelvis_and_feet_do(dynamics, random_state, seed):
    terms = dynamics.evaluate(random_state(seed))
    velocity = terms.output_velocity
    assert_allclose(velocity[COM], terms.centroidal_map[:3] @ terms.state.v / terms.mass_kg, rtol=0, atol=1e-12)
    assert_allclose(velocity[COM], terms.velocity_com_in_world, rtol=0, atol=1e-12)
    assert_allclose(velocity[PELVIS], terms.rotation_pelvis_to_world @ terms.state.v[3:6], rtol=0, atol=1e-12)
    for rows, foot in zip(FOOT_ROWS, terms.feet, strict=True):
        assert_allclose(velocity[rows], foot.velocity, rtol=0, atol=1e-12)
    assert_allclose(velocity[UPPER], terms.state.v[18:], rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(40))
def test_output_function_is_a_diffeomorphism_within_the_joint_ranges(dynamics, random_state, seed):
    """The knees' range starts at 0.11 rad: H has full rank at every posture in range, whatever the pelvis' pose."""
    H = dynamics.evaluate(random_state(seed)).output_jacobian
    assert np.linalg.matrix_rank(H) == 21
    assert np.linalg.cond(H) < 1e4


@pytest.mark.parametrize(("support", "condition"), [("left", 50.0), ("right", 49.0), ("double", 56.0)])
def test_condition_number_of_the_standing_postures_is_about_fifty(standing, support, condition):
    assert np.linalg.cond(standing(Support(support)).output_jacobian) == pytest.approx(condition, rel=0.02)


@pytest.fixture
def determinant(dynamics, robot):
    """q, knee angle and sides -> det H with these knees at that angle."""

    def evaluate(q: np.ndarray, knee: float, *sides: str) -> float:
        bent = q.copy()
        for side in sides:
            bent[robot.joint_named(f"{side}_knee").dof + 1] = knee
        return float(np.linalg.det(dynamics.evaluate(RobotState(bent, np.zeros(21))).output_jacobian))

    return evaluate


def test_output_jacobian_is_singular_with_both_legs_straight(standing, determinant):
    q = standing(Support.DOUBLE).state.q
    assert abs(determinant(q, 0.0, "left", "right")) < 1e-12 * abs(determinant(q, 0.6, "left", "right"))


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("seed", SEEDS)
def test_output_jacobian_turns_singular_where_one_knee_is_nearly_straight(random_state, determinant, side, seed):
    """Nearly: the CoM is in kappa and not the pelvis, and the leg's own mass moves the CoM. But outside the range."""
    q, end_of_range = random_state(seed).q, 0.11
    assert determinant(q, end_of_range, side) * determinant(q, -end_of_range, side) < 0.0
    singular = brentq(lambda knee: determinant(q, knee, side), -end_of_range, end_of_range)
    assert abs(singular) < 0.25 * end_of_range
