"""Both ways of solving a QP agree with each other and with Clarabel, and neither invents an answer."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.qp import solver
from surefoot.control.qp.solver import CLARABEL, CLOSED_FORM, DAQP, QuadraticProgram, solve_qp

FEASIBLE, CONTRADICTORY, UNREACHABLE = "feasible", "contradictory rows", "an equality out of reach"


def random_problem(rng: np.random.Generator, kind: str) -> QuadraticProgram:
    """Sizes and weights like the contact QPs'; in a feasible one a known point keeps every row."""
    n, k, m = int(rng.integers(6, 31)), int(rng.integers(1, 6)), int(rng.integers(5, 41))
    weights = 10.0 ** rng.uniform(-2.0, 1.0, n)
    G, A, inside = rng.normal(size=(m, n)), rng.normal(size=(k, n)), rng.normal(size=n)
    room = 10.0 ** rng.uniform(-2.0, 3.0) * (0.1 + rng.exponential(size=m))  # wide ones leave the minimiser alone
    h, b = G @ inside + room, A @ inside
    if kind == CONTRADICTORY:
        G, h = np.vstack((G, -G[:1])), np.r_[h, -h[0] - 10.0 ** rng.uniform(-2.0, 1.0)]
    if kind == UNREACHABLE:
        G, h = np.vstack((G, A[:1])), np.r_[h, b[0] - 10.0 ** rng.uniform(-2.0, 1.0)]
    return QuadraticProgram(weights, G, h, A, b)


def agree(qp: QuadraticProgram, kind: str) -> tuple[str, bool]:
    """Check one problem; returns the way that was taken, and whether Clarabel had an answer to compare with."""
    found = solve_qp(qp, DAQP)
    active_set, interior = solver._solve_with_daqp(qp), solver._solve_with_clarabel(qp)
    if kind != FEASIBLE:
        assert found.x is None
        assert found.held_back
        assert interior.x is None
        return found.method, True
    assert found.x is not None
    assert active_set.x is not None
    size = 1.0 + np.abs(active_set.x).max()
    assert_allclose(found.x, active_set.x, rtol=0, atol=1e-5 * size)
    best = 0.5 * qp.weights @ found.x**2
    if interior.x is not None:
        assert abs(best - 0.5 * qp.weights @ interior.x**2) <= 1e-5 * (1.0 + best)
    assert found.held_back == (found.method != CLOSED_FORM)
    primal, dual, gap = found.residuals()
    assert primal <= 1e-5
    assert dual <= 1e-6 * size * qp.weights.max()
    assert gap <= 1e-4 * (1.0 + best)
    return found.method, interior.x is not None


@pytest.mark.parametrize(
    "number", [600, pytest.param(10_000, marks=pytest.mark.slow)], ids=lambda number: f"{number} problems"
)
def test_both_ways_and_clarabel_agree_on_random_problems(number):
    rng = np.random.default_rng(1017)
    taken: dict[str, int] = {}
    unanswered = 0
    for i in range(number):
        kind = (FEASIBLE, FEASIBLE, CONTRADICTORY, FEASIBLE, UNREACHABLE)[i % 5]
        way, answered = agree(random_problem(rng, kind), kind)
        unanswered += not answered
        taken[way] = taken.get(way, 0) + 1
    # Clarabel runs out of iterations on 1 of the 10 000; that our answer is optimal its residuals say there alone
    assert unanswered <= number // 1000
    assert set(taken) == {CLOSED_FORM, DAQP}
    assert min(taken.values()) > number // 10, taken  # each way was really tried


def test_the_closed_form_is_taken_up_to_the_bound_and_not_beyond():
    """Minimise 1/2 |x|^2 subject to x_0 + x_1 = 2: (1, 1), with x_0 <= h."""
    for h, way, x in ((1.0, CLOSED_FORM, (1.0, 1.0)), (1.0 - 1e-4, DAQP, (1.0 - 1e-4, 1.0 + 1e-4))):
        qp = QuadraticProgram(np.ones(2), np.array([[1.0, 0.0]]), np.array([h]), np.ones((1, 2)), np.array([2.0]))
        found = solve_qp(qp, DAQP)
        assert found.method == way
        assert_allclose(found.x, x, rtol=0, atol=1e-9)


def test_equality_multipliers_are_the_price_of_the_equality_in_both_ways():
    """The minimum of 1/2 |x|^2 with x_0 + x_1 = b is b^2/4: P x + A'y = 0 gives y = -b/2."""
    for h in (5.0, 0.5):
        G = np.array([[1.0, 0.0]])
        qp = QuadraticProgram(np.ones(2), G, np.array([h]), np.ones((1, 2)), np.array([2.0]))
        for found in (solve_qp(qp, DAQP), solver._solve_with_daqp(qp), solve_qp(qp, CLARABEL)):
            z, y = found.raw.z, found.equality_multipliers
            assert z is not None
            assert_allclose(found.x + G.T @ z + np.ones(2) * y, 0.0, rtol=0, atol=1e-6)
            assert_allclose(y, -1.0 if h > 1.0 else -1.5, rtol=0, atol=1e-6)


def test_dependent_equalities_are_no_closed_form():
    rows = np.array([[1.0, 1.0], [1.0, 1.0]])
    assert solver.equality_constrained_minimiser(np.ones(2), rows.T, np.array([1.0, 2.0])) is None


@pytest.mark.parametrize("broken", ["weights", "h", "A", "b"])
def test_a_nan_is_no_answer(broken):
    rng = np.random.default_rng(3)
    parts = {name: getattr(random_problem(rng, FEASIBLE), name) for name in ("weights", "G", "h", "A", "b")}
    qp = random_problem(rng, FEASIBLE)
    parts = {name: getattr(qp, name).copy() for name in parts}
    parts[broken].flat[0] = np.nan
    assert QuadraticProgram(**parts).solve_in_closed_form() is None


def test_the_solver_leaves_the_shared_rows_alone():
    """Their kinds and lower bounds are kept from call to call."""
    rng = np.random.default_rng(5)
    qp = random_problem(rng, FEASIBLE)
    solver._solve_with_daqp(qp)
    lower, kinds = solver._daqp_rows(len(qp.h), len(qp.b))
    assert (lower == -1e30).all()
    assert kinds.tolist() == [0] * len(qp.h) + [5] * len(qp.b)
