"""Standing still on two feet and on one: torques that gravity asks for, places of the joints in their ranges."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import mujoco
import numpy as np
from scipy.optimize import linprog

from surefoot.dynamics.model import DynamicsModel
from surefoot.errors import PostureError
from surefoot.record import record
from surefoot.robot.feet import Support
from surefoot.robot_import.describe import describe
from surefoot.robot_import.inspection import Robot
from surefoot.robot_import.problem import Problem
from surefoot.robot_import.sole import Sole
from surefoot.robot_import.stances import ByRule, with_stances
from surefoot.robot_import.task_jacobian import TaskKinematics
from surefoot.task.posture import solve_posture, standing_reference

FRICTION = 0.6  # of the ground in this check
AT_LIMIT_PERCENT = 95.0  # from here on there is next to nothing left to balance with
_ROUNDING = 1e-6  # percent of a range: a joint may stand at its end
_NAMES = {Support.DOUBLE: "two feet", Support.LEFT: "left foot", Support.RIGHT: "right foot"}


@record
class Load:
    """Of one joint, in percent.

    Attributes:
        joint: its name.
        percent: of its torque limit, or of the way from the middle to the end of its range.
        amount: the torque [N m] or the angle [rad].
    """

    joint: str
    percent: float
    amount: float


@record
class Statics:
    """Standing still on one support.

    Attributes:
        support: ``two feet``, ``left foot`` or ``right foot``.
        reached: whether there is such a posture with the CoM above the soles.
        qpos: configuration (nq,) of the plain MJCF; None where there is none.
        com_height_m: above the ground there.
        condition: of H there.
        torque: the joint with the greatest share of its limit.
        range: the joint nearest to the end of its range, or furthest beyond it.
        by_rule: what is wrong with the posture by rule; None: nothing, and it is that posture.
        is_found: whether it is a posture that was looked for.
    """

    support: str
    reached: bool
    qpos: np.ndarray | None = None
    com_height_m: float = float("nan")
    condition: float = float("inf")
    torque: Load | None = None
    range: Load | None = None
    by_rule: ByRule | None = None
    is_found: bool = False


@record
class AtLimit:
    """A joint that standing still on one foot leaves next to nothing of.

    Attributes:
        support: which foot.
        load: the joint and its percent, ``AT_LIMIT_PERCENT`` or more.
        of: ``torque limit`` or ``range``.
    """

    support: str
    load: Load
    of: str


def stand(robot: Robot) -> list[Statics]:
    """Stand on two feet, on the left and on the right one, as the controllers' scenarios begin.

    The soles are level, the CoM is above them, joints in no leg stay where they are (``task.posture``); torques, ranges
    and cond(H) are MuJoCo's. Everything up to the soles must have been found.
    """
    assert robot.feet is not None and robot.soles is not None and robot.legs is not None
    kinematics = TaskKinematics(robot.tree, (robot.feet[0].body, robot.feet[1].body), robot.soles, robot.legs)
    limits = {name: limit.torque_nm for name, limit in robot.drives.limits.items()}
    description, why = with_stances(describe(robot), robot.said)
    dynamics = DynamicsModel(description)
    found = []
    for support in (Support.DOUBLE, Support.LEFT, Support.RIGHT):
        try:
            q = solve_posture(dynamics, standing_reference(description, support)).q
        except PostureError:
            found.append(Statics(_NAMES[support], False, by_rule=why.get(support)))
        else:
            qpos = np.concatenate((q[:3], q[6:7], q[3:6], q[7:]))  # Pinocchio's quaternion ends with w, MuJoCo's begins
            statics = _stand(kinematics, qpos, support, robot.soles, limits)
            found.append(replace(statics, by_rule=why.get(support), is_found=support in description.stances))
    return found


def at_limit(found: Sequence[Statics]) -> list[AtLimit]:
    """On one foot, who stands at the limit of torque or range though gravity alone is borne; the worst first."""
    loads = [
        AtLimit(statics.support, load, of)
        for statics in found
        for load, of in ((statics.torque, "torque limit"), (statics.range, "range"))
        if statics.support != _NAMES[Support.DOUBLE] and load is not None and load.percent >= AT_LIMIT_PERCENT
    ]
    return sorted(loads, key=lambda one: -one.load.percent)


def statics_problems(found: Sequence[Statics]) -> list[Problem]:
    """Supports that gravity alone, or the joint ranges, do not allow."""
    problems = []
    for statics in found:
        if not statics.reached:
            reason = f"{statics.support}: no posture with level soles and the CoM above them was found"
            problems.append(Problem("statics", reason, "give a posture with bent knees: keyframe or [posture]"))
        if (load := statics.torque) is not None and load.percent > 100.0:
            reason = (
                f"{statics.support}: {load.joint} needs {abs(load.amount):.1f} N m, {load.percent:.0f} % of its limit"
                f"{statics.by_rule.remains if statics.by_rule else ''}"
            )
            remedy = "the true limit in [torque_limits], or other joints in no leg to lean with ([posture])"
            problems.append(Problem("statics", reason, remedy))
        if (load := statics.range) is not None and load.percent > 100.0 + _ROUNDING:
            reason = (
                f"{statics.support}: {load.joint} stands at {load.amount:.3f} rad, {load.percent:.0f} % of its range"
                f"{statics.by_rule.remains if statics.by_rule else ''}"
            )
            remedy = "the true range in the MJCF, or other joints in no leg to lean with ([posture])"
            problems.append(Problem("statics", reason, remedy))
    return problems


def _stand(
    kinematics: TaskKinematics,
    qpos: np.ndarray,
    support: Support,
    soles: tuple[Sole, Sole],
    limits_nm: Mapping[str, float],
) -> Statics:
    kinematics.move(qpos)
    condition = float(np.linalg.cond(kinematics.jacobian()))
    stance, name = support.stance, _NAMES[support]
    foot = kinematics.feet()[stance[0]]
    height = float(kinematics.com()[2] - foot.ankle[2] + soles[stance[0]].ankle_height_m)
    torques = _torques(kinematics, stance, soles, limits_nm)
    if torques is None:
        return Statics(name, False, qpos, height, condition)
    loads = [
        Load(name, 100.0 * abs(torque) / limits_nm[name], torque)
        for name, torque in torques.items()
        if name in limits_nm
    ]
    ranges = _ranges(kinematics.model, qpos)
    return Statics(
        name,
        True,
        qpos,
        height,
        condition,
        max(loads, key=lambda load: load.percent, default=None),
        max(ranges, key=lambda load: load.percent, default=None),
    )


def _torques(
    kinematics: TaskKinematics, stance: tuple[int, ...], soles: tuple[Sole, Sole], limits_nm: Mapping[str, float]
) -> dict[str, float] | None:
    """Joint torques [N m] with the least share of their limits, None: no forces at the soles' corners carry the weight.

    G - springs' torques = S^T tau + sum J_c^T f_c; f_c at each corner within a friction pyramid. On one foot the
    torques follow from the base's six rows alone; on two feet the inner forces are chosen by a linear program.
    """
    model, data = kinematics.model, kinematics.data
    columns = []
    for index in stance:
        foot, sole = kinematics.feet()[index], soles[index]
        jacobian = kinematics.foot_jacobian(index)
        for corner in sole.outline.vertices:
            arm = foot.rotation @ np.append(corner, -sole.ankle_height_m)
            for direction in _pyramid(foot.rotation):
                columns.append(jacobian.T @ np.concatenate((direction, np.cross(arm, direction))))
    forces = np.column_stack(columns)
    hinges = [joint for joint in range(model.njnt) if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE]
    names = [model.joint(joint).name for joint in hinges]
    dofs = [int(model.jnt_dofadr[joint]) for joint in hinges]
    base = [dof for dof in range(model.nv) if dof not in dofs]
    limits = np.array([limits_nm.get(name, np.inf) for name in names])
    known = np.isfinite(limits)
    gravity = data.qfrc_bias - data.qfrc_spring
    # variables: weights of the pyramids' edges, and the largest share t of a limit
    share = (forces[dofs] / limits[:, None])[known]
    own = (gravity[dofs] / limits)[known]
    ones = -np.ones((len(own), 1))
    solved = linprog(
        np.append(np.zeros(forces.shape[1]), 1.0),
        A_ub=np.vstack((np.hstack((share, ones)), np.hstack((-share, ones)))),
        b_ub=np.concatenate((own, -own)),
        A_eq=np.hstack((forces[base], np.zeros((len(base), 1)))),
        b_eq=gravity[base],
    )
    if solved.status != 0:
        return None
    return dict(zip(names, (gravity[dofs] - forces[dofs] @ solved.x[:-1]).tolist(), strict=True))


def _pyramid(rotation: np.ndarray) -> list[np.ndarray]:
    """Edges of the friction pyramid, in world."""
    x, y, normal = rotation.T
    return [normal + FRICTION * side for side in (x, -x, y, -y)]


def _ranges(model: mujoco.MjModel, qpos: np.ndarray) -> list[Load]:
    loads = []
    for joint in range(model.njnt):
        if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_HINGE:
            continue
        lower, upper = model.jnt_range[joint]
        angle = float(qpos[model.jnt_qposadr[joint]])
        percent = 100.0 * abs(angle - 0.5 * (lower + upper)) / (0.5 * (upper - lower))
        loads.append(Load(model.joint(joint).name, float(percent), angle))
    return loads
