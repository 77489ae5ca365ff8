"""Reads one MJCF file into everything the program knows of a robot; the only reader of ``robot_models/``.

And the state of that robot at one instant, in Pinocchio's layout.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.geometry.polygon import convex_hull
from surefoot.record import record
from surefoot.resources import resource_folder
from surefoot.robot.feet import Foot, Side
from surefoot.robot.pinocchio_library import pin


@record
class RobotState:
    """Configuration and velocity.

    Attributes:
        q: (22,) pelvis position in world [m], pelvis orientation quaternion (x, y, z, w), 15 joint angles [rad].
        v: (21,) pelvis linear [m/s] and angular [rad/s] velocity, both in the pelvis frame, 15 joint rates [rad/s].
        time_s: time since the start of the run [s].
    """

    q: np.ndarray
    v: np.ndarray
    time_s: float = 0.0

    def is_finite(self) -> bool:
        """Whether every number is finite (the square of the length is finite only then)."""
        return math.isfinite(float(self.q.dot(self.q)) + float(self.v.dot(self.v)))


BASE_DOFS = 6


@dataclass(frozen=True)
class Joint:
    """One actuated hinge.

    Attributes:
        name: e.g. ``left_ankle_sagittal``.
        number: the paper's number, 1 to 15 (1, 2, 5 and 6 are the ankles).
        dof: index in a velocity vector (6..20).
        lower_rad, upper_rad: published range.
        torque_limit_nm: what the motor saturates at (chosen, see robot_models/bip/README.md).
        rotor_inertia_kgm2: reflected rotor inertia ("armature").
    """

    name: str
    number: int
    dof: int
    lower_rad: float
    upper_rad: float
    torque_limit_nm: float
    rotor_inertia_kgm2: float


@dataclass(frozen=True, eq=False)
class RobotDescription:
    """A robot as its MJCF file describes it.

    Attributes:
        name: folder name below ``robot_models/``.
        mjcf_path: the file, which MuJoCo reads too.
        pinocchio_model: rigid-body model with a free-flyer root; only ``dynamics`` may touch it.
        joints: actuated joints in velocity order.
        feet: left foot, right foot.
    """

    name: str
    mjcf_path: Path
    pinocchio_model: pin.Model
    joints: tuple[Joint, ...]
    feet: tuple[Foot, Foot]

    @cached_property
    def mass_kg(self) -> float:
        """Total mass m."""
        return float(sum(inertia.mass for inertia in self.pinocchio_model.inertias))

    @cached_property
    def gravity(self) -> float:
        """g [m/s2]."""
        return float(-self.pinocchio_model.gravity.linear[2])

    @cached_property
    def torque_limits(self) -> np.ndarray:
        """(15,) [N m]."""
        return np.array([joint.torque_limit_nm for joint in self.joints])

    @cached_property
    def joint_lower(self) -> np.ndarray:
        """(15,) [rad]."""
        return np.array([joint.lower_rad for joint in self.joints])

    @cached_property
    def joint_upper(self) -> np.ndarray:
        """(15,) [rad]."""
        return np.array([joint.upper_rad for joint in self.joints])

    @cached_property
    def links(self) -> tuple[str, ...]:
        """Names of the links, pelvis first."""
        return tuple(f.name for f in self.pinocchio_model.frames if f.type == pin.FrameType.BODY)

    def joint_named(self, name: str) -> Joint:
        """The joint of that name; raises InvalidInput with the names there are."""
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise InvalidInput("joint", name, "no such joint", [joint.name for joint in self.joints])

    def joint_numbered(self, number: int) -> Joint:
        """The joint with the paper's number 1 to 15."""
        return next(joint for joint in self.joints if joint.number == number)


def available_robots() -> list[str]:
    """Names of the folders below ``robot_models/`` that hold a model."""
    return sorted(path.parent.name for path in resource_folder("robot_models").glob("*/*.xml"))


@lru_cache(maxsize=4)
def load_robot(name: str = "bip") -> RobotDescription:
    """Read ``robot_models/NAME/NAME.xml``. Raises InvalidInput listing the robots there are."""
    if name not in available_robots():
        raise InvalidInput("robot", name, "no such robot", available_robots())
    path = resource_folder("robot_models") / name / f"{name}.xml"
    root = ElementTree.parse(path).getroot()
    model = pin.buildModelFromMJCF(str(path))
    joints = _read_joints(root, model)
    dofs = {joint.name: joint.dof for joint in joints}
    feet = tuple(_read_foot(root, side, dofs) for side in Side)
    return RobotDescription(name, path, model, joints, (feet[0], feet[1]))


def _read_joints(root: ElementTree.Element, model: pin.Model) -> tuple[Joint, ...]:
    limits = {m.get("joint"): float(m.get("ctrlrange", "").split()[1]) for m in root.iter("motor")}
    numbers = {j.get("name"): int(j.get("user", "0")) for j in root.iter("joint") if j.get("name")}
    joints = []
    for index in range(2, model.njoints):  # 0 is the universe, 1 the free-flyer
        name, dof = model.names[index], model.joints[index].idx_v
        position = model.joints[index].idx_q
        joints.append(
            Joint(
                name,
                numbers[name],
                dof,
                float(model.lowerPositionLimit[position]),
                float(model.upperPositionLimit[position]),
                limits[name],
                float(model.armature[dof]),
            )
        )
    return tuple(joints)


def _read_foot(root: ElementTree.Element, side: Side, dofs: dict[str, int]) -> Foot:
    """The sole is the lower face of the collision mesh; its frame is the ankle's."""
    sole = next(mesh for mesh in root.iter("mesh") if mesh.get("name") == "sole")
    vertices = np.array(sole.get("vertex", "").split(), dtype=float).reshape(-1, 3)
    bottom = vertices[:, 2].min()
    outline = convex_hull(vertices[vertices[:, 2] == bottom, :2])
    corners = np.column_stack((outline.vertices, np.full(len(outline.vertices), bottom)))
    return Foot(
        side,
        f"{side[0]}_foot",
        float(-bottom),
        outline,
        corners,
        dofs[f"{side}_ankle_sagittal"],
        dofs[f"{side}_ankle_frontal"],
    )
