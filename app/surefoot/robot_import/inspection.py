"""All that is found out about a robot from its MJCF or URDF and robot.toml; each step needs those before it."""

from dataclasses import dataclass, field
from pathlib import Path

import mujoco

from surefoot.robot.feet import Side
from surefoot.robot.pinocchio_library import pin
from surefoot.robot_import.agreement import (
    Agreement,
    agreement_problems,
    compare,
    lost_by_pinocchio,
    pinocchio_model,
)
from surefoot.robot_import.ankles import Ankle, find_ankle
from surefoot.robot_import.base_frame import turn_base
from surefoot.robot_import.foot_bodies import FootBody, find_feet
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.legs import Legs, find_legs, leg_problems
from surefoot.robot_import.limits import Drives, limit_problems, read_drives
from surefoot.robot_import.mjcf_source import choose_keyframe, keyframe_qpos
from surefoot.robot_import.model_source import ModelSource, read_model
from surefoot.robot_import.normalise import PlainMjcf, plain_mjcf, robot_bodies
from surefoot.robot_import.posture import Posture, bend_knees, choose_posture, knees_are_straight
from surefoot.robot_import.posture_search import RANGE_MARGIN
from surefoot.robot_import.problem import Problem, RefusedError
from surefoot.robot_import.robot_file import RobotFile, read_robot_file
from surefoot.robot_import.sole import Sole, find_sole
from surefoot.robot_import.structure import structure_problems
from surefoot.robot_import.trunk import Trunk, find_trunk


@dataclass
class Robot:
    """A robot that MuJoCo and Pinocchio both read.

    Attributes:
        file: what robot.toml says.
        original: as its owner wrote it.
        keyframe: of the original, that the posture comes from.
        plain: the same without defaults, frames and world.
        model: the plain one, compiled.
        pinocchio: the plain one, as Pinocchio reads it.
        tree: the plain one in its posture.
        posture: where the joints are.
        agreement: of the two libraries.
        drives: of the joints.
        feet, legs, ankles, soles, trunk: None where something before them is missing.
    """

    file: RobotFile
    original: mujoco.MjModel
    keyframe: str | None
    plain: PlainMjcf
    model: mujoco.MjModel
    pinocchio: pin.Model
    tree: KinematicTree
    posture: Posture
    agreement: Agreement
    drives: Drives
    feet: tuple[FootBody, FootBody] | None = None
    legs: Legs | None = None
    trunk: Trunk | None = None
    ankles: tuple[Ankle, Ankle] | None = None
    soles: tuple[Sole, Sole] | None = None

    @property
    def said(self) -> frozenset[str]:
        """Names of the joints whose angle robot.toml says."""
        return frozenset(self.file.posture_rad)


@dataclass
class Inspection:
    """What was found, as far as one got.

    Attributes:
        path: of the file that was given.
        robot: None where not even a tree of hinges could be made.
        problems: what keeps it from being run.
    """

    path: Path
    robot: Robot | None = None
    problems: list[Problem] = field(default_factory=list)

    @property
    def is_complete(self) -> bool:
        """Whether everything up to the soles was found."""
        return self.robot is not None and self.robot.soles is not None


def inspect_robot(path: Path) -> Inspection:
    """Find out all that can be.

    Args:
        path: of an MJCF, a URDF or a robot.toml.

    Raises:
        InvalidInput: a file cannot be read, or robot.toml names what is not there.
    """
    inspection = Inspection(path)
    file = read_robot_file(path)
    source = read_model(file.mjcf)
    original = source.model
    try:
        inspection.problems += structure_problems(original, robot_bodies(original), file.frozen)
        inspection.problems += source.problems(file.frozen)
        if inspection.problems:
            return inspection
        inspection.robot = robot = _read(file, source)
        inspection.problems += agreement_problems(robot.agreement)
        inspection.problems += limit_problems(robot.drives, _joints(robot))
        robot.feet = find_feet(robot.tree, file.feet)
        robot.legs = find_legs(robot.tree, robot.feet[0].body, robot.feet[1].body)
        robot.trunk = find_trunk(robot.tree, robot.legs, file.trunk)
        legs = leg_problems(robot.tree, robot.legs)
        inspection.problems += legs
        if not legs:
            _bend(robot, robot.legs)
            _find_soles(robot, robot.feet, robot.legs)
    except RefusedError as refused:
        inspection.problems.append(refused.problem)
    return inspection


def _read(file: RobotFile, source: ModelSource) -> Robot:
    original = source.model
    keyframe = choose_keyframe(original, file.keyframe)
    qpos, moved = (keyframe_qpos(original, keyframe), []) if keyframe else source.posture(file.frozen)
    for name in file.frozen:
        if name in file.posture_rad:
            qpos[int(original.joint(name).qposadr[0])] = file.posture_rad[name]
    plain = plain_mjcf(original, qpos, file.frozen, source.moved_meshes)
    plain.changed.extend(source.changed)
    if moved := [name for name in moved if name not in file.posture_rad]:
        share = f"{100.0 * RANGE_MARGIN:g} % of it"
        plain.changed.append(f"joints at or beyond an end of their range at 0, put {share} inside: {', '.join(moved)}")
    plain.dropped.extend(source.left_out)
    if not source.is_urdf and (lost := lost_by_pinocchio(file.mjcf, original)):
        plain.changed.insert(0, f"{lost}: all is spelled out first, and nothing is lost")
    if file.base_axes is not None:
        turn_base(plain.root, file.base_axes)
        plain.changed.append(
            f"the base's frame turned: {file.base_axes.forward} was forward and {file.base_axes.up} up, x and z are now"
        )
    text = plain.text()
    model = mujoco.MjModel.from_xml_string(text)
    said = {name: angle for name, angle in file.posture_rad.items() if name not in file.frozen}
    posture = choose_posture(model, original, keyframe, qpos, said, file.base_axes)
    pinocchio = pinocchio_model(text)
    tree = KinematicTree(model, posture.qpos)
    drives = read_drives(original, tree.joint_names(tree.hinges), file.torque_limits_nm, source.effort)
    return Robot(file, original, keyframe, plain, model, pinocchio, tree, posture, compare(model, pinocchio), drives)


def _bend(robot: Robot, legs: Legs) -> None:
    """A posture for a robot that has none, or whose knees are straight there."""
    straight = robot.posture.how and knees_are_straight(robot.tree, (legs.left, legs.right))
    if not robot.posture.how or straight:
        bent = bend_knees(robot.tree, robot.posture.qpos, (legs.left, legs.right))
        how = f"{robot.posture.how}, its straight knees bent" if straight else bent.how
        robot.posture = Posture(bent.qpos, how, is_as_said=False)
        robot.tree = KinematicTree(robot.model, robot.posture.qpos)


def _find_soles(robot: Robot, feet: tuple[FootBody, FootBody], legs: Legs) -> None:
    said = [robot.file.feet.get(side) for side in Side]
    ankles, soles = [], []
    for foot, leg, words in zip(feet, (legs.left, legs.right), said, strict=True):
        where = f"feet.{foot.side}.ankle_joints"
        ankles.append(find_ankle(robot.tree, leg, words and words.ankle_joints, where))
    robot.ankles = (ankles[0], ankles[1])
    for foot, ankle, words in zip(feet, ankles, said, strict=True):
        soles.append(find_sole(robot.tree, foot.body, ankle, words.corners if words else None))
    robot.soles = (soles[0], soles[1])


def _joints(robot: Robot) -> list[str]:
    return robot.tree.joint_names(robot.tree.hinges)
