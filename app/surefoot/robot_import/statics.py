"""Standing still on two feet and on one: torques that gravity asks for, places of the joints in their ranges."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
from scipy.optimize import linprog

from surefoot.record import record
from surefoot.robot_import.problem import Problem
from surefoot.robot_import.sole import Sole
from surefoot.robot_import.task_jacobian import StandingTarget, TaskKinematics, yaw_only

FRICTION = 0.6  # of the ground in this check
_LIFT = 0.05  # of the ankle of the swing foot, as a share of the CoM's height
_SWING_SPREAD = 0.75  # sideways distance of the swing foot, as a share of that on two feet
_HEIGHTS = (1.0, 0.98, 0.96, 0.94, 0.92, 0.9)  # of the CoM on one foot, as shares of that on two feet
_BOTH, _FEET = "two feet", ("left foot", "right foot")


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
    """

    support: str
    reached: bool
    qpos: np.ndarray | None = None
    com_height_m: float = float("nan")
    condition: float = float("inf")
    torque: Load | None = None
    range: Load | None = None

    @property
    def worst_percent(self) -> float:
        """The greatest share of a torque limit or a range."""
        return max((load.percent for load in (self.torque, self.range) if load is not None), default=float("inf"))


def stand(
    kinematics: TaskKinematics, posture: np.ndarray, soles: tuple[Sole, Sole], limits_nm: Mapping[str, float]
) -> list[Statics]:
    """Stand on two feet, on the left and on the right one.

    The soles are level, the base is upright as in the posture, the CoM is above the middle of the soles that stand;
    joints in no leg stay where they are. On two feet the CoM is as high as in the posture; on one foot that of some
    heights is taken which asks least of torques and ranges.

    Args:
        kinematics: of the robot.
        posture: configuration (nq,) to start from.
        soles: of the feet.
        limits_nm: joint name -> torque limit.
    """
    target = _two_feet(kinematics, posture, soles)
    both = kinematics.solve(posture, target)
    found = [_stand(kinematics, both, (0, 1), soles, limits_nm)]
    start = posture if both is None else both
    for stance in (0, 1):
        lower = [_one_foot(target, stance, soles, height) for height in _HEIGHTS]
        stands = [_stand(kinematics, kinematics.solve(start, place), (stance,), soles, limits_nm) for place in lower]
        found.append(min(stands, key=lambda statics: statics.worst_percent))
    return found


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
            )
            remedy = "a more upright posture (keyframe, [posture]), or the true limit in [torque_limits]"
            problems.append(Problem("statics", reason, remedy))
        if (load := statics.range) is not None and load.percent > 100.0:
            reason = (
                f"{statics.support}: {load.joint} stands at {load.amount:.3f} rad, {load.percent:.0f} % of its range"
            )
            remedy = "another posture (the joints in no leg move the CoM), or the true range in the MJCF"
            problems.append(Problem("statics", reason, remedy))
    return problems


def _two_feet(kinematics: TaskKinematics, posture: np.ndarray, soles: tuple[Sole, Sole]) -> StandingTarget:
    """Feet level and side by side, as far apart as in the posture."""
    kinematics.move(posture)
    feet = kinematics.feet()
    base = kinematics.base_rotation()
    heading = yaw_only(base)
    bottom = min(foot.ankle[2] - sole.ankle_height_m for foot, sole in zip(feet, soles, strict=True))
    middle, apart = 0.5 * (feet[0].ankle + feet[1].ankle), feet[0].ankle - feet[1].ankle
    half = 0.5 * heading[:, 1] * abs(float(apart @ heading[:, 1]))
    places = []
    for sign, sole in zip((1.0, -1.0), soles, strict=True):
        place = middle + sign * half
        place[2] = bottom + sole.ankle_height_m
        places.append(place)
    turned = (yaw_only(feet[0].rotation), yaw_only(feet[1].rotation))
    com = kinematics.com()
    centres = [_centre(place, turn, sole) for place, turn, sole in zip(places, turned, soles, strict=True)]
    com[:2] = 0.5 * (centres[0] + centres[1])[:2]
    return StandingTarget(com, base, (places[0], places[1]), turned, kinematics.upper_angles())


def _one_foot(target: StandingTarget, stance: int, soles: tuple[Sole, Sole], height: float) -> StandingTarget:
    """The CoM above one sole, the other foot lifted and nearer: the base has moved towards the stance foot."""
    ankles = [ankle.copy() for ankle in target.ankles]
    com = target.com.copy()
    com[:2] = _centre(ankles[stance], target.feet[stance], soles[stance])[:2]
    ground = ankles[stance][2] - soles[stance].ankle_height_m
    com[2] = ground + height * (com[2] - ground)
    ankles[1 - stance] = ankles[stance] + _SWING_SPREAD * (ankles[1 - stance] - ankles[stance])
    ankles[1 - stance][2] = ground + soles[1 - stance].ankle_height_m + _LIFT * (com[2] - ground)
    return StandingTarget(com, target.base, (ankles[0], ankles[1]), target.feet, target.upper)


def _centre(ankle: np.ndarray, rotation: np.ndarray, sole: Sole) -> np.ndarray:
    return ankle + rotation @ np.append(sole.outline.centroid, -sole.ankle_height_m)


def _stand(
    kinematics: TaskKinematics,
    qpos: np.ndarray | None,
    stance: tuple[int, ...],
    soles: tuple[Sole, Sole],
    limits_nm: Mapping[str, float],
) -> Statics:
    support = _BOTH if len(stance) == 2 else _FEET[stance[0]]
    if qpos is None:
        return Statics(support, False)
    kinematics.move(qpos)
    condition = float(np.linalg.cond(kinematics.jacobian()))
    foot = kinematics.feet()[stance[0]]
    height = float(kinematics.com()[2] - foot.ankle[2] + soles[stance[0]].ankle_height_m)
    torques = _torques(kinematics, stance, soles, limits_nm)
    if torques is None:
        return Statics(support, False, qpos, height, condition)
    loads = [
        Load(name, 100.0 * abs(torque) / limits_nm[name], torque)
        for name, torque in torques.items()
        if name in limits_nm
    ]
    ranges = _ranges(kinematics.model, qpos)
    return Statics(
        support,
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

    bias = S^T tau + sum J_c^T f_c; f_c at each corner within a friction pyramid. On one foot the torques follow from
    the base's six rows alone; on two feet the inner forces are chosen by a linear program.
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
    gravity = data.qfrc_bias
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
