"""Law of (26), (27): a_G is the mass-weighted mean of the links' accelerations, and what the CoM does."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.description import RobotState
from surefoot.task.reference import com_acceleration

SEEDS = range(10)


@pytest.fixture(params=SEEDS)
def moving(request, dynamics, random_state):
    rng = np.random.default_rng(6000 + request.param)
    return dynamics.evaluate(random_state(request.param)), rng.normal(scale=5.0, size=21)


def test_com_acceleration_is_the_mass_weighted_mean(robot, moving):
    terms, acceleration = moving
    links = evaluate_links(robot, terms.state, acceleration)
    mean = links.mass_kg @ links.acceleration_com / links.mass_kg.sum()
    assert_allclose(com_acceleration(terms, acceleration), mean, rtol=0, atol=1e-10)  # rounding of sums up to 1e3


def test_the_printed_sum_without_masses_is_another_quantity(robot, moving):
    """Off by about the number of links as a sum, and wrong as a mean too: the links weigh 0.18 to 48 kg."""
    terms, acceleration = moving
    links = evaluate_links(robot, terms.state, acceleration)
    a_G = com_acceleration(terms, acceleration)
    assert np.abs(links.acceleration_com.sum(axis=0) - a_G).max() > 1.0
    assert np.abs(links.acceleration_com.mean(axis=0) - a_G).max() > 0.1


def test_the_printed_sum_is_off_by_exactly_the_number_of_links_in_pure_translation(robot, dynamics):
    state = RobotState(dynamics.neutral(np.array((0.0, 0.0, 0.9))), np.zeros(21))
    acceleration = np.r_[1.0, 2.0, 3.0, np.zeros(18)]
    links = evaluate_links(robot, state, acceleration)
    a_G = com_acceleration(dynamics.evaluate(state), acceleration)
    assert_allclose(a_G, [1.0, 2.0, 3.0], rtol=0, atol=1e-12)
    assert_allclose(links.acceleration_com.sum(axis=0), 16 * a_G, rtol=0, atol=1e-10)


def test_com_acceleration_carries_the_linear_momentum_rate(moving):
    terms, acceleration = moving
    rate = momentum_rate(terms, acceleration)
    assert_allclose(rate.linear, terms.mass_kg * com_acceleration(terms, acceleration), rtol=0, atol=1e-9)
    assert rate.normal_force == pytest.approx(terms.mass_kg * (9.81 + com_acceleration(terms, acceleration)[2]))


def test_com_acceleration_is_the_second_difference_of_the_com_on_an_integrated_path(dynamics, moving):
    """On q(t) = q (+) (v t + a t^2/2), whose velocity at 0 is v and whose acceleration there is a."""
    terms, acceleration = moving
    q, v, dt = terms.state.q, terms.state.v, 1e-4

    def com(t: float) -> np.ndarray:
        place = dynamics.integrate(q, v * t + 0.5 * acceleration * t**2)
        return dynamics.evaluate(RobotState(place, v)).position_com_in_world

    second = (com(dt) - 2.0 * com(0.0) + com(-dt)) / dt**2
    # truncation dt^2/12 times a fourth derivative of up to 1e3 m/s4, rounding 1e-16/dt^2 = 1e-8
    assert_allclose(second, com_acceleration(terms, acceleration), rtol=0, atol=1e-5)


def test_com_acceleration_is_the_second_difference_of_the_com_on_a_simulated_path(simulate, measured_tick):
    """MuJoCo moves v by a dt and then the place by the new v: x2 - 2 x1 + x0 = (v2 - v1) dt = a1 dt^2."""
    swing = {"kind": "swing", "axis": "lateral", "amplitude_m": -0.02, "duration_s": 0.3, "start_s": 0.0}
    simulation = simulate(reference=swing)
    places, accelerations = [], []
    for _ in range(250):
        measured = measured_tick(simulation)
        places.append(measured.terms.position_com_in_world)
        accelerations.append(com_acceleration(measured.terms, measured.acceleration))
    second = np.diff(places, n=2, axis=0) / 1e-3**2
    expected = np.array(accelerations)[1:-1]
    assert np.abs(expected).max() > 0.5
    # the Jacobian of the CoM turns within a tick: by less than 1 rad/s x 1 ms = 1e-3 of the acceleration
    assert_allclose(second, expected, rtol=0, atol=1e-3 * np.abs(expected).max())
