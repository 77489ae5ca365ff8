"""The only door to the QP solvers: a plain problem in, a plain answer out."""

from dataclasses import dataclass

import numpy as np
from qpsolvers import Problem, Solution
from qpsolvers.solvers.clarabel_ import clarabel_solve_problem
from qpsolvers.solvers.daqp_ import daqp_solve_problem
from scipy.sparse import csc_matrix


@dataclass(frozen=True, slots=True, eq=False)
class QuadraticProgram:
    """Minimise 1/2 x'Px + q'x subject to Gx <= h and Ax = b; a test can open it."""

    P: np.ndarray
    q: np.ndarray
    G: np.ndarray
    h: np.ndarray
    A: np.ndarray
    b: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class QPSolution:
    """The answer.

    Attributes:
        x: the minimiser, or None when there is none (infeasible, or the solver gave up).
        raw: the solver's own answer, with its multipliers and residuals.
    """

    x: np.ndarray | None
    raw: Solution

    def residuals(self) -> tuple[float, float, float]:
        """Primal residual, dual residual and duality gap, in the problem's units."""
        return self.raw.primal_residual(), self.raw.dual_residual(), self.raw.duality_gap()


def solve_qp(qp: QuadraticProgram, solver: str) -> QPSolution:
    """Solve with ``daqp`` (dual active set: exact, fast at these sizes) or ``clarabel`` (interior point)."""
    if solver == "daqp":
        solution = daqp_solve_problem(Problem(qp.P, qp.q, qp.G, qp.h, qp.A, qp.b))
    else:  # sparse by nature
        solution = clarabel_solve_problem(
            Problem(csc_matrix(qp.P), qp.q, csc_matrix(qp.G), qp.h, csc_matrix(qp.A), qp.b)
        )
    x = solution.x if solution.found else None
    if x is not None and not np.isfinite(x.sum()):
        x = None
    return QPSolution(x, solution)
