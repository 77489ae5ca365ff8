"""From what was found in a robot's files to the description that controllers and simulation take."""

import numpy as np

from surefoot.robot.description import Joint, RobotDescription
from surefoot.robot.feet import Foot, Side
from surefoot.robot_import.agreement import pinocchio_model
from surefoot.robot_import.ankles import Ankle
from surefoot.robot_import.fit import fit_mjcf
from surefoot.robot_import.foot_bodies import FootBody
from surefoot.robot_import.inspection import Robot
from surefoot.robot_import.normalise import PlainMjcf
from surefoot.robot_import.robot_file import robot_sha256
from surefoot.robot_import.sole import Sole


def describe(robot: Robot) -> RobotDescription:
    """The description. Everything up to the soles must have been found; a joint without a limit gets an endless one."""
    assert robot.feet is not None and robot.soles is not None and robot.ankles is not None
    assert robot.legs is not None and robot.trunk is not None
    tree, text = robot.tree, fitted(robot).text()
    dofs = {joint: int(robot.model.jnt_dofadr[joint]) for joint in tree.hinges}
    legs = [tuple(dofs[joint] for joint in leg) for leg in (robot.legs.left, robot.legs.right)]
    left, right = (_foot(robot, *parts) for parts in zip(robot.feet, robot.ankles, robot.soles, legs, strict=True))
    source = robot.file.mjcf if robot.file.path is None else robot.file.path
    return RobotDescription(
        name=robot.file.mjcf.stem,
        mjcf_path=source.resolve(),
        mjcf_xml=text,
        pinocchio_model=pinocchio_model(text),
        joints=tuple(_joint(robot, joint, dof) for joint, dof in dofs.items()),
        feet=(left, right),
        base=tree.body_name(tree.base),
        trunk=tree.body_name(robot.trunk.body),
        upper=tuple(dofs[joint] for joint in robot.legs.upper),
        sha256=robot_sha256(robot.file),
        posture_rad=robot.posture.angles(robot.model),
    )


def fitted(robot: Robot) -> PlainMjcf:
    """The MJCF that is simulated, as far as the robot is known."""
    if robot.feet is None or robot.soles is None:
        return fit_mjcf(robot.plain, robot.drives, {}, {})
    tree = robot.tree
    links = {
        foot.side: [tree.body_name(body) for body in (foot.body, *(b for b in tree.link(foot.body) if b != foot.body))]
        for foot in robot.feet
    }
    return fit_mjcf(robot.plain, robot.drives, links, dict(zip(Side, robot.soles, strict=True)))


def _joint(robot: Robot, joint: int, dof: int) -> Joint:
    model, name = robot.model, robot.tree.joint_name(joint)
    lower, upper = model.jnt_range[joint]
    limit = robot.drives.limits.get(name)
    return Joint(
        name=name,
        dof=dof,
        lower_rad=float(lower),
        upper_rad=float(upper),
        torque_limit_nm=float("inf") if limit is None else limit.torque_nm,
        rotor_inertia_kgm2=float(model.dof_armature[dof]),
        damping=0.0 if robot.drives.stands_in(name) else float(model.dof_damping[dof]),
        friction_nm=float(model.dof_frictionloss[dof]),
        spring_nm_rad=float(model.jnt_stiffness[joint]),
        spring_rest_rad=float(model.qpos_spring[model.jnt_qposadr[joint]]),
    )


def _foot(robot: Robot, foot: FootBody, ankle: Ankle, sole: Sole, leg: tuple[int, ...]) -> Foot:
    corners, dof = sole.outline.vertices, robot.model.jnt_dofadr
    return Foot(
        side=foot.side,
        body=robot.tree.body_name(foot.body),
        rotation_in_body=sole.rotation_in_body,
        ankle_in_body=sole.ankle_in_body,
        ankle_height_m=sole.ankle_height_m,
        sole=sole.outline,
        corners_from_ankle=np.column_stack((corners, np.full(len(corners), -sole.ankle_height_m))),
        sagittal=int(dof[ankle.pitch]),
        frontal=int(dof[ankle.roll]),
        leg=leg,
    )
