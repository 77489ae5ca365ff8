"""Small geometry of the page: overlap of footprints, places of a sole, rays."""

import numpy as np
import pytest

from surefoot.dashboard.messages.stone_view import overlap, sole_place, stone_footprint
from surefoot.dashboard.scene.click_to_place import hit_ground, stone_place
from surefoot.dashboard.scene.marker_meshes import MOST_CORNERS, padded, path_segments
from surefoot.robot.description import load_robot

SQUARE = stone_footprint(0.0, 0.0, (0.1, 0.1))
SOLES = np.array([[(-0.1, y - 0.05, 0.0), (0.2, y - 0.05, 0.0), (0.2, y + 0.05, 0.0), (-0.1, y + 0.05, 0.0)]
                  for y in (0.1, -0.1)])  # fmt: skip


@pytest.mark.parametrize(("x", "y", "touches"), [(0.0, 0.0, True), (0.09, 0.09, True), (0.11, 0.0, False),
                                                 (0.0, -0.2, False), (0.02, 0.01, True)])  # fmt: skip
def test_footprints_overlap(x, y, touches):
    assert overlap(SQUARE, stone_footprint(x, y, (0.1, 0.1))) == touches
    assert overlap(stone_footprint(x, y, (0.1, 0.1)), SQUARE) == touches


def test_a_small_stone_inside_a_sole_overlaps():
    sole = load_robot("bip").feet[0].sole
    assert overlap(sole, stone_footprint(0.0, 0.0, (0.01, 0.01)))


@pytest.mark.parametrize("side", [0, 1])
def test_outer_edges_are_away_from_the_other_foot(side):
    foot = load_robot("bip").feet[side]
    sign = 1.0 if side == 0 else -1.0
    assert sole_place(foot, "outer edge")[1] * sign > 0.05
    assert sole_place(foot, "inner edge")[1] * sign < -0.05
    assert sole_place(foot, "toe")[0] == pytest.approx(0.17)
    assert sole_place(foot, "heel")[0] == pytest.approx(-0.12)


def test_a_ray_down_hits_the_ground_and_a_ray_up_does_not():
    assert hit_ground((1.0, 2.0, 1.0), (0.0, 0.0, -1.0)) == (1.0, 2.0)
    assert hit_ground((0.0, 0.0, 1.0), (1.0, 0.0, -1.0)) == (1.0, 0.0)
    assert hit_ground((0.0, 0.0, 1.0), (0.0, 0.0, 1.0)) is None
    assert hit_ground((0.0, 0.0, 1.0), (1.0, 0.0, -1e-3)) is None  # a kilometre away
    assert hit_ground((20.0, -3.0, 1.0), (1.0, 0.0, -1.0)) == (21.0, -3.0)  # beside a robot that has walked there


def test_a_click_on_a_foot_means_the_place_below_it():
    eye = np.array((2.0, 0.1, 1.0))
    on_foot = np.array((0.1, 0.1, 0.03))
    place = stone_place(tuple(eye), tuple(on_foot - eye), SOLES)
    assert place == pytest.approx((0.1, 0.1))
    beside = np.array((0.5, 0.1, 0.0))
    assert stone_place(tuple(eye), tuple(beside - eye), SOLES) == pytest.approx((0.5, 0.1))


def test_meshes_and_paths_never_change_their_size():
    assert padded(np.zeros((3, 3))).shape == (MOST_CORNERS, 3)
    for n in (0, 1, 2, 30, 90):
        assert path_segments(np.random.default_rng(n).normal(size=(n, 3)), 40).shape == (40, 2, 3)
