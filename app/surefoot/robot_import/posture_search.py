"""A posture to stand in within ranges and torque limits: the one nearest to where a robot would stand by rule.

A nonlinear program, solved by SLSQP (SciPy) from the posture by rule: over the step x from there (tangent space),

    minimise    1/2 |x|^2 + w s^2
    subject to  stance feet where they stand by rule; a foot in the air level, not lower and not nearer to the other
                G above the stance sole, as far inside its edges as ``COM_INSIDE`` says
                the base leans and turns by no more than ``LEAN_RAD`` each way
                joints inside their ranges by ``RANGE_MARGIN``
                |torques| <= (TORQUE_SHARE + s) limits,  s >= 0

with w so great that s vanishes where it can. Where it cannot, the joint with the greatest share stands in the way.
"""

from collections.abc import Callable

import numpy as np
from scipy.optimize import linprog, minimize

from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import DynamicsTerms
from surefoot.geometry.polygon import ConvexPolygon, convex_hull
from surefoot.geometry.rotations import rotation_vector
from surefoot.robot.description import BASE_DOFS, RobotState
from surefoot.task.reference import TaskReference

TORQUE_SHARE = 0.9  # of a limit
RANGE_MARGIN = 0.02  # of a range, at either end
LEAN_RAD = 0.25
COM_INSIDE = 0.6  # of the distance that the innermost point of the stance sole has to its nearest edge
_SLACK_WEIGHT = 1e3
_DIFFERENCE = 1e-6  # m or rad
_ITERATIONS = 100
_PRECISION = 1e-9
_EXACT = 1e-6  # m or rad: what a place may be off where the search ends


