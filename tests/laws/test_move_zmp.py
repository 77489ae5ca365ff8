"""The consistent limit: q'' is changed so that its ZMP is where it may be, by the CoM's acceleration alone."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.balance.contact_wrench import required_wrench
from surefoot.control.balance.zmp_demand import move_zmp
from surefoot.control.task_acceleration import acceleration_response
from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import delta_from_links, momentum_rate
from surefoot.momentum.zmp import zmp_vector
from surefoot.robot.feet import Support


@pytest.fixture(params=[(support, seed) for support in Support for seed in range(8)])
def moved(request, dynamics, random_state, on_its_feet):
    """Terms, geometry, q'' before and after, and the target in the support frame."""
    support, seed = request.param
    rng = np.random.default_rng(12_000 + seed)
    terms = dynamics.evaluate(random_state(seed))
    geometry, _ = on_its_feet(terms, support)
    response = acceleration_response(terms, rng.normal(size=21))
    wrench = required_wrench(terms, momentum_rate(terms, response.acceleration), geometry)
    target = rng.uniform(-0.1, 0.1, size=2)
    return terms, geometry, response, move_zmp(terms, response, wrench, geometry, target), target


def test_zmp_of_the_changed_acceleration_is_the_target(robot, moved):
    """By the long road: delta_P summed over links, (10), support frame."""
    terms, geometry, _, after, target = moved
    P, q_dd = geometry.origin, after.acceleration
    delta = delta_from_links(P, evaluate_links(robot, terms.state, q_dd))
    weight = terms.mass_kg * terms.gravity
    normal = momentum_rate(terms, q_dd).normal_force
    zmp = zmp_vector(terms.position_com_in_world - P, delta, weight, normal)[:2]
    assert_allclose(geometry.axes.T @ zmp, target, rtol=0, atol=1e-9)


def test_only_the_horizontal_acceleration_of_the_centre_of_mass_gives_way(moved):
    terms, _, before, after, _ = moved
    change = terms.output_jacobian @ (after.acceleration - before.acceleration)
    assert np.abs(change[:2]).max() > 0.01
    assert_allclose(change[2:], 0.0, rtol=0, atol=1e-9)  # rounding times a condition number of up to 1e4


def test_a_zmp_that_is_where_it_should_be_changes_nothing(moved):
    terms, geometry, response, _, _ = moved
    wrench = required_wrench(terms, momentum_rate(terms, response.acceleration), geometry)
    same = move_zmp(terms, response, wrench, geometry, wrench.zmp)
    assert_allclose(same.acceleration, response.acceleration, rtol=0, atol=1e-12)
