"""The measured ZMP and its margin, for contact forces put where they are known to be."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.geometry.polygon import convex_hull
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.robot.feet import Support
from surefoot.simulation.measurement import measure_balance, sole_outline
from surefoot.simulation.plant import FootTruth

LEFT_ANKLE, RIGHT_ANKLE = np.array((0.0, 0.11, 0.083)), np.array((0.05, -0.11, 0.083))
FORCE = np.array((30.0, -20.0, 800.0))
NOTHING = np.zeros(3)


def pressed_at(ankle: np.ndarray, place: tuple[float, float], force=FORCE, rotation=None) -> FootTruth:
    """A foot on which one force acts, at a place of its sole relative to P (foot frame)."""
    R = np.eye(3) if rotation is None else rotation
    lever = R @ np.array((*place, -0.083))
    return FootTruth(ankle, R, np.asarray(force), np.cross(lever, force))


def in_the_air(ankle: np.ndarray) -> FootTruth:
    return FootTruth(ankle, np.eye(3), NOTHING, NOTHING)


@pytest.mark.parametrize("place", [(0.0, 0.0), (0.1, 0.05), (-0.1, -0.02), (0.17, 0.0), (0.2, 0.0)])
def test_single_support_finds_the_force_where_it_acts(robot, place):
    feet = pressed_at(LEFT_ANKLE, place), in_the_air(RIGHT_ANKLE)
    balance = measure_balance(robot, feet, Support.LEFT)
    assert_allclose(balance.zmp_in_world, LEFT_ANKLE[:2] + place, rtol=0, atol=1e-12)
    assert balance.zmp_margin == pytest.approx(robot.feet[0].sole.signed_margin(np.array(place)), abs=1e-12)
    assert balance.normal_forces == (800.0, 0.0)
    assert_allclose(balance.origin, LEFT_ANKLE - [0.0, 0.0, 0.083], rtol=0, atol=1e-15)


@pytest.mark.parametrize(("place", "margin"), [((0.16, 0.0), 0.01), ((-0.115, 0.0), 0.005), ((0.19, 0.0), -0.02)])
def test_margin_is_the_distance_to_the_nearest_edge(robot, place, margin):
    feet = pressed_at(LEFT_ANKLE, place), in_the_air(RIGHT_ANKLE)
    assert measure_balance(robot, feet, Support.LEFT).zmp_margin == pytest.approx(margin, abs=1e-12)


@pytest.mark.parametrize("rpy", [(0.06, 0.0, 0.0), (0.0, -0.05, 0.3), (0.1, 0.1, -2.0)])
def test_margin_is_taken_in_the_plane_of_a_tilted_sole(robot, rpy):
    rotation = rotation_from_rpy(*rpy)
    feet = pressed_at(LEFT_ANKLE, (0.1, 0.03), rotation=rotation), in_the_air(RIGHT_ANKLE)
    balance = measure_balance(robot, feet, Support.LEFT)
    assert balance.zmp_margin == pytest.approx(robot.feet[0].sole.signed_margin(np.array((0.1, 0.03))), abs=1e-12)
    there = LEFT_ANKLE + rotation @ np.array((0.1, 0.03, -0.083))
    assert_allclose(balance.zmp_in_world, there[:2], rtol=0, atol=1e-12)


def test_right_support_looks_at_the_right_foot(robot):
    feet = in_the_air(LEFT_ANKLE), pressed_at(RIGHT_ANKLE, (0.02, 0.01))
    balance = measure_balance(robot, feet, Support.RIGHT)
    assert_allclose(balance.zmp_in_world, RIGHT_ANKLE[:2] + (0.02, 0.01), rtol=0, atol=1e-12)


@pytest.mark.parametrize("left_part", [0.0, 0.25, 0.5, 1.0])
def test_double_support_finds_the_mean_of_both_by_their_loads(robot, left_part):
    loads = 1000.0 * left_part, 1000.0 * (1.0 - left_part)
    feet = pressed_at(LEFT_ANKLE, (0.05, 0.0), (0, 0, loads[0])), pressed_at(RIGHT_ANKLE, (0.0, 0.0), (0, 0, loads[1]))
    balance = measure_balance(robot, feet, Support.DOUBLE)
    expected = left_part * (LEFT_ANKLE[:2] + (0.05, 0.0)) + (1.0 - left_part) * RIGHT_ANKLE[:2]
    assert_allclose(balance.zmp_in_world, expected, rtol=0, atol=1e-12)
    hull = convex_hull(np.vstack([sole_outline(robot, foot, i) for i, foot in enumerate(feet)]))
    assert balance.zmp_margin == pytest.approx(hull.signed_margin(expected), abs=1e-8)
    assert balance.zmp_margin > 0.04
    assert balance.normal_forces == loads


@pytest.mark.parametrize("support", Support)
def test_in_the_air_there_is_no_zmp(robot, support):
    balance = measure_balance(robot, (in_the_air(LEFT_ANKLE), in_the_air(RIGHT_ANKLE)), support)
    assert np.isnan(balance.zmp_in_world).all()
    assert np.isnan(balance.zmp_margin)