class StanceSearch:
    """The program for one support.

    Args:
        dynamics: of the robot.
        reference: the standing posture by rule: where the stance feet stand, soles level.
        start: (7 + joints,) configuration to stay near to.
        held: velocity indices of joints that stay as they are there.
    """

    def __init__(
        self, dynamics: DynamicsModel, reference: TaskReference, start: np.ndarray, held: frozenset[int]
    ) -> None:
        self._dynamics, self._reference, self._start = dynamics, reference, start
        self._stance = reference.support.stance
        robot = dynamics.robot
        margin = RANGE_MARGIN * (robot.joint_upper - robot.joint_lower)
        self._low, self._high = robot.joint_lower + margin - start[7:], robot.joint_upper - margin - start[7:]
        for dof in held:
            self._low[dof - BASE_DOFS] = self._high[dof - BASE_DOFS] = 0.0
        corners = [reference.position_ankles[i] + robot.feet[i].corners_from_ankle for i in self._stance]
        self._sole = convex_hull(np.vstack(corners)[:, :2].tolist())
        self._inside = COM_INSIDE * _inradius(self._sole)

    def find(self) -> np.ndarray | None:
        """The configuration (7 + joints,), whatever its torques; None: no posture has level soles and G above them."""
        joints = np.clip(0.0, self._low, self._high)
        x = np.concatenate((np.zeros(BASE_DOFS), joints, [0.0]))
        x[-1] = max(0.0, float(np.abs(self.shares(x[:-1])).max()) - TORQUE_SHARE)
        bounds = [*[(None, None)] * BASE_DOFS, *zip(self._low.tolist(), self._high.tolist(), strict=True), (0.0, None)]
        found = minimize(
            lambda x: 0.5 * float(x[:-1].dot(x[:-1])) + _SLACK_WEIGHT * float(x[-1] ** 2),
            x,
            jac=lambda x: np.append(x[:-1], 2.0 * _SLACK_WEIGHT * x[-1]),
            method="SLSQP",
            bounds=bounds,
            constraints=[
                {"type": "eq", "fun": self._feet, "jac": lambda x: _differences(self._feet, x)},
                {"type": "ineq", "fun": self._room, "jac": lambda x: _differences(self._room, x)},
            ],
            options={"maxiter": _ITERATIONS, "ftol": _PRECISION},
        )
        step = found.x[:-1]
        if not np.isfinite(step).all():
            return None
        off = max(float(np.abs(self._feet(found.x)).max()), -float(self._places(self._terms(step)).min()))
        return self._dynamics.integrate(self._start, step) if off < _EXACT else None

    def shares(self, step: np.ndarray) -> np.ndarray:
        """Of every joint's torque limit what gravity asks for (joints,) after a tangent step from the start.

        On one foot the ground's wrench is the one that carries the base; on two feet, of all that do, the one with the
        least sum of squares of the shares.
        """
        return self._shares(self._terms(step))

    def _shares(self, terms: DynamicsTerms) -> np.ndarray:
        jacobian = np.vstack([terms.feet[i].jacobian for i in self._stance])
        limits, bias = self._dynamics.robot.torque_limits, terms.bias
        base, joints = jacobian[:, :BASE_DOFS].T, jacobian[:, BASE_DOFS:].T / limits[:, None]
        wrench = np.linalg.lstsq(base, bias[:BASE_DOFS], rcond=None)[0]
        shares = bias[BASE_DOFS:] / limits - joints.dot(wrench)
        inner = joints.dot(np.linalg.svd(base)[2][BASE_DOFS:].T)  # wrenches that only press the feet against each other
        return shares - inner.dot(np.linalg.lstsq(inner, shares, rcond=None)[0])

    def _terms(self, step: np.ndarray) -> DynamicsTerms:
        q = self._dynamics.integrate(self._start, step)
        return self._dynamics.evaluate(RobotState(q, np.zeros(len(step))))

    def _feet(self, x: np.ndarray) -> np.ndarray:
        """Zero where the stance feet are where they belong, and the other sole is turned as it should be."""
        terms, wanted, found = self._terms(x[:-1]), self._reference, []
        for i, foot in enumerate(terms.feet):
            if i in self._stance:
                found.append(foot.position_ankle_in_world - wanted.position_ankles[i])
            found.append(rotation_vector(foot.rotation_foot_to_world.dot(wanted.rotation_feet_to_world[i].T)))
        return np.concatenate(found)

    def _room(self, x: np.ndarray) -> np.ndarray:
        """Not negative where the torques and all places are as they should be."""
        terms, most = self._terms(x[:-1]), TORQUE_SHARE + x[-1]
        shares = self._shares(terms)
        return np.concatenate((most - shares, most + shares, self._places(terms)))

    def _places(self, terms: DynamicsTerms) -> np.ndarray:
        """Not negative where G is inside the sole, the base upright, a foot in the air as high and far as by rule."""
        rotation = terms.rotation_pelvis_to_world
        lean = np.append(rotation[:2, 2], rotation[1, 0])  # of its z axis, and the turn of its x axis
        found = [np.sin(LEAN_RAD) - lean, np.sin(LEAN_RAD) + lean]
        found += [self._sole.offsets - self._sole.normals.dot(terms.position_com_in_world[:2]) - self._inside]
        for i in {0, 1}.difference(self._stance):
            moved = terms.feet[i].position_ankle_in_world - self._reference.position_ankles[i]
            found.append(np.array((moved[1] * (1.0 if i == 0 else -1.0), moved[2])))
        return np.concatenate(found)


def _inradius(polygon: ConvexPolygon) -> float:
    """Distance from the innermost point to the nearest edge [m]."""
    rows = np.column_stack((polygon.normals, np.ones(len(polygon.offsets))))
    return float(linprog((0.0, 0.0, -1.0), A_ub=rows, b_ub=polygon.offsets, bounds=[(None, None)] * 3).x[2])


def _differences(function: Callable[[np.ndarray], np.ndarray], x: np.ndarray) -> np.ndarray:
    """Jacobian by forward differences."""
    at = function(x)
    return np.column_stack([(function(x + step) - at) / _DIFFERENCE for step in _DIFFERENCE * np.eye(len(x))])
