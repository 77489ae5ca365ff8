"""Law of (3), (4), (5): delta_P by the centroidal map, by the sum over links and by difference of L_P; free flight."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import angular_momentum_about, delta_about, delta_from_links, momentum_rate
from surefoot.robot.description import RobotState

SEEDS = range(20)
ROUNDING = {"rtol": 0, "atol": 1e-9}  # sums over 16 links of terms up to 1e3 N m
STEP = 1e-4
# Fourth-order differences over 1e-4: truncation of order STEP^4 times the fifth derivative of L (up to 1e5), rounding
# of order 1e-16 * 1e2 / STEP = 1e-10.
DIFFERENCE = {"rtol": 1e-7, "atol": 1e-6}


@pytest.fixture(params=SEEDS)
def moving(request, dynamics, random_state):
    """Terms at a random state, a random q'' and a random place P."""
    rng = np.random.default_rng(1000 + request.param)
    terms = dynamics.evaluate(random_state(request.param))
    return terms, rng.normal(scale=5.0, size=21), rng.normal(size=3)


def rate_of(function, times=(2.0, 1.0, -1.0, -2.0), weights=(-1.0, 8.0, -8.0, 1.0)) -> np.ndarray:
    """d/dt of a function of time at 0, by fourth-order central differences."""
    return sum(w * function(t * STEP) for t, w in zip(times, weights, strict=True)) / (12.0 * STEP)


def path_of(dynamics, terms, acceleration):
    """Time -> terms on the path that leaves the state with its velocity and that acceleration.

    Its velocity is v + a t up to t^3 and its place is exact to t^2, which is all that a derivative at 0 sees.
    """
    q, v = terms.state.q, terms.state.v

    def at(t: float):
        place = dynamics.integrate(q, v * t + 0.5 * acceleration * t**2)
        return dynamics.evaluate(RobotState(place, v + acceleration * t))

    return at


def test_centroidal_road_equals_sum_over_links(robot, moving):
    terms, acceleration, P = moving
    by_map = delta_about(P, terms.position_com_in_world, momentum_rate(terms, acceleration))
    by_links = delta_from_links(P, evaluate_links(robot, terms.state, acceleration))
    assert np.abs(by_map).max() > 10.0
    assert_allclose(by_map, by_links, **ROUNDING)


def test_delta_is_the_rate_of_the_angular_momentum_about_a_fixed_point(dynamics, moving):
    terms, acceleration, P = moving
    at = path_of(dynamics, terms, acceleration)
    delta = delta_about(P, terms.position_com_in_world, momentum_rate(terms, acceleration))
    assert_allclose(rate_of(lambda t: angular_momentum_about(P, at(t))), delta, **DIFFERENCE)


def test_angular_momentum_is_the_sum_over_links(robot, moving):
    """(4) itself: I_i w_i in world plus PG_i x m_i v_i."""
    terms, acceleration, P = moving
    links = evaluate_links(robot, terms.state, acceleration)
    L = np.zeros(3)
    for i in range(len(links.names)):
        L += links.rotation_link_to_world[i] @ links.inertia_at_com[i] @ links.omega[i]
        L += np.cross(links.position_com[i] - P, links.mass_kg[i] * links.velocity_com[i])
    assert_allclose(angular_momentum_about(P, terms), L, **ROUNDING)


def test_for_a_moving_point_the_difference_lacks_what_accelerates_it(dynamics, moving):
    """Never difference (4) in time while P moves.

    With velocities taken relative to a P that moves by p t + a_P t^2 / 2, d/dt of (4) is (5) minus PG x m a_P.
    """
    terms, acceleration, P = moving
    rng = np.random.default_rng(7)
    velocity_P, acceleration_P = rng.normal(size=3), rng.normal(size=3)
    at, m = path_of(dynamics, terms, acceleration), terms.mass_kg

    def relative_momentum(t: float) -> np.ndarray:
        place, now = P + velocity_P * t + 0.5 * acceleration_P * t**2, at(t)
        lever = now.position_com_in_world - place
        return angular_momentum_about(place, now) - np.cross(lever, m * (velocity_P + acceleration_P * t))

    delta = delta_about(P, terms.position_com_in_world, momentum_rate(terms, acceleration))
    lacking = np.cross(terms.position_com_in_world - P, m * acceleration_P)
    assert np.abs(lacking).max() > 1.0
    assert_allclose(rate_of(relative_momentum), delta - lacking, **DIFFERENCE)


def test_in_free_flight_nothing_turns_about_the_centre_of_mass(moving):
    """Whatever the motors do: forward dynamics with random joint torques and no contact."""
    terms, torques, _ = moving
    generalized = np.r_[np.zeros(6), 100.0 * torques[6:]]
    acceleration = np.linalg.solve(terms.mass_matrix, generalized - terms.bias)
    rate = momentum_rate(terms, acceleration)
    G = terms.position_com_in_world
    assert_allclose(delta_about(G, G, rate), 0.0, rtol=0, atol=1e-8)  # accelerations of 1e3 rad/s2 cancel to it
    assert_allclose(rate.linear, [0.0, 0.0, -terms.mass_kg * terms.gravity], rtol=0, atol=1e-8)
    assert rate.normal_force == pytest.approx(0.0, abs=1e-8)


def test_measured_delta_is_the_rate_of_the_simulated_angular_momentum(simulate, measured_tick):
    """On a simulated path: the moment of ground and gravity about a fixed P moves L_P from tick to tick."""
    swing = {"kind": "swing", "axis": "lateral", "amplitude_m": -0.02, "duration_s": 0.3, "start_s": 0.0}
    simulation = simulate(reference=swing)
    P = np.array((0.0, 0.11, 0.0))
    for _ in range(100):
        measured = measured_tick(simulation)
    momentum, measured_delta, commanded_delta = [], [], []
    for _ in range(50):
        measured = measured_tick(simulation)
        terms = measured.terms
        momentum.append(angular_momentum_about(P, terms))
        weight = np.array((0.0, 0.0, -terms.mass_kg * terms.gravity))
        measured_delta.append(measured.contact_moment_about(P) + np.cross(terms.position_com_in_world - P, weight))
        rate = momentum_rate(terms, measured.acceleration)
        commanded_delta.append(delta_about(P, terms.position_com_in_world, rate))
    measured_delta = np.array(measured_delta)
    assert_allclose(commanded_delta, measured_delta, **ROUNDING)
    # MuJoCo's v moves by exactly a dt, so that L gains delta dt up to second order in the tick of 1 ms
    gained = np.diff(momentum, axis=0) / 1e-3
    assert np.abs(measured_delta).max() > 10.0
    assert_allclose(gained, measured_delta[:-1], rtol=0, atol=1e-2 * np.abs(measured_delta).max())


def test_delta_on_record_is_the_measured_one(simulate, measured_tick):
    """What the recorder calls measured, from foot forces, is what MuJoCo's accelerations give about the same point."""
    push = {"link": "trunk", "direction_deg": 40.0, "impulse_ns": 8.0, "start_s": 0.0, "duration_s": 0.05}
    simulation = simulate(support="double", pushes=[push])
    for _ in range(80):
        measured = measured_tick(simulation)
    terms, origin = measured.terms, measured.tick.balance.origin
    expected = delta_about(origin, terms.position_com_in_world, momentum_rate(terms, measured.acceleration))
    recorded = [simulation.recorder.column(f"delta_measured_{axis}_nm")[-1] for axis in "xyz"]
    assert np.abs(expected).max() > 10.0
    assert_allclose(recorded, expected, **ROUNDING)
