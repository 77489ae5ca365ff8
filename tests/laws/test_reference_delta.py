"""Law of (11)-(13), (16): a reference delta is a torque bias; with the consistent form it displaces the CoM.

The realised delta_P is the commanded one less the reference, and kappa''_x, kappa''_y are what gives way. At rest again
-K_P e + J^-1 (-delta_ref) = 0, where J says how delta_P answers the CoM's acceleration with all else of kappa held.
For a point mass J = m h_G and e_x = -delta_ref_y/(K_P m h_G), e_y = +delta_ref_x/(K_P m h_G).
"""

import numpy as np
import pytest

from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import delta_from_links
from surefoot.robot.feet import Support

BIAS_NM = 10.0
STIFFNESS = 60.0
MASS_KG, COM_HEIGHT_M = 104.81, 0.975
SECONDS = 1.8  # twelve time constants of the error


def displacement(simulation, seconds: float = SECONDS) -> np.ndarray:
    """Mean horizontal CoM error (2,) of the last 50 ms."""
    errors = []
    for _ in range(round(1000 * seconds)):
        tick = simulation.tick()
        assert tick.fall_cause is None
        errors.append((tick.terms.position_com_in_world - tick.reference.position_com)[:2])
    assert np.ptp(errors[-50:], axis=0).max() < 1e-5  # at rest again
    return np.mean(errors[-50:], axis=0)


@pytest.fixture
def predict(robot, standing):
    """Support and bias (frontal, sagittal) -> the displacement (2,), J by the sum over links."""

    def displace(support: str, bias: tuple[float, float], stiffness: float = STIFFNESS) -> np.ndarray:
        terms = standing(Support(support))
        P = terms.position_com_in_world * (1.0, 1.0, 0.0)
        J = np.empty((2, 2))
        for axis in (0, 1):
            acceleration = np.linalg.solve(terms.output_jacobian, np.eye(21)[axis])
            J[:, axis] = delta_from_links(P, evaluate_links(robot, terms.state, acceleration))[:2]
        return -np.linalg.solve(J, bias) / stiffness

    return displace


@pytest.mark.parametrize("support", ["left", "double"])
@pytest.mark.parametrize("bias", [(0.0, BIAS_NM), (BIAS_NM, 0.0), (-BIAS_NM, -BIAS_NM)])
def test_com_is_displaced_as_predicted(simulate, predict, support, bias):
    settings = {"delta_ref_frontal_nm": bias[0], "delta_ref_sagittal_nm": bias[1]}
    found, expected = displacement(simulate(support=support, controller=settings)), predict(support, bias)
    # first order in the bias: the posture changes by 1.4 mm in some 1000, J with it
    assert np.abs(found - expected).max() < 0.01 * np.linalg.norm(expected)


@pytest.mark.parametrize("bias", [(0.0, BIAS_NM), (BIAS_NM, 0.0)], ids=["sagittal", "frontal"])
def test_point_mass_formula_has_the_sign_and_overstates_the_size(predict, bias):
    """It leaves out that legs turn under a trunk kept upright: about an eighth of the whole, on this robot."""
    expected = predict("left", bias)
    point_mass = np.array((-bias[1], bias[0])) / (STIFFNESS * MASS_KG * COM_HEIGHT_M)
    axis = int(np.argmax(np.abs(point_mass)))
    assert expected[axis] / point_mass[axis] == pytest.approx(0.88, abs=0.02)


def test_without_a_bias_nothing_is_displaced(simulate):
    assert np.abs(displacement(simulate(controller={}))).max() < 1e-5


def test_softer_gains_are_displaced_further(simulate, predict):
    settings = {"delta_ref_sagittal_nm": BIAS_NM, "com_stiffness": 30.0, "com_damping": 11.0}
    found = displacement(simulate(controller=settings), seconds=2.2)
    expected = predict("left", (0.0, BIAS_NM), stiffness=30.0)
    assert np.abs(found - expected).max() < 0.01 * np.linalg.norm(expected)
