"""Nearest point of an intersection of half-planes, against a QP solver; least worst violation, against an LP solver."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from qpsolvers import solve_qp
from scipy.optimize import linprog

from surefoot.geometry.polygon import least_violating_point, project_onto_halfplanes

SEEDS = range(150)


def random_halfplanes(rng, count: int) -> tuple[np.ndarray, np.ndarray]:
    angles = rng.uniform(-np.pi, np.pi, size=count)
    return np.column_stack((np.cos(angles), np.sin(angles))), rng.uniform(-0.3, 1.0, size=count)


def is_empty(normals, bounds) -> bool:
    """Whether no point satisfies all: the least worst violation is positive."""
    return least_worst_violation(np.zeros((0, 2)), np.zeros(0), normals, bounds) > 1e-7


def least_worst_violation(hard_normals, hard_bounds, soft_normals, soft_bounds) -> float:
    rows = np.vstack((
        np.column_stack((hard_normals, np.zeros(len(hard_bounds)))),
        np.column_stack((soft_normals, -np.ones(len(soft_bounds)))),
    ))  # fmt: skip
    answer = linprog([0.0, 0.0, 1.0], rows, np.r_[hard_bounds, soft_bounds], bounds=[(-10.0, 10.0)] * 3)
    assert answer.success
    return answer.fun


@pytest.mark.parametrize("seed", SEEDS)
def test_projection_is_the_nearest_point_that_a_qp_solver_finds(seed):
    rng = np.random.default_rng(seed)
    normals, bounds = random_halfplanes(rng, int(rng.integers(1, 13)))
    point = rng.normal(scale=2.0, size=2)
    ours = project_onto_halfplanes(point, normals, bounds)
    if is_empty(normals, bounds):
        assert ours is None
        return
    theirs = solve_qp(np.eye(2), -point, normals, bounds, solver="daqp", primal_tol=1e-11)
    assert_allclose(ours, theirs, rtol=0, atol=1e-7)  # both take violations of some 1e-9, enlarged in sharp corners
    assert (normals @ ours - bounds).max() < 1e-8


def test_random_cases_cover_inside_outside_and_empty():
    """The cases above are of every kind, or they would prove little."""
    kinds = set()
    for seed in SEEDS:
        rng = np.random.default_rng(seed)
        normals, bounds = random_halfplanes(rng, int(rng.integers(1, 13)))
        point = rng.normal(scale=2.0, size=2)
        answer = project_onto_halfplanes(point, normals, bounds)
        if answer is None:
            kinds.add("empty")
        else:
            kinds.add(("inside", "edge", "corner")[min(2, int((np.abs(normals @ answer - bounds) < 1e-8).sum()))])
    assert kinds == {"empty", "inside", "edge", "corner"}


def test_a_point_inside_is_its_own_projection():
    normals, bounds = np.array(((1.0, 0.0), (0.0, 1.0))), np.array((1.0, 1.0))
    point = np.array((0.5, -3.0))
    assert project_onto_halfplanes(point, normals, bounds) is point


@pytest.mark.parametrize("seed", range(60))
def test_least_violating_point_has_the_least_worst_violation(seed):
    """Hard: a box. Soft: half-planes that cannot all hold."""
    rng = np.random.default_rng(seed)
    hard_normals = np.array(((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)))
    hard_bounds = rng.uniform(0.1, 0.5, size=4)
    soft_normals, _ = random_halfplanes(rng, 5)
    soft_bounds = rng.uniform(-1.5, -0.5, size=5)
    ours = least_violating_point(hard_normals, hard_bounds, soft_normals, soft_bounds)
    assert (hard_normals @ ours - hard_bounds).max() <= 1e-7
    worst = (soft_normals @ ours - soft_bounds).max()
    least = least_worst_violation(hard_normals, hard_bounds, soft_normals, soft_bounds)
    assert least > 0.1
    assert worst == pytest.approx(least, abs=1e-7)
