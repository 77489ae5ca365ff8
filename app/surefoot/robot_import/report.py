"""What ``surefoot robot check`` says, as one table of plain values: the JSON, and what the text is printed from."""

from pathlib import Path
from typing import Any

import numpy as np

from surefoot.robot.weight_reach import weight_reach
from surefoot.robot_import.ankles import Ankle
from surefoot.robot_import.describe import fitted
from surefoot.robot_import.foot_bodies import FootBody
from surefoot.robot_import.inspection import Inspection, Robot
from surefoot.robot_import.problem import Problem
from surefoot.robot_import.sole import Sole
from surefoot.robot_import.statics import Statics, at_limit, stand, statics_problems


def report(inspection: Inspection) -> dict[str, Any]:
    """Everything that was found; ``fit`` says whether the controllers can run the robot, ``problems`` why not.

    ``at_limit`` has the joints that have next to nothing left on one foot; such a robot is fit.
    """
    problems = list(inspection.problems)
    table: dict[str, Any] = {"file": str(inspection.path), "fit": False, "problems": []}
    if (robot := inspection.robot) is not None:
        table |= _found(robot)
        if robot.soles is not None:
            statics = stand(robot)
            problems += statics_problems(statics)
            table["statics"] = [_statics(one) for one in statics]
            table["at_limit"] = [
                {"support": one.support, "joint": one.load.joint, "percent": one.load.percent, "of": one.of}
                for one in at_limit(statics)
            ]
    table["fit"] = not problems
    table["problems"] = [_problem(problem) for problem in problems]
    return table


def _found(robot: Robot) -> dict[str, Any]:
    tree = robot.tree
    table: dict[str, Any] = {
        "mjcf": str(Path(robot.file.mjcf).resolve()),
        "joint_count": len(tree.hinges),
        "dofs": robot.model.nv,
        "mass_kg": float(robot.model.body_mass.sum()),
        "base": {"body": tree.body_name(tree.base), "how": "the body of the free joint"},
        "posture": robot.posture.how or "none",
        "agreement": _agreement(robot),
        "joints": [_joint(robot, joint) for joint in tree.hinges],
    }
    if robot.trunk is not None:
        table["trunk"] = {"body": tree.body_name(robot.trunk.body), "how": robot.trunk.how}
    if robot.legs is not None:
        legs = robot.legs
        table["legs"] = {"left": tree.joint_names(legs.left), "right": tree.joint_names(legs.right)}
        table["upper_joints"] = tree.joint_names(legs.upper)
    if robot.feet is not None:
        ankles, soles = robot.ankles or (None, None), robot.soles or (None, None)
        table["feet"] = {
            str(foot.side): _foot(robot, foot, ankle, sole)
            for foot, ankle, sole in zip(robot.feet, ankles, soles, strict=True)
        }
    fit = fitted(robot)
    return table | {"changed": fit.changed, "dropped": fit.dropped, "known": _springs(robot), "notes": _notes(robot)}


def _springs(robot: Robot) -> list[str]:
    """What the simulation does and the controllers know of: springs in joints."""
    sprung = [joint for joint in (_joint(robot, joint) for joint in robot.tree.hinges) if joint["spring_nm_rad"]]
    if not sprung:
        return []
    most = max(sprung, key=lambda joint: joint["spring_nm_rad"])
    off = max(sprung, key=lambda joint: abs(_spring_torque(joint)))
    return [
        f"springs in {len(sprung)} joints, up to {most['spring_nm_rad']:g} N m/rad ({most['name']}); "
        f"in the posture up to {abs(_spring_torque(off)):.2g} N m ({off['name']})"
    ]


def _spring_torque(joint: dict[str, Any]) -> float:
    """Of a row of the table of joints, in the posture [N m]."""
    return joint["spring_nm_rad"] * (joint["spring_rest_rad"] - joint["posture_rad"])


def _notes(robot: Robot) -> list[str]:
    """What the simulation does and the controllers do not know: dry friction, and damping that was kept."""
    notes = []
    joints = [_joint(robot, joint) for joint in robot.tree.hinges]
    if rubbing := [joint for joint in joints if joint["friction_nm"] > 0.0]:
        most = max(rubbing, key=lambda joint: joint["friction_nm"])
        share = (
            f", {100.0 * most['friction_nm'] / most['torque_limit_nm']:.0f} % of its limit"
            if most["torque_limit_nm"]
            else ""
        )
        notes.append(
            f"dry friction in {len(rubbing)} joints, up to {most['friction_nm']:g} N m ({most['name']}{share})"
        )
    if damped := [joint for joint in joints if joint["damping_nms"] > 0.0]:
        most = max(damped, key=lambda joint: joint["damping_nms"])
        notes.append(f"damping in {len(damped)} joints, up to {most['damping_nms']:g} N m s/rad ({most['name']})")
    return notes


