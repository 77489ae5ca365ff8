"""What cannot be made into a tree of hinges on a free base: loops, other kinds of joints."""

import json
from collections.abc import Collection, Iterator

import mujoco

from surefoot.robot_import.mjcf_source import joint_type, name_of
from surefoot.robot_import.problem import Problem

_FREEZE = "name the joint in `frozen` of robot.toml, or give the MJCF a hinge there"
_LOOP = "describe the serial chain instead: leave out the rods and the loop, keep a motor at each hinge of the chain"


def structure_problems(model: mujoco.MjModel, bodies: Collection[int], frozen: Collection[str]) -> list[Problem]:
    """All that is in the way.

    Args:
        model: as the owner of the robot wrote it.
        bodies: those of the robot.
        frozen: names of the joints that are taken out.
    """
    return [
        *_joint_problems(model, bodies, frozen),
        *_couplings(model, frozen),
        *_loops(model, bodies),
        *_tendons(model, frozen),
    ]


def _joint_problems(model: mujoco.MjModel, bodies: Collection[int], frozen: Collection[str]) -> Iterator[Problem]:
    for body in bodies:
        if body == model.body_rootid[body]:
            continue  # whatever the base hangs on the world by, it gets a free joint in its place
        first = int(model.body_jntadr[body])
        joints = [joint for joint in range(first, first + int(model.body_jntnum[body]))]
        for joint in joints:
            name, kind = name_of(model, mujoco.mjtObj.mjOBJ_JOINT, joint), joint_type(model, joint)
            if name in frozen:
                continue
            if kind in ("ball", "slide"):
                yield Problem("joints", f"{name} is a {kind} joint; only hinges have a motor here", _FREEZE)
            elif kind == "hinge":
                if not model.joint(joint).name:
                    where = name_of(model, mujoco.mjtObj.mjOBJ_BODY, body)
                    yield Problem("joints", f"the hinge of body {where} has no name", "name it in the MJCF")
                if model.jnt_stiffnesspoly[joint].any() or model.jnt_springyield[joint] != 0.0:
                    yield Problem(
                        "joints",
                        f"the spring of {name} is not linear in the angle; only linear ones are known here",
                        "give it one number as its stiffness and no yield, or name it in `frozen` of robot.toml",
                    )


def _couplings(model: mujoco.MjModel, frozen: Collection[str]) -> list[Problem]:
    """Equalities between joints, such as a URDF's ``<mimic>``: one problem for all, whose joints can be copied."""
    coupled: dict[str, list[str]] = {}
    for equality in range(model.neq):
        if model.eq_active0[equality] and model.eq_type[equality] == mujoco.mjtEq.mjEQ_JOINT:
            ends = (int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality]))
            names = [name_of(model, mujoco.mjtObj.mjOBJ_JOINT, joint) for joint in ends if joint >= 0]
            if not all(joint in frozen for joint in names):
                coupled[name_of(model, mujoco.mjtObj.mjOBJ_EQUALITY, equality)] = names
    if not coupled:
        return []
    pairs = [" and ".join(names) for names in coupled.values()]
    reason = f"equality {next(iter(coupled))} couples the joints {pairs[0]}"
    if len(pairs) > 1:
        reason = f"{len(pairs)} equalities couple joints: {'; '.join(pairs)}"
    joints = list(dict.fromkeys(name for names in coupled.values() for name in names))
    remedy = f"freeze them in robot.toml: frozen = {json.dumps(joints)}, or take it out: each joint needs its own motor"
    return [Problem("loops", reason, remedy)]


def _loops(model: mujoco.MjModel, bodies: Collection[int]) -> Iterator[Problem]:
    for equality in range(model.neq):
        if not model.eq_active0[equality]:
            continue
        kind = mujoco.mjtEq(model.eq_type[equality])
        name = name_of(model, mujoco.mjtObj.mjOBJ_EQUALITY, equality)
        one, other = int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality])
        if kind in (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD):
            if model.eq_objtype[equality] == mujoco.mjtObj.mjOBJ_SITE:
                one, other = int(model.site_bodyid[one]), int(model.site_bodyid[other])
            if one not in bodies and other not in bodies:
                continue
            names = [name_of(model, mujoco.mjtObj.mjOBJ_BODY, body) for body in (one, other)]
            how = "joins" if kind == mujoco.mjtEq.mjEQ_CONNECT else "welds"
            yield Problem("loops", f"closed loop: equality {name} {how} the bodies {' and '.join(names)}", _LOOP)


def _tendons(model: mujoco.MjModel, frozen: Collection[str]) -> Iterator[Problem]:
    driven = {
        int(model.actuator_trnid[actuator][0])
        for actuator in range(model.nu)
        if model.actuator_trntype[actuator] == mujoco.mjtTrn.mjTRN_TENDON
    }
    for tendon in range(model.ntendon):
        name = name_of(model, mujoco.mjtObj.mjOBJ_TENDON, tendon)
        joints = _joints_of(model, tendon)
        if joints and all(joint in frozen for joint in joints):
            continue
        over = f" over {', '.join(joints)}" if joints else ""
        if tendon in driven:
            yield Problem("loops", f"an actuator pulls the tendon {name}{over}: a parallel drive", _LOOP)
        elif model.tendon_limited[tendon] or any(
            values[tendon].any() for values in (model.tendon_stiffness, model.tendon_damping, model.tendon_frictionloss)
        ):
            yield Problem("loops", f"the tendon {name}{over} couples joints by a force", _LOOP)


def _joints_of(model: mujoco.MjModel, tendon: int) -> list[str]:
    """The joints that a fixed tendon runs over."""
    first = int(model.tendon_adr[tendon])
    return [
        name_of(model, mujoco.mjtObj.mjOBJ_JOINT, int(model.wrap_objid[wrap]))
        for wrap in range(first, first + int(model.tendon_num[tendon]))
        if model.wrap_type[wrap] == mujoco.mjtWrap.mjWRAP_JOINT
    ]
