"""Law of (1): M q'' + N q' + G = T u + C^T lambda, with MuJoCo's accelerations and contact forces."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

# Sums of some twenty terms of 1e3 N m: rounding is 1e-12. The plant's contact solver runs until rounding stops it.
ROUNDING = {"rtol": 0, "atol": 1e-9}

SWING = {"kind": "swing", "axis": "lateral", "amplitude_m": -0.02, "duration_s": 0.3, "start_s": 0.0}


def sides_of_the_equation(measured, feet) -> tuple[np.ndarray, np.ndarray]:
    """M q'' + bias, and T u + C^T lambda with the contact forces taken as a wrench at each ankle."""
    terms = measured.terms
    demand = terms.mass_matrix @ measured.acceleration + terms.bias
    supply = np.r_[np.zeros(6), measured.tick.applied]
    for foot, truth in zip(terms.feet, feet, strict=True):
        supply += foot.jacobian.T @ np.r_[truth.force, truth.moment]
    return demand, supply


@pytest.mark.parametrize("support", ["left", "right", "double"])
@pytest.mark.parametrize("reference", [{"kind": "hold"}, SWING], ids=["standing", "swinging"])
def test_equation_of_motion_balances_on_a_simulated_robot(simulate, measured_tick, support, reference):
    simulation = simulate(support=support, reference=reference)
    for tick in range(301):
        measured = measured_tick(simulation)
        if tick % 25 == 0:
            demand, supply = sides_of_the_equation(measured, simulation.plant.feet())
            assert supply[2] > 0.5 * 104.81 * 9.81  # the ground carries the robot: the law is not vacuous
            assert_allclose(demand, supply, **ROUNDING)


@pytest.mark.parametrize("seed", range(4))
def test_equation_of_motion_balances_at_speed(simulate, measured_tick, seed):
    """Random velocities of all parts: Coriolis and centrifugal terms, and feet that slip, count too."""
    simulation = simulate(support="double")
    simulation.plant.data.qvel[:] = np.random.default_rng(seed).normal(scale=0.5, size=21)
    for _ in range(20):
        measured = measured_tick(simulation)
        demand, supply = sides_of_the_equation(measured, simulation.plant.feet())
        assert_allclose(demand, supply, **ROUNDING)


def test_contact_wrenches_are_the_sum_of_the_single_contacts(simulate, measured_tick):
    simulation = simulate(support="left")
    for _ in range(50):
        measured = measured_tick(simulation)
    stance, swing = simulation.plant.feet()
    assert_allclose(stance.force, measured.contact_forces.sum(axis=0), **ROUNDING)
    assert_allclose(stance.moment, measured.contact_moment_about(stance.position_ankle), **ROUNDING)
    assert_allclose(swing.force, 0.0, **ROUNDING)