def _agreement(robot: Robot) -> dict[str, Any]:
    found = robot.agreement
    return {
        "same_names": found.same_names,
        "dofs": {"mujoco": found.dofs[0], "pinocchio": found.dofs[1]},
        "mass_kg": {"mujoco": found.mass_kg[0], "pinocchio": found.mass_kg[1]},
        "states": found.states,
        "mass_matrix_difference": found.mass_matrix,
        "com_difference_m": found.com_m,
        "bias_difference_nm": found.bias,
    }


def _joint(robot: Robot, joint: int) -> dict[str, Any]:
    model, name = robot.model, robot.tree.joint_name(joint)
    dof, limit = int(model.jnt_dofadr[joint]), robot.drives.limits.get(name)
    return {
        "name": name,
        "lower_rad": float(model.jnt_range[joint][0]),
        "upper_rad": float(model.jnt_range[joint][1]),
        "posture_rad": float(robot.posture.qpos[model.jnt_qposadr[joint]]),
        "torque_limit_nm": limit and limit.torque_nm,
        "limit_source": limit and limit.source,
        "rotor_inertia_kgm2": float(model.dof_armature[dof]),
        "damping_nms": 0.0 if robot.drives.stands_in(name) else float(model.dof_damping[dof]),
        "friction_nm": float(model.dof_frictionloss[dof]),
        "spring_nm_rad": float(model.jnt_stiffness[joint]),
        "spring_rest_rad": float(model.qpos_spring[model.jnt_qposadr[joint]]),
    }


def _weight_reach(robot: Robot, ankle: Ankle, sole: Sole | None) -> dict[str, Any]:
    """How far from the ankle its joints' limits hold the robot's whole weight, how far the sole goes, who holds it."""
    weight = float(robot.model.body_mass.sum()) * float(np.linalg.norm(robot.model.opt.gravity))
    limits = [robot.drives.limits.get(robot.tree.joint_name(joint)) for joint in (ankle.pitch, ankle.roll)]
    corners = np.zeros((0, 2)) if sole is None else sole.outline.vertices
    reaches = weight_reach([limit and limit.torque_nm for limit in limits], weight, corners)
    found = dict(zip(("pitch", "roll"), reaches, strict=True))
    return {
        "holds_weight_at_m": {name: reach.reach_m for name, reach in found.items()},
        "sole_edge_at_m": {name: reach.edge_m for name, reach in found.items()},
        "holds_sole": {name: reach.holds_sole for name, reach in found.items()},
    }


def _foot(robot: Robot, foot: FootBody, ankle: Ankle | None, sole: Sole | None) -> dict[str, Any]:
    tree = robot.tree
    table: dict[str, Any] = {"body": tree.body_name(foot.body), "how": foot.how}
    if ankle is not None:
        table["ankle"] = {
            "pitch": tree.joint_name(ankle.pitch),
            "roll": tree.joint_name(ankle.roll),
            "order": "roll, pitch" if ankle.lower == ankle.pitch else "pitch, roll",
            "axes_gap_m": ankle.gap_m,
            "how": ankle.how,
            **_weight_reach(robot, ankle, sole),
        }
    if sole is not None:
        table["sole"] = {
            "length_m": sole.length_m,
            "width_m": sole.width_m,
            "ankle_height_m": sole.ankle_height_m,
            "corners_m": np.round(sole.outline.vertices, 6).tolist(),
            "tilt_deg": sole.tilt_deg,
            "area_lost": sole.area_lost,
            "how": sole.how,
        }
    return table


def _statics(statics: Statics) -> dict[str, Any]:
    how = "found" if statics.is_found else "by rule"
    table: dict[str, Any] = {"support": statics.support, "stands": statics.reached, "posture": how}
    if statics.by_rule is not None:
        table["by_rule"] = statics.by_rule.reason
    if statics.torque is not None and statics.range is not None:
        table |= {
            "com_height_m": statics.com_height_m,
            "condition_of_h": statics.condition,
            "torque": {"joint": statics.torque.joint, "percent": statics.torque.percent, "nm": statics.torque.amount},
            "range": {"joint": statics.range.joint, "percent": statics.range.percent, "rad": statics.range.amount},
        }
    return table


def _problem(problem: Problem) -> dict[str, str]:
    return {"topic": problem.topic, "reason": problem.reason, "remedy": problem.remedy}
