"""The only way to the QP solvers: a plain problem in, a plain answer out.

While the robot stands no inequality holds it back. The minimiser under the equalities alone is then the answer, and one
small Cholesky factorisation gives it; a solver is asked only where that point breaks an inequality.
"""

from functools import lru_cache
from typing import Protocol

import daqp
import numpy as np
import qpsolvers
from qpsolvers.solvers.clarabel_ import clarabel_solve_problem
from scipy.linalg.lapack import dposv  # pyright: ignore[reportAttributeAccessIssue]  (made at import)
from scipy.sparse import csc_matrix

from surefoot.record import record

CLOSED_FORM = "closed-form"
DAQP = "daqp"
CLARABEL = "clarabel"

_DAQP_EQUALITY = 5  # DAQP's mark of a row that is an equality: active (1) and never to be let go (4)
_NO_LOWER_BOUND = -1e30  # more than any row: DAQP takes it for minus infinity
_EQUALITY_TOLERANCE = 1e-6  # DAQP's own primal tolerance: body weights in the contact QPs
_GROSS = 1e-2  # body weights, as the rows: an answer further off is none, where solvers keep them to 1e-6


@record
class QuadraticProgram:
    """Minimise 1/2 sum w x^2 subject to G x <= h and A x = b, with all w > 0; a test can open it.

    Attributes:
        weights: w (n,), the diagonal of P.
        G, h: inequalities (m, n), (m,).
        A, b: equalities (k, n), (k,), rows independent.
    """

    weights: np.ndarray
    G: np.ndarray
    h: np.ndarray
    A: np.ndarray
    b: np.ndarray

    @property
    def P(self) -> np.ndarray:  # noqa: N802  (every text on QPs calls it so)
        """The objective's matrix (n, n)."""
        return np.diag(self.weights)

    @property
    def q(self) -> np.ndarray:
        """The objective's linear part (n,): none."""
        return np.zeros(len(self.weights))

    @property
    def qp(self) -> "QuadraticProgram":
        """Itself: it is written out already."""
        return self

    def solve_in_closed_form(self) -> "QPSolution | None":
        """The minimiser where no inequality is active, else None."""
        found = equality_constrained_minimiser(self.weights, self.A.T, self.b)
        if found is None or not (self.h - self.G.dot(found[0])).min() >= 0.0:  # so written, a NaN is caught too
            return None
        return QPSolution(found[0], CLOSED_FORM, self, None, found[1])


class Problem(Protocol):
    """A problem that may be solved before all its rows are written out."""

    @property
    def qp(self) -> QuadraticProgram:
        """The plain problem."""
        ...

    def solve_in_closed_form(self) -> "QPSolution | None":
        """The minimiser where no inequality is active; None where one is, or where one is to be expected."""
        ...


@record
class QPSolution:
    """The answer.

    Attributes:
        x: the minimiser (n,), or None when there is none (infeasible, or the solver gave up).
        method: the way that found it: ``closed-form``, ``daqp`` or ``clarabel``.
        problem: what was asked.
        multipliers: of the inequalities (m,); None means that all are zero.
        equality_multipliers: of the equalities (k,).
    """

    x: np.ndarray | None
    method: str
    problem: Problem
    multipliers: np.ndarray | None
    equality_multipliers: np.ndarray | None

    @property
    def held_back(self) -> bool:
        """Whether there is no minimiser, or an inequality is active at it."""
        return self.x is None or (self.multipliers is not None and bool(self.multipliers.any()))

    @property
    def raw(self) -> qpsolvers.Solution:
        """The same as qpsolvers has it, with multipliers z and y; residuals are its business."""
        qp, z = self.problem.qp, self.multipliers
        return qpsolvers.Solution(
            qpsolvers.Problem(qp.P, qp.q, qp.G, qp.h, qp.A, qp.b),
            found=self.x is not None,
            x=self.x,
            z=np.zeros(len(qp.h)) if z is None else z,
            y=self.equality_multipliers,
            z_box=np.zeros(0),
        )

    def residuals(self) -> tuple[float, float, float]:
        """Primal residual, dual residual and duality gap, in the problem's units."""
        raw = self.raw
        return raw.primal_residual(), raw.dual_residual(), raw.duality_gap()


