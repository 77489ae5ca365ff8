"""How far a foot is trusted: load, centre of pressure, turning."""

import numpy as np
import pytest

from surefoot.estimation.contact import FootContact
from surefoot.geometry.rotations import cross

WEIGHT = 1000.0
STILL = np.zeros(3)


def pressed(foot, at, force):
    """The wrench about the ankle of a force (3,) that acts at a point (2,) of the sole."""
    lever = np.array((*at, -foot.ankle_height_m))
    return np.concatenate((force, cross(lever, np.asarray(force))))


@pytest.mark.parametrize("side", [0, 1])
def test_the_centre_of_pressure_tells_the_edge_whatever_the_tangential_force(robot, side):
    foot = robot.feet[side]
    force = np.array((80.0, -60.0, 500.0))
    for corner in foot.sole.vertices:
        inside = foot.sole.centroid + 0.6 * (corner - foot.sole.centroid)
        contact = FootContact(foot, WEIGHT, 0.0)
        assert contact.update(pressed(foot, inside, force), STILL, 1e-3).edge == 0.0
        assert contact.update(pressed(foot, corner, force), STILL, 1e-3).edge == pytest.approx(1.0, abs=1e-6)


def test_trust_grows_smoothly_with_the_load(robot):
    foot = robot.feet[0]
    loads = [
        FootContact(foot, WEIGHT, 0.0).update(pressed(foot, foot.sole.centroid, (0.0, 0.0, n)), STILL, 1e-3).load
        for n in np.linspace(-20.0, 300.0, 321)
    ]
    assert loads[0] == 0.0
    assert loads[-1] == 1.0
    steps = np.diff(loads)
    assert (steps >= 0.0).all()
    assert steps.max() < 0.02


def test_a_sole_that_turns_is_told_from_noise(robot):
    rng, foot = np.random.default_rng(1), robot.feet[0]
    wrench = pressed(foot, foot.sole.centroid, (0.0, 0.0, 500.0))
    still, turns = (FootContact(foot, WEIGHT, 0.05) for _ in range(2))
    noise = 0.05 * rng.normal(size=(600, 3))
    quiet = [still.update(wrench, w, 1e-3).turning_rad_s for w in noise]
    seen = [turns.update(wrench, w + (0.0, 0.2, 0.0), 1e-3).turning_rad_s for w in noise]
    assert np.mean(quiet) < 0.005
    assert np.mean(seen[200:]) == pytest.approx(0.2, rel=0.1)
