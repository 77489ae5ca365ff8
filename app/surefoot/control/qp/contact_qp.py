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

from functools import cached_property, lru_cache

import numpy as np

from surefoot.control.balance.support import SupportGeometry, friction_rows, grasp_map
from surefoot.control.qp.solver import CLOSED_FORM, QPSolution, QuadraticProgram, equality_constrained_minimiser
from surefoot.control.task_acceleration import AccelerationResponse
from surefoot.dynamics.terms import FOOT_ROWS, DynamicsTerms
from surefoot.record import record
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.working_range import working_range

_Motion = tuple[np.ndarray, np.ndarray, np.ndarray]  # torques (m,), q'' (n,), generalized contact forces (n,)

_FORCE_WEIGHT = 1e-4  # of squared body weights against squared m/s2: decides only how the corners share
_RANGE_HORIZON_S = 0.05  # a joint may use up the distance to its stop within this time, not faster
_RANGE_BRAKE = 300.0  # rad/s2: the most that a joint range asks for
_RANGE_NEAR = 100.0  # rad/s2: a bound further than this from the acceleration wanted gets no row


@record
class ContactModel:
    """Contact forces of the stance feet at one state.

    Attributes:
        transposed_jacobian: C^T (dofs, 3 n), corner forces in body weights -> generalized forces.
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
    return QuadraticProgram(np.ones(n), G, np.zeros(len(G)), scale * A, scale * b)


class MotionQP:
    """The soft form: what it is made of, its minimiser in closed form, and the plain problem when that is needed.

    Attributes:
        nominal: q'' wanted (n,).
        contacts: the contact forces' model.
    """

    def __init__(
        self,
        robot: RobotDescription,
        terms: DynamicsTerms,
        response: AccelerationResponse,
        weights: np.ndarray,
        contacts: ContactModel,
        layout: "_Layout",
        ankle_torques: dict[int, float] | None,
        force_rows: np.ndarray | None,
        joint_ranges: bool,
        expect_active: bool,
    ):
        self.nominal, self.contacts = response.acceleration, contacts
        self._robot, self._terms, self._response, self._layout = robot, terms, response, layout
        self._joint_ranges, self._expect_active = joint_ranges, expect_active
        self._scale = 1.0 / (terms.mass_kg * terms.gravity)
        self._at_zero = terms.mass_matrix.dot(self.nominal) + terms.bias  # generalized forces of q'' wanted
        self._cones = contacts.friction if force_rows is None else np.vstack((contacts.friction, force_rows))
        self._weights = np.concatenate((weights.take(layout.free), _force_weights(contacts.friction.shape[1])))
        b = -self._at_zero.take(layout.prescribed)
        if ankle_torques:
            b[BASE_DOFS:] += tuple(ankle_torques.values())
        self._b = self._scale * b
        self._closed_form: tuple[np.ndarray, _Motion] | None = None

    def solve_in_closed_form(self) -> QPSolution | None:
        """The minimiser where no inequality is active, without writing the problem out.

        The equalities' rows need H^-T of a few rows of M only, and the inequalities are read off the motion that comes
        out. None where one is broken, or where the last tick's answer lets expect it.
        """
        if self._expect_active:
            return None
        layout, CT = self._layout, self.contacts.transposed_jacobian
        ny = len(layout.free)
        rows = np.empty((ny + CT.shape[1], len(layout.prescribed)))  # A^T
        prescribed = self._terms.mass_matrix.take(layout.prescribed, axis=0)
        rows[:ny] = self._response.solve_transposed(prescribed.T).take(layout.free, axis=0)
        np.negative(CT.take(layout.prescribed, axis=0).T, out=rows[ny:])
        rows *= self._scale
        found = equality_constrained_minimiser(self._weights, rows, self._b)
        if found is None:
            return None
        x, multipliers = found
        y = np.zeros(len(self.nominal))
        y[layout.free] = x[:ny]
        change = self._response.solve(y)
        motion = self._motion(change, x[ny:])
        if not self._keeps_inequalities(x[ny:], motion[0], change[BASE_DOFS:]):
            return None
        self._closed_form = x, motion
        return QPSolution(x, CLOSED_FORM, self, None, multipliers)

    def _keeps_inequalities(self, forces: np.ndarray, torques: np.ndarray, joint_change: np.ndarray) -> bool:
        """Whether corner forces, torques and joint accelerations (less those wanted) keep every inequality."""
        robot, nc, n = self._robot, len(self._cones), len(torques)
        slack = np.empty(nc + 3 * n)
        np.dot(self._cones, forces, out=slack[:nc])
        np.negative(slack[:nc], out=slack[:nc])
        np.subtract(robot.torque_limits, np.abs(torques), out=slack[nc : nc + n])
        slack[nc + self._layout.given] = 0.0  # torques that the ankle law has decided are not limited here
        room = self._joint_range_slack()
        np.subtract(room[:n], joint_change, out=slack[nc + n : nc + 2 * n])
        np.add(room[n:], joint_change, out=slack[nc + 2 * n :])
        return bool(slack.min() >= 0.0)  # a NaN keeps none

    @cached_property
    def response(self) -> np.ndarray:
        """dq''/dy (n, n_y)."""
        return self._response.inverse_output_jacobian().take(self._layout.free, axis=1)

    @property
    def qp(self) -> QuadraticProgram:
        """The plain problem, all rows written out."""
        layout, terms, robot, scale = self._layout, self._terms, self._robot, self._scale
        HI, CT, cones = self.response, self.contacts.transposed_jacobian, self._cones
        ny, nl, ne, nm = len(layout.free), CT.shape[1], len(layout.prescribed), len(layout.limited)

        # generalized forces as functions of x, the rows that are prescribed first: base rows must vanish, given ankle
        # torques must come out; the others are the torques that motors limit
        slope = np.empty((len(self.nominal), ny + nl))
        slope[:, :ny] = terms.mass_matrix.dot(HI)
        slope[:, ny:] = -CT
        slope *= scale
        slope = slope.take(layout.order, axis=0)
        at_zero = (scale * self._at_zero).take(layout.order)

        rows, bounds = self._joint_range_rows()
        nc = len(cones)
        G = np.zeros((nc + 2 * nm + len(rows), ny + nl))
        h = np.zeros(len(G))
        G[:nc, ny:] = cones
        limits = scale * robot.torque_limits.take(layout.limited)
        G[nc : nc + nm] = slope[ne:]
        np.negative(slope[ne:], out=G[nc + nm : nc + 2 * nm])
        h[nc : nc + nm] = limits - at_zero[ne:]
        h[nc + nm : nc + 2 * nm] = limits + at_zero[ne:]
        if len(rows):
            G[nc + 2 * nm :, :ny], h[nc + 2 * nm :] = rows, bounds
        return QuadraticProgram(self._weights, G, h, slope[:ne], self._b)

    def interpret(self, x: np.ndarray) -> "_Motion":
        """Torques (m,), q'' (n,), and generalized contact forces (n,) of a solution."""
        if self._closed_form is not None and self._closed_form[0] is x:
            return self._closed_form[1]
        n = len(self._layout.free)
        return self._motion(self.response.dot(x[:n]), x[n:])

    def _motion(self, change: np.ndarray, forces: np.ndarray) -> "_Motion":
        contact = self.contacts.transposed_jacobian.dot(forces)
        torques = (self._at_zero + self._terms.mass_matrix.dot(change) - contact)[BASE_DOFS:]
        return torques, self.nominal + change, contact

    def _joint_range_slack(self) -> np.ndarray:
        """How far q'' of every joint may rise and fall, (2 m,), from the one wanted [rad/s2].

        q + q' T + q'' T^2/2 stays in the working range over the horizon T. Endless where ranges are not to be kept.
        """
        if not self._joint_ranges:
            return np.full(2 * len(self._robot.joints), np.inf)
        T, robot, state = _RANGE_HORIZON_S, self._robot, self._terms.state
        ahead = state.q[BASE_DOFS + 1 :] + T * state.v[BASE_DOFS:]
        nominal = self.nominal[BASE_DOFS:]
        lower, upper = working_range(robot)
        slack = np.concatenate((upper - ahead, ahead - lower))
        slack *= 2.0 / (T * T)
        np.maximum(slack, -_RANGE_BRAKE, out=slack)
        n = len(nominal)
        slack[:n] -= nominal
        slack[n:] += nominal
        return slack

    def _joint_range_rows(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows on y, and their bounds, for the joints near a stop; the other joints cannot meet theirs."""
        slack = self._joint_range_slack()
        near = (slack < _RANGE_NEAR).nonzero()[0]
        n = len(slack) // 2
        rows = self.response.take(BASE_DOFS + near % n, axis=0)
        rows[near >= n] *= -1.0
        return rows, slack.take(near)


