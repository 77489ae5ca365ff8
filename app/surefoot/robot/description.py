"""Reads one MJCF file into everything the program knows of a robot; the only reader of ``robot_models/``.

And the state of that robot at one instant, in Pinocchio's layout.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
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
        q: (7 + n,) base position in world [m], base orientation quaternion (x, y, z, w), n joint angles [rad].
        v: (6 + n,) base linear [m/s] and angular [rad/s] velocity, both in the base frame, n joint rates [rad/s].
        time_s: time since the start of the run [s].
    """

    q: np.ndarray
    v: np.ndarray
    time_s: float = 0.0

    def is_finite(self) -> bool:
        """Whether every number is finite (the square of the length is finite only then)."""
        return math.isfinite(float(self.q.dot(self.q)) + float(self.v.dot(self.v)))


BASE_DOFS = 6
BASE, TRUNK = "pelvis", "trunk"  # of the robots in robot_models/


@dataclass(frozen=True, kw_only=True)
class Joint:
    """One actuated hinge.

    Attributes:
        name: e.g. ``left_ankle_sagittal``.
        number: the paper's number, 1 to 15 (1, 2, 5 and 6 are the ankles); only Bip's joints have one.
        dof: index in a velocity vector, from 6 on.
        lower_rad, upper_rad: range.
        torque_limit_nm: what the motor saturates at (Bip's are chosen, see robot_models/bip/README.md).
        rotor_inertia_kgm2: reflected rotor inertia ("armature").
        damping: of the plant [N m s/rad]; the controllers do not know it.
        friction_nm: dry friction of the plant [N m]; the controllers do not know it.
    """

    name: str
    number: int | None = None
    dof: int
    lower_rad: float
    upper_rad: float
    torque_limit_nm: float
    rotor_inertia_kgm2: float
    damping: float = 0.0
    friction_nm: float = 0.0

    @property
    def key(self) -> str:
        """What it is called in files: the paper's number where it has one, else its name."""
        return self.name if self.number is None else str(self.number)


@dataclass(frozen=True, eq=False, kw_only=True)
class RobotDescription:
    """A robot as its MJCF file describes it: a free base, two legs of six joints, and joints that are in no leg.

    Attributes:
        name: folder name below ``robot_models/``, or of the file.
        mjcf_path: the file it came from.
        mjcf_xml: MJCF text that MuJoCo reads in place of the file, meshes by absolute path; None: the file itself.
        pinocchio_model: rigid-body model with a free-flyer root; only ``dynamics`` may touch it.
        joints: actuated joints in velocity order.
        feet: left foot, right foot.
        base: body of the free joint (Bip: the pelvis).
        trunk: body that must stay upright.
        upper: velocity indices of the joints that are in no leg (Bip: the lumbar joints).
        posture_rad: joint name -> angle [rad] of a nominal standing posture; without, it is computed.
    """

    name: str
    mjcf_path: Path
    mjcf_xml: str | None = None
    pinocchio_model: pin.Model
    joints: tuple[Joint, ...]
    feet: tuple[Foot, Foot]
    base: str
    trunk: str
    upper: tuple[int, ...]
    posture_rad: Mapping[str, float] = field(default_factory=dict)

    @property
    def dofs(self) -> int:
        """Length of a velocity vector, and of kappa: with two legs of six joints H is square."""
        return BASE_DOFS + len(self.joints)

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
        """(n,) [N m]."""
        return np.array([joint.torque_limit_nm for joint in self.joints])

    @cached_property
    def joint_lower(self) -> np.ndarray:
        """(n,) [rad]."""
        return np.array([joint.lower_rad for joint in self.joints])

    @cached_property
    def joint_upper(self) -> np.ndarray:
        """(n,) [rad]."""
        return np.array([joint.upper_rad for joint in self.joints])

    @cached_property
    def links(self) -> tuple[str, ...]:
        """Names of the links, the base first."""
        return tuple(f.name for f in self.pinocchio_model.frames if f.type == pin.FrameType.BODY)

    def joint_named(self, name: str) -> Joint:
        """The joint of that name; raises InvalidInput with the names there are."""
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise InvalidInput("joint", name, "no such joint", [joint.name for joint in self.joints])

    def joint_numbered(self, number: int) -> Joint:
        """The joint with the paper's number 1 to 15 (Bip's only)."""
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
    feet = tuple(_read_foot(root, model, side, dofs) for side in Side)
    return RobotDescription(
        name=name,
        mjcf_path=path,
        pinocchio_model=model,
        joints=joints,
        feet=(feet[0], feet[1]),
        base=BASE,
        trunk=TRUNK,
        upper=tuple(dof for dof in dofs.values() if all(dof not in foot.leg for foot in feet)),
    )


def _read_joints(root: ElementTree.Element, model: pin.Model) -> tuple[Joint, ...]:
    limits = {m.get("joint"): float(m.get("ctrlrange", "").split()[1]) for m in root.iter("motor")}
    numbers = {j.get("name"): _number(j.get("user")) for j in root.iter("joint") if j.get("name")}
    joints = []
    for index in range(2, model.njoints):  # 0 is the universe, 1 the free-flyer
        name, dof = model.names[index], model.joints[index].idx_v
        position = model.joints[index].idx_q
        joints.append(
            Joint(
                name=name,
                number=numbers[name],
                dof=dof,
                lower_rad=float(model.lowerPositionLimit[position]),
                upper_rad=float(model.upperPositionLimit[position]),
                torque_limit_nm=limits[name],
                rotor_inertia_kgm2=float(model.armature[dof]),
            )
        )
    return tuple(joints)


def _number(user: str | None) -> int | None:
    return None if user is None else int(user)


def _read_foot(root: ElementTree.Element, model: pin.Model, side: Side, dofs: dict[str, int]) -> Foot:
    """The sole is the lower face of the collision mesh; its frame is the ankle's."""
    sole = next(mesh for mesh in root.iter("mesh") if mesh.get("name") == "sole")
    vertices = np.array(sole.get("vertex", "").split(), dtype=float).reshape(-1, 3)
    bottom = vertices[:, 2].min()
    outline = convex_hull(vertices[vertices[:, 2] == bottom, :2])
    corners = np.column_stack((outline.vertices, np.full(len(outline.vertices), bottom)))
    body = f"{side[0]}_foot"
    return Foot(
        side=side,
        body=body,
        ankle_height_m=float(-bottom),
        sole=outline,
        corners_from_ankle=corners,
        sagittal=dofs[f"{side}_ankle_sagittal"],
        frontal=dofs[f"{side}_ankle_frontal"],
        leg=_joints_down_to(model, body),
    )


def _joints_down_to(model: pin.Model, body: str) -> tuple[int, ...]:
    """Velocity indices of the joints from the base to a link."""
    last = model.frames[model.getFrameId(body)].parentJoint
    return tuple(model.joints[joint].idx_v for joint in model.supports[last] if joint > 1)
