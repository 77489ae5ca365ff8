"""Postures: joint angles that realise a kappa, by Newton's method on the diffeomorphism."""

import math
from dataclasses import dataclass

import numpy as np

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.robot.description import BASE_DOFS, RobotDescription, RobotState
from surefoot.robot.feet import Support
from surefoot.robot.sizes import LEG_M
from surefoot.task.reference import TaskReference, task_error

# Lengths are Bip's, other robots' in proportion (``robot.sizes``). On two feet the ankles are as far apart as in the
# robot's own nominal posture.
_SWING_INWARD = 0.02  # m, the swing foot is a little closer in, so that its hip stays in range
_SWING_LIFT = 0.04  # m
_COM_FORWARD = 0.8  # of the way from the ankle line to the middle of the sole's length
_PELVIS_ROLL = 0.05  # rad, the pelvis drops on the swing side: keeps both hip frontals in range
DEFAULT_COM_HEIGHT = 0.975  # m
# Found by trial with a Unitree G1, steps of 0.17 m. With G at 0.685 m, as it stands, its knees are bent by 0.37 rad,
# and the hind leg is straight at the second step; at 0.66 m (0.74 rad) the capture point is 57 mm off at the third, at
# 0.64 m (0.94 rad) nowhere above 16 mm. 0.8 in the formula of walking_com_height comes to 0.644 m.
_WALK_KNEE_RAD = 0.8  # bend of the knees that a walk needs, in that formula


def standing_reference(
    robot: RobotDescription, support: Support, com_height: float | None = None, ground: np.ndarray | None = None
) -> TaskReference:
    """The standing posture for a support as a reference: feet level, trunk straight, world origin between the feet.

    Chosen so that every joint of Bip keeps inside its published range; who cannot stand so has ``stances`` of its own.
    On a slope the feet are flat on it, the trunk stays upright and the CoM as far ahead of and above the stance soles;
    how steep it may be, the joint ranges say.

    Args:
        robot: whose legs they are.
        support: which feet stand.
        com_height: CoM height above the ground [m]; None for ``standing_com_height``.
        ground: ground axes to world (3, 3), turned about ``ground_pivot``; None for level ground.
    """
    spread, scale = robot.sizes.foot_spread_m, robot.sizes.leg
    forward = round(_COM_FORWARD * robot.feet[0].sole_middle_m, 3)
    com = np.array((forward, 0.0, standing_com_height(robot) if com_height is None else com_height))
    heights = [foot.ankle_height_m for foot in robot.feet]
    left, right = np.array((0.0, spread, heights[0])), np.array((0.0, -spread, heights[1]))
    roll = 0.0
    if support is not Support.DOUBLE:
        side = 1.0 if support is Support.LEFT else -1.0
        swing = right if support is Support.LEFT else left
        swing[1], swing[2] = -side * (spread - _SWING_INWARD * scale), swing[2] + _SWING_LIFT * scale
        com[1], roll = side * spread, -side * _PELVIS_ROLL
    rotation, upper = rotation_from_rpy(roll, 0.0, 0.0), robot.upper_angles
    if stance := robot.stances.get(support):
        left, right = stance.position_ankles
        com = np.append(stance.position_com[:2], stance.position_com[2] if com_height is None else com_height)
        rotation, upper = stance.rotation_base_to_world, stance.upper_rad
    feet = (np.eye(3), np.eye(3))
    if ground is not None:
        pivot = _pivot((left, right), support)
        left, right = (pivot + ground.dot(ankle - pivot) for ankle in (left, right))
        feet = (ground, ground)
    zero = np.zeros(robot.dofs)
    return TaskReference(
        support=support,
        position_com=com,
        rotation_pelvis_to_world=rotation,
        position_ankles=(left, right),
        rotation_feet_to_world=feet,
        upper_rad=upper,
        velocity=zero,
        acceleration=zero,
    )


def standing_com_height(robot: RobotDescription) -> float:
    """Height of G above the ground [m] where nothing else is asked for: 0.975 for Bip."""
    return DEFAULT_COM_HEIGHT * robot.sizes.com_height


def walking_com_height(robot: RobotDescription) -> float:
    """Height of G above the ground [m] where a walk asks for nothing else.

    As it stands on two feet, in the stance that was found for it if there is one. But a robot that stands in a nominal
    posture of its own, with knees nearly straight, is carried lower by what both links of a leg lose in height when its
    knee is bent as far as a walk needs: the hind leg has to reach.
    """
    if stance := robot.stances.get(Support.DOUBLE):
        return float(stance.position_com[2])
    height = standing_com_height(robot)
    if not robot.posture_rad:
        return height
    dof, _ = robot.knees[0]
    bent = abs(float(robot.start_angles[dof - BASE_DOFS]))
    lost = math.cos(0.5 * bent) - math.cos(0.5 * max(bent, _WALK_KNEE_RAD))
    return round(height - LEG_M * robot.sizes.leg * lost, 3) if lost > 0.0 else height


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
    q = dynamics.neutral(reference.position_com - np.array((0.0, 0.0, robot.sizes.base_below_com_m)))
    q[7:] = robot.start_angles  # with bent knees: H is singular when they are straight
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
