"""Faces of a robot's meshes are shared by how large these look, and none is given more than it has."""

import numpy as np
import pytest

from surefoot.dashboard.scene.face_budgets import box_area, shared_faces


def test_all_are_left_alone_where_there_is_room():
    assert shared_faces({"a": 10, "b": 990}, {"a": 1.0, "b": 1.0}, 1000) == {"a": 10, "b": 990}


def test_shares_go_with_size():
    shares = shared_faces(
        {"trunk": 50_000, "thigh": 50_000, "finger": 50_000}, {"trunk": 4, "thigh": 2, "finger": 0.1}, 6100
    )
    assert shares == {"trunk": 4000, "thigh": 2000, "finger": 100}


def test_what_one_does_not_want_goes_to_the_others():
    shares = shared_faces({"plain": 12, "one": 9000, "two": 9000}, {"plain": 8.0, "one": 1.0, "two": 3.0}, 4012)
    assert shares == {"plain": 12, "one": 1000, "two": 3000}


def test_whatever_the_sizes_the_budget_is_kept_and_everyone_has_some():
    rng = np.random.default_rng(0)
    for _ in range(50):
        wanted = dict(enumerate(rng.integers(1, 5000, 30).tolist()))
        sizes = dict(enumerate((10.0 ** rng.uniform(-6, 0, 30)).tolist()))
        shares = shared_faces(wanted, sizes, 20_000)
        assert all(1 <= shares[key] <= wanted[key] for key in wanted)
        assert sum(shares.values()) <= 20_000 + len(wanted)  # one each for the smallest
    assert shared_faces({"a": 50, "b": 50}, {"a": 0.0, "b": 0.0}, 10) == {"a": 5, "b": 5}


def test_the_area_of_a_box():
    corners = np.array([(0.0, 0.0, 0.0), (0.3, 0.2, 0.1)])
    assert box_area(corners) == pytest.approx(0.06 + 0.02 + 0.03)
