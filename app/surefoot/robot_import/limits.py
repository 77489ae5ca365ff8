"""Torque limits: of robot.toml, else what actuator and joint of the model let through; and which drives are servos."""

from collections.abc import Mapping, Sequence

import mujoco

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot_import.problem import Problem

_TOML = "robot.toml"


@record
class Limit:
    """Of one joint.

    Attributes:
        torque_nm: largest torque either way.
        source: ``robot.toml``, ``joint actuatorfrcrange``, a URDF's effort, ``actuator forcerange`` or
            ``motor ctrlrange``.
    """

    torque_nm: float
    source: str


@record
class Drives:
    """What drives the joints.

    Attributes:
        limits: joint name -> limit, of the joints that have one.
        servos: joint name -> whether the servo damps by itself (kv), of the joints with a position or speed actuator.
        undriven: joints without an actuator.
        uneven: joints whose limits differ by direction; the smaller is taken.
    """

    limits: dict[str, Limit]
    servos: dict[str, bool]
    undriven: list[str]
    uneven: list[str]

    def stands_in(self, name: str) -> bool:
        """Whether a joint's damping stands in for a servo's rate gain: it is taken out with the servo."""
        return self.servos.get(name) is False


def read_drives(
    model: mujoco.MjModel, joints: Sequence[str], said: Mapping[str, float], effort: str = "joint actuatorfrcrange"
) -> Drives:
    """The drives of the joints.

    Args:
        model: as its owner wrote it.
        joints: names of the hinges that are kept.
        said: joint name -> limit in robot.toml [N m].
        effort: what the file calls a limit of the joint itself.

    Raises:
        InvalidInput: robot.toml limits a joint that is not there.
    """
    for name, value in said.items():
        if name not in joints:
            raise InvalidInput(f"torque_limits.{name}", value, "the robot has no such joint", joints)
    drives = Drives({}, {}, [], [])
    for name in joints:
        _read_joint(drives, model, name, effort)
        if name in said:
            drives.limits[name] = Limit(said[name], _TOML)
    return drives


def limit_problems(drives: Drives, joints: Sequence[str]) -> list[Problem]:
    """Joints that nothing limits."""
    missing = [name for name in joints if name not in drives.limits]
    if not missing:
        return []
    example = missing[0]
    reason = f"{len(missing)} of {len(joints)} joints have no torque limit: {', '.join(missing)}"
    return [Problem("limits", reason, f"say them in robot.toml: [torque_limits] {example} = ... (N m), or freeze them")]


def _read_joint(drives: Drives, model: mujoco.MjModel, name: str, effort: str) -> None:
    joint = model.joint(name).id
    lower, upper, sources = 0.0, 0.0, []
    actuators = [a for a in range(model.nu) if _drives(model, a, joint)]
    for actuator in actuators:
        if model.actuator_biastype[actuator] != mujoco.mjtBias.mjBIAS_NONE:
            drives.servos[name] = bool(model.actuator_biasprm[actuator][2])
        bounds = [_scaled(model, actuator, "force"), _scaled(model, actuator, "ctrl")]
        known = [bound for bound in bounds if bound is not None]
        if not known:
            lower, upper, sources = -float("inf"), float("inf"), []
            break
        lower += max(bound[0] for bound, _ in known)
        upper += min(bound[1] for bound, _ in known)
        sources.append(min(known, key=lambda known_one: known_one[0][1])[1])
    if not actuators:
        drives.undriven.append(name)
        lower, upper = -float("inf"), float("inf")
    if model.jnt_actfrclimited[joint]:
        low, high = model.jnt_actfrcrange[joint]
        if low > lower or high < upper:
            lower, upper, sources = max(low, lower), min(high, upper), [effort]
    torque = min(-lower, upper)
    if 0.0 < torque < float("inf"):
        drives.limits[name] = Limit(float(torque), sources[0])
        if abs(lower + upper) > 1e-9:
            drives.uneven.append(name)


def _drives(model: mujoco.MjModel, actuator: int, joint: int) -> bool:
    kind = mujoco.mjtTrn(model.actuator_trntype[actuator])
    by_joint = kind in (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
    return by_joint and int(model.actuator_trnid[actuator][0]) == joint


def _scaled(model: mujoco.MjModel, actuator: int, what: str) -> tuple[tuple[float, float], str] | None:
    """Torque range that the force range, or the control range of a motor, lets through the gear; None: unlimited."""
    gear = float(model.actuator_gear[actuator][0])
    if what == "force":
        limited, bounds, source = model.actuator_forcelimited, model.actuator_forcerange, "actuator forcerange"
    elif model.actuator_biastype[actuator] == mujoco.mjtBias.mjBIAS_NONE:
        limited, bounds, source = model.actuator_ctrllimited, model.actuator_ctrlrange, "motor ctrlrange"
        gear *= float(model.actuator_gainprm[actuator][0])
    else:
        return None
    if not limited[actuator]:
        return None
    ends = sorted(gear * float(bound) for bound in bounds[actuator])
    return (ends[0], ends[1]), source
