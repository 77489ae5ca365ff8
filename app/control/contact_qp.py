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

import numpy as np
from scipy.linalg import lapack

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
    robot: RobotDescription, terms: DynamicsTerms, acceleration: np.ndarray, weights: np.ndarray,
    support: SupportGeometry, contacts: ContactModel, *, ankle_torques: dict[int, float] | None = None,
    force_rows: np.ndarray | None = None,
) -> MotionQP:  # fmt: skip
    """The soft form: the nearest motion that contacts, motors and joints allow.

    Equation: (17)

    Args:
        robot: limits.
        terms: dynamics at the state.
        acceleration: q'' wanted (21,).
        weights: of the rows of kappa'' (21,).
        support: stance feet.
        contacts: their forces.
        ankle_torques: velocity index -> torque [N m] that the ankle law has decided.
        force_rows: further rows (k, 3 n) on the corner forces, rows @ forces <= 0 (the capture guard).
    """
    free = _free_rows(support.stance)
    lu, pivots, _ = lapack.dgetrf(terms.output_jacobian)
    response = lapack.dgetri(lu, pivots)[0][:, free]
    ny, nl = len(free), contacts.transposed_jacobian.shape[1]

    # generalized forces as functions of x: rows 0..5 must vanish, rows 6.. are the torques
    slope = np.empty((KAPPA_DIMENSION, ny + nl))
    slope[:, :ny] = terms.mass_matrix.dot(response)
    slope[:, ny:] = -contacts.transposed_jacobian
    at_zero = terms.mass_matrix.dot(acceleration) + terms.bias

    equal = np.arange(BASE_DOFS)
    motors = np.arange(BASE_DOFS, KAPPA_DIMENSION)
    b = -at_zero[:BASE_DOFS]
    if ankle_torques:
        given = np.fromiter(ankle_torques, dtype=int)
        equal = np.concatenate((equal, given))
        b = np.concatenate((b, np.fromiter(ankle_torques.values(), dtype=float) - at_zero[given]))
        motors = np.array([dof for dof in motors if dof not in ankle_torques])
    scale = 1.0 / (terms.mass_kg * terms.gravity)
    A, b = scale * slope[equal], scale * b

    limits = robot.torque_limits[motors - BASE_DOFS]
    rows, bounds = _joint_range_rows(robot, terms, acceleration, response)
    cones = contacts.friction if force_rows is None else np.vstack((contacts.friction, force_rows))
    nc, nm = len(cones), len(motors)
    G = np.zeros((nc + 2 * nm + len(rows), ny + nl))
    h = np.zeros(len(G))
    G[:nc, ny:] = cones
    torque_slope, torque_zero = scale * slope[motors], scale * at_zero[motors]
    G[nc : nc + nm], G[nc + nm : nc + 2 * nm] = torque_slope, -torque_slope
    h[nc : nc + nm], h[nc + nm : nc + 2 * nm] = scale * limits - torque_zero, scale * limits + torque_zero
    if len(rows):
        G[nc + 2 * nm :, :ny], h[nc + 2 * nm :] = rows, bounds

    P = np.diag(np.concatenate((weights[free], np.full(nl, _FORCE_WEIGHT))))
    qp = QuadraticProgram(P, np.zeros(ny + nl), G, h, A, b)
    return MotionQP(qp, acceleration, response, contacts)


_FREE: dict[tuple[int, ...], np.ndarray] = {
    stance: np.setdiff1d(np.arange(KAPPA_DIMENSION), np.concatenate([np.r_[FOOT_ROWS[i]] for i in stance]))
    for stance in ((0,), (1,), (0, 1))
}


def _free_rows(stance: tuple[int, ...]) -> np.ndarray:
    return _FREE[stance]


def _joint_range_rows(
    robot: RobotDescription, terms: DynamicsTerms, acceleration: np.ndarray, response: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Rows on y for the joints near a stop: q + q' T + q'' T^2/2 stays in range over the horizon T.

    Only joints whose bound lies near the acceleration wanted get a row; the others cannot meet theirs.
    """
    T = _RANGE_HORIZON_S
    ahead = terms.state.q[7:] + T * terms.state.v[BASE_DOFS:]
    nominal = acceleration[BASE_DOFS:]
    gain = 2.0 / (T * T)
    above = np.maximum(gain * (robot.joint_upper - ahead), -_RANGE_BRAKE) - nominal
    below = nominal - np.minimum(gain * (robot.joint_lower - ahead), _RANGE_BRAKE)
    near_upper, near_lower = np.nonzero(above < _RANGE_NEAR)[0], np.nonzero(below < _RANGE_NEAR)[0]
    rows = np.vstack((response[BASE_DOFS + near_upper], -response[BASE_DOFS + near_lower]))
    return rows, np.concatenate((above[near_upper], below[near_lower]))
