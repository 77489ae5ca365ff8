"""Reads one MJCF file into everything the program knows of a robot; the only reader of ``robot_models/``.

And the state of that robot at one instant, in Pinocchio's layout.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import product
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.resources import resource_folder
from surefoot.robot.feet import Foot, Side, Support, sole_from_points
from surefoot.robot.leg_chains import ankle_joints, bent_leg, leg_joints
from surefoot.robot.link_chains import link_chains
from surefoot.robot.model_files import files_sha256, mjcf_files
from surefoot.robot.pinocchio_library import pin
from surefoot.robot.sizes import Sizes, measure
from surefoot.robot.stance import Stance


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
BASE, TRUNK = "pelvis", "trunk"  # as the robots in robot_models/ call theirs


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
        damping: of the plant [N m s/rad]; controllers know it with ``joint_friction_compensation`` only.
        friction_nm: dry friction of the plant [N m]; likewise.
        spring_nm_rad: stiffness k of the linear spring in it; plant and controllers' model have it.
        spring_rest_rad: angle q0 at which that gives nothing; elsewhere its torque is k (q0 - q).
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
    spring_nm_rad: float = 0.0
    spring_rest_rad: float = 0.0

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
        sha256: of the files that decide its physics (``model_files``).
        posture_rad: joint name -> angle [rad] of a nominal standing posture; without, it is computed.
        stances: how it stands on supports for which ``task.posture``'s rule does not do; Bip: none.
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
    sha256: str
    posture_rad: Mapping[str, float] = field(default_factory=dict)
    stances: Mapping[Support, Stance] = field(default_factory=dict)

    @property
    def dofs(self) -> int:
        """Length of a velocity vector, and of kappa: with two legs of six joints H is square."""
        return BASE_DOFS + len(self.joints)

    @cached_property
    def mass_kg(self) -> float:
        """Total mass m."""
        return float(sum(inertia.mass for inertia in self.pinocchio_model.inertias))

    @cached_property
    def sizes(self) -> Sizes:
        """How large it is."""
        return measure(self.pinocchio_model, self.feet, self.start_angles if self.posture_rad else None)

    @cached_property
    def start_angles(self) -> np.ndarray:
        """(n,) angles [rad] of the nominal standing posture; without one, with bent knees above level soles."""
        bent: dict[int, float] = {}
        for foot in self.feet if not self.posture_rad else ():
            bent |= bent_leg(self.pinocchio_model, foot.leg, foot.body, foot.rotation_in_body)
        return np.array([self.posture_rad.get(joint.name, bent.get(joint.dof, 0.0)) for joint in self.joints])

    @cached_property
    def knees(self) -> tuple[tuple[int, float], ...]:
        """Velocity index and sign of the bend of each leg's knee: the joint that is bent most in ``start_angles``."""
        angles = {joint.dof: float(angle) for joint, angle in zip(self.joints, self.start_angles, strict=True)}
        bent = [max(foot.leg, key=lambda dof: abs(angles[dof])) for foot in self.feet]
        return tuple((dof, math.copysign(1.0, angles[dof])) for dof in bent)

    @cached_property
    def upper_angles(self) -> np.ndarray:
        """Angles [rad] of the joints that are in no leg, in the standing posture: inside their ranges."""
        joints = np.array(self.upper, dtype=int) - BASE_DOFS
        return np.clip(self.start_angles, self.joint_lower, self.joint_upper)[joints]

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

    @cached_property
    def link_chains(self) -> tuple[tuple[str, ...], ...]:
        """Names of the links from the base to each that carries no other."""
        return link_chains(self.pinocchio_model)

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


def model_path(name: str) -> Path:
    """The MJCF file of a robot below ``robot_models/``. Raises InvalidInput listing the robots there are."""
    if name not in available_robots():
        raise InvalidInput("robot", name, "no such robot", available_robots())
    return resource_folder("robot_models") / name / f"{name}.xml"


@lru_cache(maxsize=4)
def load_robot(name: str = "bip") -> RobotDescription:
    """Read ``robot_models/NAME/NAME.xml``. Raises InvalidInput listing the robots there are."""
    path = model_path(name)
    root = ElementTree.parse(path).getroot()
    model = pin.buildModelFromMJCF(str(path))
    joints = _read_joints(root, model)
    left, right = (_body_of_foot(model, side) for side in Side)
    legs = leg_joints(model, left, right)
    feet = tuple(_read_foot(root, model, side, leg) for side, leg in zip(Side, legs, strict=True))
    return RobotDescription(
        name=name,
        mjcf_path=path,
        pinocchio_model=model,
        joints=joints,
        feet=(feet[0], feet[1]),
        base=BASE,
        trunk=TRUNK,
        upper=tuple(joint.dof for joint in joints if all(joint.dof not in leg for leg in legs)),
        sha256=files_sha256(mjcf_files(path)),
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


def _body_of_foot(model: pin.Model, side: Side) -> str:
    """The link that carries the site ``SIDE_ankle``; without such a site ``l_foot`` or ``r_foot``."""
    site = f"{side}_ankle"
    if not model.existFrame(site):
        return f"{side[0]}_foot"
    return model.frames[model.frames[model.getFrameId(site)].parentFrame].name


def _read_foot(root: ElementTree.Element, model: pin.Model, side: Side, leg: tuple[int, ...]) -> Foot:
    """The foot frame is the site ``SIDE_ankle``, without one the link's own; the sole: see ``_sole_points``."""
    body, frame = _body_of_foot(model, side), pin.SE3.Identity()
    if model.existFrame(f"{side}_ankle"):
        link, site = (model.frames[model.getFrameId(name)].placement for name in (body, f"{side}_ankle"))
        frame = link.actInv(site)
    points = _sole_points(root, side)
    if not frame.isIdentity(0.0):
        points = (points - frame.translation).dot(frame.rotation)
    sole, corners = sole_from_points(points)
    sagittal, frontal = ankle_joints(model, leg, body, frame.rotation)
    return Foot(
        side=side,
        body=body,
        rotation_in_body=frame.rotation.copy(),
        ankle_in_body=frame.translation.copy(),
        ankle_height_m=float(-corners[0, 2]),
        sole=sole,
        corners_from_ankle=corners,
        sagittal=sagittal,
        frontal=frontal,
        leg=leg,
    )


def _sole_points(root: ElementTree.Element, side: Side) -> np.ndarray:
    """Points (n, 3) in the link's frame [m]: the box ``SIDE_sole``, or the mesh ``sole`` that both feet have."""
    for geom in root.iter("geom"):
        if geom.get("name") == f"{side}_sole" and geom.get("size"):
            centre, half = (np.array(geom.get(key, "").split(), dtype=float) for key in ("pos", "size"))
            return centre + half * np.array(list(product((-1.0, 1.0), repeat=3)))
    mesh = next(mesh for mesh in root.iter("mesh") if mesh.get("name") == "sole")
    return np.array(mesh.get("vertex", "").split(), dtype=float).reshape(-1, 3)