def solve_qp(problem: Problem, solver: str) -> QPSolution:
    """Solve a problem.

    Args:
        problem: what to solve.
        solver: ``daqp`` (dual active set: exact, fast at these sizes; tried after the closed form) or ``clarabel``
            (interior point, always the whole problem: the cross-check).
    """
    if solver == DAQP:
        return problem.solve_in_closed_form() or _solve_with_daqp(problem.qp)
    return _solve_with_clarabel(problem.qp)


def equality_constrained_minimiser(
    weights: np.ndarray, transposed_rows: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Minimise 1/2 sum w x^2 subject to A x = b: x = W^-1 A^T (A W^-1 A^T)^-1 b.

    Args:
        weights: w (n,).
        transposed_rows: A^T (n, k).
        b: (k,).

    Returns:
        x (n,) and the multipliers (k,), P x + A^T y = 0; None where the rows of A are not independent.
    """
    weighted = transposed_rows / weights[:, None]
    _, y, info = dposv(transposed_rows.T.dot(weighted), b)
    if info:
        return None
    x = weighted.dot(y)
    missed = transposed_rows.T.dot(x) - b  # rows that depend on each other but for rounding
    return (x, -y) if float(missed.dot(missed)) <= _EQUALITY_TOLERANCE**2 else None


def _solve_with_daqp(qp: QuadraticProgram) -> QPSolution:
    """DAQP without the objects that qpsolvers makes round it: the call that qpsolvers itself would make."""
    m = len(qp.h)
    lower, kinds = _daqp_rows(m, len(qp.b))
    rows, bounds = np.concatenate((qp.G, qp.A)), np.concatenate((qp.h, qp.b))
    try:
        x, _, flag, info = daqp.solve(qp.P, qp.q, rows, bounds, lower, kinds)
        found = flag > 0 and _is_an_answer(qp, x)
        return QPSolution(x if found else None, DAQP, qp, info["lam"][:m], info["lam"][m:])
    except Exception:  # a solver that raises has given up
        return QPSolution(None, DAQP, qp, None, None)


def _is_an_answer(qp: QuadraticProgram, x: np.ndarray | None) -> bool:
    """Whether x is one number for each variable and keeps the rows but for far more than rounding."""
    if x is None or x.shape != qp.weights.shape or not np.isfinite(x.sum()):
        return False
    within = _GROSS * (1.0 + np.abs(qp.h))
    return bool((qp.G.dot(x) - qp.h <= within).all() and (np.abs(qp.A.dot(x) - qp.b) <= _GROSS).all())


@lru_cache(maxsize=128)
def _daqp_rows(inequalities: int, equalities: int) -> tuple[np.ndarray, np.ndarray]:
    """Lower bounds and kinds of the rows, inequalities first; DAQP reads them and writes to neither."""
    kinds = np.zeros(inequalities + equalities, dtype=np.intc)
    kinds[inequalities:] = _DAQP_EQUALITY
    return np.full(inequalities + equalities, _NO_LOWER_BOUND), kinds


def _solve_with_clarabel(qp: QuadraticProgram) -> QPSolution:
    try:
        found = clarabel_solve_problem(  # sparse by nature
            qpsolvers.Problem(csc_matrix(qp.P), qp.q, csc_matrix(qp.G), qp.h, csc_matrix(qp.A), qp.b)
        )
    except Exception:  # a solver that raises has given up
        return QPSolution(None, CLARABEL, qp, None, None)
    usable = found.found and _is_an_answer(qp, found.x)
    return QPSolution(found.x if usable else None, CLARABEL, qp, found.z, found.y)
