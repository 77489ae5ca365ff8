"""A robot.toml to start from: what was found out is written down, what could be said besides is a comment."""

import json
import os
from dataclasses import replace
from pathlib import Path

from surefoot.robot.feet import Side
from surefoot.robot_import.inspection import Inspection, Robot
from surefoot.robot_import.mjcf_source import keyframe_qpos
from surefoot.robot_import.posture import choose_posture
from surefoot.robot_import.statics import stand

_ANGLE_DIGITS = 5


def robot_file_text(inspection: Inspection, out: Path) -> str:
    """The text of a robot.toml.

    Args:
        inspection: what was found out about an MJCF or a URDF, however little.
        out: where it will lie; the model is named as seen from there.
    """
    robot = inspection.robot
    mjcf = inspection.path if robot is None else robot.file.mjcf
    lines = [
        "# A robot for Surefoot. Check it: surefoot robot check robot.toml. Every line but the first may be left out:",
        "# it is then found out from that file.",
        "",
        f"mjcf = {json.dumps(_seen_from(out, mjcf))}  # an MJCF or a URDF",
    ]
    lines += _keyframe(robot)
    if robot is not None and robot.trunk is not None:
        lines.append(f"trunk = {json.dumps(robot.tree.body_name(robot.trunk.body))}  # must stay up")
    lines.append("frozen = []  # joints to take out, held at their angle in the posture: a toe, fingers, a neck")
    if robot is not None and (axes := robot.file.base_axes) is not None:
        lines += ["", "[base]  # how its frame lies in the MJCF", f'forward = "{axes.forward}"', f'up = "{axes.up}"']
    else:
        lines += ["", "# [base]  # how its frame lies in the MJCF", '# forward = "x"', '# up = "z"']
    lines += _feet(robot)
    lines += [*_limits(robot), *_posture(robot)]
    for problem in inspection.problems:
        lines += ["", f"# In the way: {problem.reason}", f"# {problem.remedy}"]
    return "\n".join(lines) + "\n"


def _seen_from(out: Path, mjcf: Path) -> str:
    return Path(os.path.relpath(mjcf.resolve(), out.resolve().parent)).as_posix()


def _keyframe(robot: Robot | None) -> list[str]:
    if robot is not None and robot.keyframe is not None:
        return [f"keyframe = {json.dumps(robot.keyframe)}  # the posture to stand in"]
    return ['# keyframe = "home"  # the posture to stand in, if an MJCF has one; else the table [posture]']


def _feet(robot: Robot | None) -> list[str]:
    lines = []
    for index, side in enumerate(Side):
        lines += ["", f"[feet.{side}]"]
        if robot is None or robot.feet is None:
            lines += [f'# body = "{side}_foot"']
        else:
            lines += [f"body = {json.dumps(robot.tree.body_name(robot.feet[index].body))}"]
        if robot is None or robot.ankles is None:
            lines += [f'# ankle_joints = ["{side}_ankle_pitch", "{side}_ankle_roll"]']
        else:
            ankle = robot.ankles[index]
            names = [robot.tree.joint_name(ankle.pitch), robot.tree.joint_name(ankle.roll)]
            lines += [f"ankle_joints = {json.dumps(names)}  # pitch, roll"]
        lines += [
            "# corners = [[x, y, z], ...]  # of the sole, in the body's frame, m: instead of its collision shapes"
        ]
    return lines


def _limits(robot: Robot | None) -> list[str]:
    lines = ["", "[torque_limits]  # N m, before those of the model"]
    if robot is None:
        return [*lines, "# joint = 100.0"]
    for name in robot.tree.joint_names(robot.tree.hinges):
        limit = robot.drives.limits.get(name)
        if limit is None:
            lines.append(f"# {json.dumps(name)} = ...  # none was found: it must be said")
        else:
            lines.append(f"# {json.dumps(name)} = {limit.torque_nm:g}  # as found: {limit.source}")
    return lines


def _posture(robot: Robot | None) -> list[str]:
    """Angles that differ from the keyframe's, or the drawn ones, so that it stands on two feet; and those once said.

    No others: a joint in no leg whose angle is said is not moved when a posture is looked for.
    """
    found = None if robot is None or robot.soles is None else stand(robot)[0]
    if robot is None or (robot.posture.is_as_said and not robot.said and not (found and found.is_found)):
        return ["", "# [posture]  # joint = angle in rad, on top of the keyframe"]
    posture, lines = robot.posture, ["", "[posture]  # rad, on top of the keyframe"]
    if found and found.is_found and found.qpos is not None:
        posture = replace(posture, qpos=found.qpos)
        lines = ["", "[posture]  # rad: found, for in the keyframe's gravity or a range stands in the way"]
    before = choose_posture(
        robot.model, robot.original, robot.keyframe, keyframe_qpos(robot.original, robot.keyframe), {}
    ).angles(robot.model)
    for name, angle in posture.angles(robot.model).items():
        if name in robot.said or round(angle - before[name], _ANGLE_DIGITS):
            lines.append(f"{json.dumps(name)} = {round(angle, _ANGLE_DIGITS) + 0.0}")
    return lines
