"""The contact QP (17): which accelerations and contact forces come nearest to the motion asked for.

Variables: x = (y, l). y are deviations of the free rows of kappa'' (all but those of the stance feet) from the wanted
ones, l the forces at the corners of the stance soles in foot axes, in body weights. Then

    q'' = q''_wanted + H^-1 y,    tau = M q'' + bias - C^T lambda     (1)

Objective: 1/2 sum w y^2 + 1/2 eps |l|^2.
Subject to: the six base rows of (1), which no motor drives; friction pyramid and unilateral contact at every corner;
torque limits; joint ranges; optionally given ankle torques and the capture guard. Contact itself (C q'' + s as the
stance feet's rows of kappa'' ask) holds by construction, those rows are no variables.

The paper gives no objective; this one is what modern controllers use.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.control.command import AccelerationResponse
from app.control.solver import QuadraticProgram
from app.control.support import SupportGeometry, friction_rows, grasp_map
from app.dynamics.terms import FOOT_ROWS, KAPPA_DIMENSION, DynamicsTerms
from app.robot.description import BASE_DOFS, RobotDescription

_FORCE_WEIGHT = 1e-4  # of squared body weights against squared m/s2: decides only how the corners share
_RANGE_HORIZON_S = 0.05  # a joint may use up the distance to its stop within this time, not faster
_RANGE_BRAKE = 300.0  # rad/s2: the most that a joint range asks for
_RANGE_NEAR = 100.0  # rad/s2: a bound further than this from the acceleration wanted gets no row


@dataclass(frozen=True, slots=True, eq=False)
class ContactModel:
    """Contact forces of the stance feet at one state.

    Attributes:
        transposed_jacobian: C^T (21, 3 n), corner forces in body weights -> generalized forces.
        friction: (4 n, 3 n) rows of the friction pyramid, rows @ forces <= 0.
    """

    transposed_jacobian: np.ndarray
    friction: np.ndarray


def contact_model(
    robot: RobotDescription, terms: DynamicsTerms, support: SupportGeometry, *, corner_scale: float, friction: float
) -> ContactModel:
    """C^T and the cones of all stance corners, which are scaled about the sole's centroid by ``corner_scale``."""
    weight = terms.mass_kg * terms.gravity
    blocks = []
    for i in support.stance:
        G, R, J = grasp_map(robot, i, corner_scale), terms.feet[i].rotation_foot_to_world, terms.feet[i].jacobian
        world = np.empty_like(G)
        R = weight * R
        world[:3], world[3:] = R.dot(G[:3]), R.dot(G[3:])
        blocks.append(J.T.dot(world))
    CT = blocks[0] if len(blocks) == 1 else np.hstack(blocks)
    return ContactModel(CT, friction_rows(CT.shape[1] // 3, friction))


def force_qp(terms: DynamicsTerms, acceleration: np.ndarray, contacts: ContactModel) -> QuadraticProgram:
    """The hard form: q'' is given, find the least contact forces that carry it.

    Minimise 1/2 |l|^2 subject to the six base rows of (1) and the cones; infeasible exactly when the ZMP asked for
    leaves the sole or the force leaves the friction pyramid.

    Equation: (17)
    """
    A = contacts.transposed_jacobian[:BASE_DOFS]
    b = terms.mass_matrix[:BASE_DOFS].dot(acceleration) + terms.bias[:BASE_DOFS]
    n = A.shape[1]
    scale = 1.0 / (terms.mass_kg * terms.gravity)
    G = contacts.friction
    return QuadraticProgram(np.eye(n), np.zeros(n), G, np.zeros(len(G)), scale * A, scale * b)


@dataclass(frozen=True, slots=True, eq=False)
class MotionQP:
    """The soft form with what is needed to read its answer.

    Attributes:
        qp: the plain problem.
        nominal: q'' wanted (21,).
        response: (21, n_y) dq''/dy.
        contacts: the contact forces' model.
    """

    qp: QuadraticProgram
    nominal: np.ndarray
    response: np.ndarray
    contacts: ContactModel

    def interpret(self, x: np.ndarray, terms: DynamicsTerms) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Torques (15,), q'' (21,), and generalized contact forces (21,) of a solution."""
        n = self.response.shape[1]
        acceleration = self.nominal + self.response.dot(x[:n])
        contact = self.contacts.transposed_jacobian.dot(x[n:])
        torques = (terms.mass_matrix.dot(acceleration) + terms.bias - contact)[BASE_DOFS:]
        return torques, acceleration, contact


def motion_qp(
    robot: RobotDescription, terms: DynamicsTerms, response: AccelerationResponse, weights: np.ndarray,
    support: SupportGeometry, contacts: ContactModel, *, ankle_torques: dict[int, float] | None = None,
    force_rows: np.ndarray | None = None,
) -> MotionQP:  # fmt: skip
    """The soft form: the nearest motion that contacts, motors and joints allow.

    Equation: (17)

    Args:
        robot: limits.
        terms: dynamics at the state.
        response: q'' wanted, and the factors of H.
        weights: of the rows of kappa'' (21,).
        support: stance feet.
        contacts: their forces.
        ankle_torques: velocity index -> torque [N m] that the ankle law has decided.
        force_rows: further rows (k, 3 n) on the corner forces, rows @ forces <= 0 (the capture guard).
    """
    acceleration = response.acceleration
    layout = _layout(support.stance, tuple(ankle_torques or ()))
    HI = response.inverse_output_jacobian().take(layout.free, axis=1)
    CT = contacts.transposed_jacobian
    ny, nl, ne, nm = len(layout.free), CT.shape[1], layout.equalities, len(layout.order) - layout.equalities
    scale = 1.0 / (terms.mass_kg * terms.gravity)

    # generalized forces as functions of x, the rows that are prescribed first: base rows must vanish, given ankle
    # torques must come out; the others are the torques that motors limit
    slope = np.empty((KAPPA_DIMENSION, ny + nl))
    slope[:, :ny] = terms.mass_matrix.dot(HI)
    slope[:, ny:] = -CT
    slope *= scale
    slope = slope.take(layout.order, axis=0)
    at_zero = (scale * (terms.mass_matrix.dot(acceleration) + terms.bias)).take(layout.order)
    b = -at_zero[:ne]
    if ankle_torques:
        b[BASE_DOFS:] += scale * np.fromiter(ankle_torques.values(), dtype=float)

    cones = contacts.friction if force_rows is None else np.vstack((contacts.friction, force_rows))
    rows, bounds = _joint_range_rows(robot, terms, acceleration, HI)
    nc = len(cones)
    G = np.zeros((nc + 2 * nm + len(rows), ny + nl))
    h = np.zeros(len(G))
    G[:nc, ny:] = cones
    limits = scale * robot.torque_limits.take(layout.order[ne:] - BASE_DOFS)
    G[nc : nc + nm] = slope[ne:]
    np.negative(slope[ne:], out=G[nc + nm : nc + 2 * nm])
    h[nc : nc + nm] = limits - at_zero[ne:]
    h[nc + nm : nc + 2 * nm] = limits + at_zero[ne:]
    if len(rows):
        G[nc + 2 * nm :, :ny], h[nc + 2 * nm :] = rows, bounds

    P = np.zeros((ny + nl, ny + nl))
    diagonal = P.reshape(-1)[:: ny + nl + 1]
    diagonal[:ny], diagonal[ny:] = weights.take(layout.free), _FORCE_WEIGHT
    return MotionQP(QuadraticProgram(P, np.zeros(ny + nl), G, h, slope[:ne], b), acceleration, HI, contacts)


@dataclass(frozen=True, slots=True, eq=False)
class _Layout:
    """Which rows are what for one set of stance feet and given torques."""

    free: np.ndarray  # rows of kappa'' that are variables
    order: np.ndarray  # generalized forces, the prescribed ones first
    equalities: int  # how many are prescribed


@lru_cache(maxsize=32)
def _layout(stance: tuple[int, ...], given: tuple[int, ...]) -> _Layout:
    held = np.concatenate([np.r_[FOOT_ROWS[i]] for i in stance])
    free = np.setdiff1d(np.arange(KAPPA_DIMENSION), held)
    prescribed = [*range(BASE_DOFS), *given]
    others = [dof for dof in range(BASE_DOFS, KAPPA_DIMENSION) if dof not in given]
    return _Layout(free, np.array(prescribed + others), len(prescribed))


def _joint_range_rows(
    robot: RobotDescription, terms: DynamicsTerms, acceleration: np.ndarray, response: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Rows on y for the joints near a stop: q + q' T + q'' T^2/2 stays in range over the horizon T.

    Only joints whose bound lies near the acceleration wanted get a row; the others cannot meet theirs.
    """
    T = _RANGE_HORIZON_S
    ahead = terms.state.q[BASE_DOFS + 1 :] + T * terms.state.v[BASE_DOFS:]
    nominal = acceleration[BASE_DOFS:]
    gain = 2.0 / (T * T)
    slack = np.concatenate((robot.joint_upper - ahead, ahead - robot.joint_lower))
    slack *= gain
    np.maximum(slack, -_RANGE_BRAKE, out=slack)
    n = len(nominal)
    slack[:n] -= nominal
    slack[n:] += nominal
    near = (slack < _RANGE_NEAR).nonzero()[0]
    rows = response.take(BASE_DOFS + near % n, axis=0)
    rows[near >= n] *= -1.0
    return rows, slack.take(near)
