"""Law of (8)-(10): the ZMP from delta_P is the centre of pressure of MuJoCo's contact forces on flat ground."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.momentum.delta import delta_about, momentum_rate
from surefoot.momentum.zmp import moment_about_zmp, zmp_vector

SLOW = {"kind": "swing", "axis": "lateral", "amplitude_m": -0.03, "duration_s": 1.5, "start_s": 0.0}
FORWARD = {**SLOW, "axis": "sagittal", "amplitude_m": 0.04}


def zmp_and_cop(measured, P: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both from P, at its height: by (10) from MuJoCo's accelerations, and from MuJoCo's contact forces."""
    terms = measured.terms
    PG, weight = terms.position_com_in_world - P, terms.mass_kg * terms.gravity
    rate = momentum_rate(terms, measured.acceleration)
    delta = delta_about(P, terms.position_com_in_world, rate)
    zmp = zmp_vector(PG, delta, weight, rate.normal_force)
    moment, normal = measured.contact_moment_about(P), measured.contact_forces[:, 2].sum()
    return zmp[:2], np.array((-moment[1], moment[0])) / normal


@pytest.mark.parametrize("support", ["left", "right", "double"])
@pytest.mark.parametrize("reference", [{"kind": "hold"}, SLOW, FORWARD], ids=["standing", "lateral", "forward"])
def test_zmp_is_the_centre_of_pressure(simulate, measured_tick, robot, support, reference):
    simulation = simulate(support=support, reference=reference)
    places = []
    for tick in range(601):
        measured = measured_tick(simulation)
        if tick % 50:
            continue
        P = np.array((0.03, -0.04, 0.0))  # any point of the ground will do
        zmp, cop = zmp_and_cop(measured, P)
        places.append(P[:2] + cop)
        assert_allclose(zmp, cop, rtol=0, atol=1e-9)  # rounding: wrenches of 1e3 N m over 1e3 N
        # and it is the pressure's mean place; contacts lie a little below P, so that friction has a small lever
        forces, points = measured.contact_forces, measured.contact_points
        mean = (forces[:, 2] @ points[:, :2]) / forces[:, 2].sum()
        lever = np.abs(points[:, 2]).max() * np.abs(forces[:, :2]).sum() / forces[:, 2].sum()
        assert np.abs(P[:2] + zmp - mean).max() <= lever + 1e-9
        # the program's own measurement, from the sole's P a fraction of a millimetre below, says the same
        assert_allclose(measured.tick.balance.zmp_in_world, P[:2] + cop, rtol=0, atol=1e-4)
    if reference["kind"] == "swing":  # it went somewhere: the law is not vacuous
        assert np.ptp(np.array(places), axis=0).max() > 0.005


def test_at_rest_the_centre_of_pressure_is_below_the_centre_of_mass(simulate, measured_tick):
    simulation = simulate()
    for _ in range(2000):
        measured = measured_tick(simulation)
    at_rest = measured.terms.position_com_in_world[:2]
    _, cop = zmp_and_cop(measured, np.zeros(3))
    assert np.abs(measured.terms.velocity_com_in_world).max() < 1e-5
    assert_allclose(cop, at_rest, rtol=0, atol=1e-5)  # C - G = -h a / g, with a below 1e-4 m/s2 at rest


def test_moment_about_the_centre_of_pressure_is_vertical(simulate, measured_tick):
    """M_C with C measured: its horizontal part vanishes; its vertical part, held by friction, does not."""
    simulation = simulate(reference={**SLOW, "duration_s": 0.5})
    for _ in range(150):
        measured = measured_tick(simulation)
    terms, P = measured.terms, np.array((0.0, 0.11, 0.0))
    rate = momentum_rate(terms, measured.acceleration)
    delta = delta_about(P, terms.position_com_in_world, rate)
    _, cop = zmp_and_cop(measured, P)
    PG, weight = terms.position_com_in_world - P, terms.mass_kg * terms.gravity
    M_C = moment_about_zmp(PG, np.r_[cop, 0.0], delta, weight, rate.linear)
    assert_allclose(M_C[:2], 0.0, rtol=0, atol=1e-9)
    assert abs(M_C[2]) > 0.1
    about_cop = measured.contact_moment_about(P + np.r_[cop, 0.0])
    assert about_cop[2] == pytest.approx(-M_C[2], abs=1e-9)  # the ground holds what inertia exerts
