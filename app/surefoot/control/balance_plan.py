"""The reference planner: delta_P^ref(t) and zeta_ref(t) of any reference, checked before anything moves.

This is the paper's second future work, "a scheme to make the calculation of the reference values of delta_P in function
of the reference trajectory, straightforwardly".
"""

from dataclasses import dataclass, replace

import numpy as np

from surefoot.control.balance.support import support_geometry
from surefoot.control.task_acceleration import acceleration_response
from surefoot.dynamics.model import DynamicsModel
from surefoot.momentum.delta import delta_about, momentum_rate
from surefoot.momentum.zmp import zmp_components
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FULLY_LOADED
from surefoot.task.posture import solve_posture
from surefoot.task.reference import Reference, TaskReference

_NO_BIAS = np.zeros(2)


@dataclass(frozen=True, slots=True)
class ZMPExit:
    """Where a planned ZMP first leaves the support polygon: when, over which edge, and how far at the worst."""

    time_s: float
    edge: str
    worst_m: float


@dataclass(frozen=True, eq=False)
class BalancePlan:
    """What a reference asks of the ground.

    Attributes:
        time_s: (n,).
        delta_p_in_world: (n, 3) delta_P^ref about the support frame's origin [N m].
        zmp_in_world: (n, 2) zeta_ref as a place [m].
        margin_m: (n,) signed distance to the true support polygon's edge.
        exit: where it first leaves the polygon, or None.
    """

    time_s: np.ndarray
    delta_p_in_world: np.ndarray
    zmp_in_world: np.ndarray
    margin_m: np.ndarray
    exit: ZMPExit | None


def plan_balance(
    dynamics: DynamicsModel, reference: Reference, times_s: np.ndarray, *, margin_scale: float = 1.0
) -> BalancePlan:
    """delta_P and ZMP of a reference followed exactly.

    At every time kappa_d is inverted (posture, then v = H^-1 kappa_d', q'' = H^-1 (kappa_d'' - h)) and the whole body's
    momentum rate taken: no point mass is assumed.

    Args:
        dynamics: the robot's.
        reference: wanted kappa.
        times_s: (n,) [s], ascending.
        margin_scale: the polygon is scaled by this about its centroid before the check.

    Raises:
        PostureError: the reference cannot be reached at some time.
    """
    rows, exit_found = [], None
    for time_s in times_s.tolist():
        wanted = reference.at(time_s)
        q = solve_posture(dynamics, wanted).q
        still = dynamics.evaluate(RobotState(q, np.zeros(len(wanted.velocity))))
        v = np.linalg.solve(still.output_jacobian, wanted.velocity)
        terms = dynamics.evaluate(RobotState(q, v, time_s))
        rate = momentum_rate(terms, acceleration_response(terms, wanted.acceleration).acceleration)
        support = support_geometry(dynamics.robot, terms, wanted.support, FULLY_LOADED)
        delta = delta_about(support.origin, terms.position_com_in_world, rate)
        lever, weight = terms.position_com_in_world - support.origin, terms.mass_kg * terms.gravity
        zmp = zmp_components(lever, delta, _NO_BIAS, weight, rate.normal_force).dot(support.axes)
        polygon = support.polygon.scaled(margin_scale) if margin_scale != 1.0 else support.polygon
        distances = polygon.offsets - polygon.normals.dot(zmp)
        margin = float(distances.min())
        if margin < 0.0 and exit_found is None:
            normal = polygon.normals[int(distances.argmin())]
            exit_found = (time_s, edge_name(normal, wanted.support))
        rows.append((delta, support.to_world(zmp), margin))
    margins = np.array([row[2] for row in rows])
    leaving = ZMPExit(*exit_found, worst_m=-float(margins.min())) if exit_found else None
    return BalancePlan(
        times_s, np.array([row[0] for row in rows]), np.array([row[1] for row in rows]), margins, leaving
    )


def edge_name(normal: np.ndarray, support: Support) -> str:
    """The edge with this outward normal (2,), support frame, in words."""
    if abs(float(normal[0])) > abs(float(normal[1])):
        return "toe" if normal[0] > 0.0 else "heel"
    left = normal[1] > 0.0
    if support is Support.DOUBLE:
        return "left" if left else "right"
    return "outer" if left == (support is Support.LEFT) else "inner"


@dataclass(frozen=True, eq=False)
class PlannedReference:
    """A reference that carries its planned ZMP, for feed-forward.

    Attributes:
        reference: what was planned.
        plan: its plan, equally spaced in time.
    """

    reference: Reference
    plan: BalancePlan

    def at(self, time_s: float) -> TaskReference:
        """The reference with ``zmp_in_world`` interpolated from the plan."""
        t, zmp = self.plan.time_s, self.plan.zmp_in_world
        here = np.array((np.interp(time_s, t, zmp[:, 0]), np.interp(time_s, t, zmp[:, 1])))
        return replace(self.reference.at(time_s), zmp_in_world=here)