@lru_cache(maxsize=16)
def _force_weights(n: int) -> np.ndarray:
    return np.full(n, _FORCE_WEIGHT)


def motion_qp(
    robot: RobotDescription,
    terms: DynamicsTerms,
    response: AccelerationResponse,
    weights: np.ndarray,
    support: SupportGeometry,
    contacts: ContactModel,
    *,
    ankle_torques: dict[int, float] | None = None,
    force_rows: np.ndarray | None = None,
    joint_ranges: bool = True,
    expect_active: bool = False,
) -> MotionQP:
    """The soft form: the nearest motion that contacts, motors and joints allow.

    Equation: (17)

    Args:
        robot: limits.
        terms: dynamics at the state.
        response: q'' wanted, and the factors of H.
        weights: of the rows of kappa'' (n,).
        support: stance feet.
        contacts: their forces.
        ankle_torques: velocity index -> torque [N m] that the ankle law has decided.
        force_rows: further rows (k, 3 n) on the corner forces, rows @ forces <= 0 (the capture guard).
        joint_ranges: whether the joints have rows of their ranges. The stance feet's rows of kappa'' say that a sole
            stays as it lies: an ankle at its stop then holds the whole leg, where a real sole rolls on its stone.
        expect_active: an inequality was active in the last tick, so one will be in this: no closed form is tried.
    """
    layout = _layout(support.stance, tuple(ankle_torques or ()), robot.dofs)
    return MotionQP(
        robot, terms, response, weights, contacts, layout, ankle_torques, force_rows, joint_ranges, expect_active
    )


@record
class _Layout:
    """Which rows are what for one set of stance feet and given torques."""

    free: np.ndarray  # rows of kappa'' that are variables
    order: np.ndarray  # generalized forces, the prescribed ones first
    prescribed: np.ndarray  # those
    given: np.ndarray  # joints whose torque is prescribed
    limited: np.ndarray  # joints whose torque is limited


@lru_cache(maxsize=32)
def _layout(stance: tuple[int, ...], given: tuple[int, ...], dofs: int) -> _Layout:
    held = np.concatenate([np.r_[FOOT_ROWS[i]] for i in stance])
    free = np.setdiff1d(np.arange(dofs), held)
    prescribed = [*range(BASE_DOFS), *given]
    others = [dof for dof in range(BASE_DOFS, dofs) if dof not in given]
    given_joints = np.array(given, dtype=int) - BASE_DOFS
    return _Layout(
        free, np.array(prescribed + others), np.array(prescribed), given_joints, np.array(others) - BASE_DOFS
    )
