"""Law of (8)-(16): the ZMP's vector, deviation and component forms are one and the same, and its signs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import contact_moment_about, delta_about, momentum_rate
from surefoot.momentum.zmp import UP, centre_of_pressure, moment_about, moment_about_zmp, zmp_components, zmp_vector

MACHINE = {"rtol": 0, "atol": 1e-12}  # the same products in another order; lengths are of order 1 m
NO_DELTA = np.zeros(3)


@pytest.fixture(params=range(12))
def demand(request, dynamics, random_state):
    """PG, delta_P, m g, F_N and m a_G of a random motion about a random P."""
    rng = np.random.default_rng(3000 + request.param)
    terms = dynamics.evaluate(random_state(request.param))
    rate = momentum_rate(terms, rng.normal(scale=2.0, size=21))
    P = terms.position_com_in_world - np.r_[rng.normal(scale=0.1, size=2), 0.975]
    delta = delta_about(P, terms.position_com_in_world, rate)
    return terms.position_com_in_world - P, delta, terms.mass_kg * terms.gravity, rate


def test_moment_about_point_is_that_of_inertia_and_gravity_on_every_link(robot, dynamics, random_state):
    """(8), link by link."""
    state, acceleration, P = random_state(0), np.random.default_rng(0).normal(size=21), np.array((0.1, -0.2, 0.3))
    terms, links = dynamics.evaluate(state), evaluate_links(robot, state, acceleration)
    M_P = np.zeros(3)
    for i, mass in enumerate(links.mass_kg):
        R, inertia, w = links.rotation_link_to_world[i], links.inertia_at_com[i], links.omega[i]
        M_P -= R @ (inertia @ links.omega_dot[i] + np.cross(w, inertia @ w))
        M_P += np.cross(links.position_com[i] - P, mass * (np.array((0.0, 0.0, -9.81)) - links.acceleration_com[i]))
    PG = terms.position_com_in_world - P
    delta = delta_about(P, terms.position_com_in_world, momentum_rate(terms, acceleration))
    assert_allclose(moment_about(PG, delta, terms.mass_kg * terms.gravity), M_P, rtol=0, atol=1e-9)


def test_horizontal_moment_about_the_zmp_vanishes_and_the_vertical_one_need_not(demand):
    PG, delta, weight, rate = demand
    PC = zmp_vector(PG, delta, weight, rate.normal_force)
    M_C = moment_about_zmp(PG, PC, delta, weight, rate.linear)
    assert_allclose(M_C[:2], 0.0, rtol=0, atol=1e-9)  # of terms up to 1e3 N m
    assert abs(M_C[2]) > 0.1
    assert np.abs(moment_about_zmp(PG, PC + [0.01, 0.0, 0.0], delta, weight, rate.linear)[:2]).max() > 1.0


def test_zmp_lies_at_the_height_of_its_point(demand):
    PG, delta, weight, rate = demand
    assert zmp_vector(PG, delta, weight, rate.normal_force)[2] == 0.0


def test_zmp_is_where_the_ground_wrench_would_have_its_centre_of_pressure(demand):
    PG, delta, weight, rate = demand
    force = rate.linear + weight * UP
    moment = contact_moment_about(np.zeros(3), PG, rate, weight)
    cop = centre_of_pressure(force, moment)
    assert_allclose(zmp_vector(PG, delta, weight, rate.normal_force)[:2], cop, **MACHINE)
    # and a single force there, with a vertical couple, is that wrench
    couple = moment - np.cross(np.r_[cop, 0.0], force)
    assert_allclose(couple[:2], 0.0, rtol=0, atol=1e-9)


def test_components_equal_the_vector_form(demand):
    PG, delta, weight, rate = demand
    vector = zmp_vector(PG, delta, weight, rate.normal_force)[:2]
    assert_allclose(zmp_components(PG, delta, np.zeros(2), weight, rate.normal_force), vector, **MACHINE)


def test_deviation_form_equals_the_difference_of_two_zmps(demand):
    """(11)-(13), (16): with one normal force, deviations of PG and delta_P give the deviation of C."""
    PG, delta, weight, rate = demand
    PG_ref, delta_ref = np.array((0.01, -0.02, PG[2])), np.array((3.0, -4.0, 5.0))
    F_N = rate.normal_force
    deviation = zmp_vector(PG - PG_ref, delta - delta_ref, weight, F_N)
    difference = zmp_vector(PG, delta, weight, F_N) - zmp_vector(PG_ref, delta_ref, weight, F_N)
    assert_allclose(deviation, difference, **MACHINE)


def test_reference_delta_enters_the_components_as_a_deviation(demand):
    """(13)-(15) with PG_ref vertical: delta_ref in place of nothing is delta - delta_ref in place of delta."""
    PG, delta, weight, rate = demand
    delta_ref = np.array((3.0, -4.0))
    by_vector = zmp_vector(PG, delta - np.r_[delta_ref, 0.0], weight, rate.normal_force)[:2]
    assert_allclose(zmp_components(PG, delta, delta_ref, weight, rate.normal_force), by_vector, **MACHINE)


@pytest.mark.parametrize(("forward", "left"), [(0.03, 0.0), (-0.02, 0.0), (0.0, 0.04), (0.0, -0.01), (0.02, -0.03)])
def test_at_rest_the_zmp_is_below_the_centre_of_mass(forward, left):
    PG, weight = np.array((forward, left, 0.975)), 1028.0
    at_rest = np.zeros(3)  # nothing accelerates: delta_P is zero about every point
    assert_allclose(zmp_vector(PG, at_rest, weight, weight), [forward, left, 0.0], **MACHINE)
    assert_allclose(zmp_components(PG, at_rest, np.zeros(2), weight, weight), [forward, left], **MACHINE)


def test_accelerating_the_centre_of_mass_moves_the_zmp_the_other_way():
    """The cart on a table: C = G - h a / g. delta_P of a point mass is PG x m a."""
    m, g, h = 100.0, 10.0, 1.0
    PG = np.array((0.0, 0.0, h))
    forward, left = (np.cross(PG, m * np.array(a)) for a in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    assert_allclose(zmp_vector(PG, forward, m * g, m * g), [-0.1, 0.0, 0.0], **MACHINE)
    assert_allclose(zmp_vector(PG, left, m * g, m * g), [0.0, -0.1, 0.0], **MACHINE)


def test_reference_delta_moves_the_zmp_forward_and_to_the_right():
    """zeta_x grows with delta_ref_y, zeta_y falls with delta_ref_x."""
    zeta = zmp_components(np.zeros(3), NO_DELTA, np.array((10.0, 20.0)), 1000.0, 1000.0)
    assert_allclose(zeta, [0.02, -0.01], **MACHINE)


def test_a_wrench_without_normal_force_has_no_centre_of_pressure():
    assert np.isnan(centre_of_pressure(np.array((3.0, 0.0, 0.0)), np.array((1.0, 2.0, 0.0)))).all()
