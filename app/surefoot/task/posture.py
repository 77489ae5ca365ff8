"""Postures: joint angles that realise a kappa, by Newton's method on the diffeomorphism."""

from dataclasses import dataclass

import numpy as np

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.feet import Support
from surefoot.task.reference import TaskReference, task_error

_FOOT_SPREAD = 0.11  # m, half the distance between the ankles in double support (the hips' own half-width)
_SWING_SPREAD = 0.09  # m, the swing foot is a little closer in, so that its hip stays in range
_SWING_LIFT = 0.04  # m
_COM_FORWARD = 0.02  # m ahead of the ankle line
_PELVIS_ROLL = 0.05  # rad, the pelvis drops on the swing side: keeps both hip frontals in range
DEFAULT_COM_HEIGHT = 0.975


def standing_reference(
    robot: RobotDescription, support: Support, com_height: float | None = None, ground: np.ndarray | None = None
) -> TaskReference:
    """The standing posture for a support as a reference: feet level, trunk straight, world origin between the feet.

    Chosen so that every joint keeps inside its published range. On a slope the feet are flat on it, the trunk stays
    upright and the CoM as far ahead of and above the stance soles; how steep it may be, the joint ranges say.

    Args:
        robot: whose legs they are.
        support: which feet stand.
        com_height: CoM height above the ground [m]; None for 0.975.
        ground: ground axes to world (3, 3), turned about ``ground_pivot``; None for level ground.
    """
    com = np.array((_COM_FORWARD, 0.0, DEFAULT_COM_HEIGHT if com_height is None else com_height))
    heights = [foot.ankle_height_m for foot in robot.feet]
    left, right = np.array((0.0, _FOOT_SPREAD, heights[0])), np.array((0.0, -_FOOT_SPREAD, heights[1]))
    roll = 0.0
    if support is not Support.DOUBLE:
        side = 1.0 if support is Support.LEFT else -1.0
        swing = right if support is Support.LEFT else left
        swing[1], swing[2] = -side * _SWING_SPREAD, swing[2] + _SWING_LIFT
        com[1], roll = side * _FOOT_SPREAD, -side * _PELVIS_ROLL
    feet = (np.eye(3), np.eye(3))
    if ground is not None:
        pivot = _pivot((left, right), support)
        left, right = (pivot + ground.dot(ankle - pivot) for ankle in (left, right))
        feet = (ground, ground)
    zero = np.zeros(robot.dofs)
    return TaskReference(
        support=support,
        position_com=com,
        rotation_pelvis_to_world=rotation_from_rpy(roll, 0.0, 0.0),
        position_ankles=(left, right),
        rotation_feet_to_world=feet,
        upper_rad=np.zeros(len(robot.upper)),
        velocity=zero,
        acceleration=zero,
    )


def ground_pivot(robot: RobotDescription, support: Support) -> np.ndarray:
    """The point (3,) of the ground in world [m] below the stance ankle, or midway between both: slopes turn about it.

    It is the same for level and sloped ground.
    """
    return _pivot(standing_reference(robot, support).position_ankles, support)


def _pivot(ankles: tuple[np.ndarray, np.ndarray], support: Support) -> np.ndarray:
    x, y, _ = np.mean([ankles[i] for i in support.stance], axis=0)
    return np.array((x, y, 0.0))


@dataclass(frozen=True, eq=False)
class Posture:
    """A solved posture.

    Attributes:
        q: (7 + joints,) configuration.
        out_of_range: one line for every joint outside its published range.
    """

    q: np.ndarray
    out_of_range: tuple[str, ...]


def solve_posture(dynamics: DynamicsModel, reference: TaskReference, *, tolerance: float = 1e-10) -> Posture:
    """Joint angles with kappa(q) = kappa_d.

    Raises:
        PostureError: no solution is found (the legs are too short, or fold the wrong way).
    """
    robot = dynamics.robot
    q = dynamics.neutral(reference.position_com - np.array((0.0, 0.0, 0.1)))
    for joint in robot.joints:  # start with bent knees: H is singular when they are straight
        bend = {"knee": 0.6, "hip_sagittal": -0.3, "ankle_sagittal": -0.3}
        q[joint.dof + 1] = next((angle for part, angle in bend.items() if part in joint.name), 0.0)
    residual = np.inf
    for _ in range(60):
        terms = dynamics.evaluate(RobotState(q, np.zeros(robot.dofs)))
        error = task_error(terms, reference)
        residual = float(np.abs(error).max())
        if residual < tolerance:
            return Posture(q, _out_of_range(dynamics, q))
        try:
            step = np.linalg.solve(terms.output_jacobian, -error)
        except np.linalg.LinAlgError:
            break
        longest = float(np.abs(step).max())
        q = dynamics.integrate(q, step * min(1.0, 0.3 / longest))
    raise PostureError("inverse kinematics has no solution there", residual)


def _out_of_range(dynamics: DynamicsModel, q: np.ndarray) -> tuple[str, ...]:
    return tuple(
        f"{j.name} at {q[j.dof + 1]:+.3f} rad, range {j.lower_rad:+.2f} to {j.upper_rad:+.2f}"
        for j in dynamics.robot.joints
        if not j.lower_rad - 1e-6 <= q[j.dof + 1] <= j.upper_rad + 1e-6
    )
