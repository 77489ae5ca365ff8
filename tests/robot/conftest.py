"""The Bip model in both engines, the published link table as a second model, and the published states in our axes."""

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from surefoot.resources import resource_folder

BIP_XML = str(resource_folder("robot_models") / "bip" / "bip.xml")
GOLDENS = Path(__file__).resolve().parents[1] / "goldens"

TO_OURS = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # published axes (X, Y, Z), y up -> ours (X, -Z, Y), z up
PELVIS_HEIGHT = 0.903  # published world height of the pelvis at q17 = 0 [m]

# Joint names in the published (and the paper's) order, 1 to 15.
PUBLISHED_JOINTS = (
    *("right_ankle_frontal", "right_ankle_sagittal", "right_knee", "right_hip_sagittal"),
    *("left_ankle_frontal", "left_ankle_sagittal", "left_knee", "left_hip_sagittal"),
    *("right_hip_frontal", "right_hip_yaw", "left_hip_frontal", "left_hip_yaw"),
    *("trunk_yaw", "trunk_frontal", "trunk_sagittal"),
)


def rotation_about(axis: int, angle: float) -> np.ndarray:
    return pin.exp3(angle * np.eye(3)[axis])


def cross_matrix(vector: np.ndarray) -> np.ndarray:
    return pin.skew(vector)


@dataclass(frozen=True, eq=False)
class PublishedState:
    """One state of ``bip_reference.npz`` in our coordinates; ``q`` and ``qdot`` stay the published ones.

    Our velocity is v = T(q) qdot, as Pinocchio's free-flyer wants it: pelvis linear and angular velocity in the pelvis
    frame, then the joint rates.
    """

    model: pin.Model
    data: dict[str, np.ndarray]

    @property
    def qdot(self) -> np.ndarray:
        return self.data["qdot"]

    @cached_property
    def rotation_pelvis_to_world(self) -> np.ndarray:
        roll, yaw, pitch = self.data["q"][18:21]
        published = rotation_about(1, yaw) @ rotation_about(2, pitch) @ rotation_about(0, roll)
        return TO_OURS @ published @ TO_OURS.T

    @cached_property
    def configuration(self) -> np.ndarray:
        q = self.data["q"]
        ours = pin.neutral(self.model)
        ours[:3] = TO_OURS @ (q[15:18] + [0, PELVIS_HEIGHT, 0])
        ours[3:7] = pin.Quaternion(self.rotation_pelvis_to_world).coeffs()
        for angle, name in zip(q[:15], PUBLISHED_JOINTS, strict=True):
            ours[self.model.joints[self.model.getJointId(name)].idx_q] = angle
        return ours

    @property
    def velocity(self) -> np.ndarray:
        return self.T @ self.qdot

    @cached_property
    def T(self) -> np.ndarray:
        return self._T_and_its_rate[0]

    @cached_property
    def T_rate(self) -> np.ndarray:
        """Time derivative of T along qdot, analytic."""
        return self._T_and_its_rate[1]

    @cached_property
    def _T_and_its_rate(self) -> tuple[np.ndarray, np.ndarray]:
        T, T_rate = np.zeros((21, 21)), np.zeros((21, 21))
        for k, name in enumerate(PUBLISHED_JOINTS):
            T[self.model.joints[self.model.getJointId(name)].idx_v, k] = 1
        # Angular velocity in the pelvis frame, in published axes: ex roll' + Rx^t ez pitch' + Rx^t Rz^t ey yaw'.
        roll, _, pitch = self.data["q"][18:21]
        roll_rate, _, pitch_rate = self.qdot[18:21]
        e_x, e_y, e_z = np.eye(3)
        Rx_t, Rz_t = rotation_about(0, roll).T, rotation_about(2, pitch).T
        Rx_t_rate, Rz_t_rate = -roll_rate * cross_matrix(e_x) @ Rx_t, -pitch_rate * cross_matrix(e_z) @ Rz_t
        T[3:6, 18:21] = TO_OURS @ np.column_stack([e_x, Rx_t @ Rz_t @ e_y, Rx_t @ e_z])
        T_rate[3:6, 19] = TO_OURS @ (Rx_t_rate @ Rz_t + Rx_t @ Rz_t_rate) @ e_y
        T_rate[3:6, 20] = TO_OURS @ Rx_t_rate @ e_z
        # Linear velocity in the pelvis frame, R^t p'; its rate needs the angular velocity from above.
        omega = T[3:6, 18:21] @ self.qdot[18:21]
        T[:3, 15:18] = self.rotation_pelvis_to_world.T @ TO_OURS
        T_rate[:3, 15:18] = -cross_matrix(omega) @ T[:3, 15:18]
        return T, T_rate


@pytest.fixture(scope="session")
def bip_xml() -> str:
    return BIP_XML


@pytest.fixture(scope="session")
def bip_readme_tables() -> list[list[str]]:
    """The rows of all tables in the model's README, cell by cell."""
    lines = Path(BIP_XML).with_name("README.md").read_text().splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]


@pytest.fixture(scope="session")
def bip() -> pin.Model:
    return pin.buildModelFromMJCF(BIP_XML)


@pytest.fixture(scope="session")
def bip_mujoco() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(BIP_XML)


@pytest.fixture(scope="session")
def published_links() -> dict[str, tuple[float, np.ndarray, np.ndarray]]:
    """Link name -> mass, centre of mass, inertia at the centre of mass; our axes."""
    links = {}
    for name, (mass, com, (xx, yy, zz, xy, xz, yz)) in json.loads(
        (GOLDENS / "bip_published_links.json").read_text()
    )["links"].items():  # fmt: skip
        at_origin = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        at_com = at_origin + mass * cross_matrix(np.array(com)) @ cross_matrix(np.array(com))
        links[name] = (mass, TO_OURS @ com, TO_OURS @ at_com @ TO_OURS.T)
    return links


@pytest.fixture(scope="session")
def bip_of_published_table(published_links) -> pin.Model:
    """Our model with the published, rounded inertias (some of no possible body) and without rotors."""
    model = pin.buildModelFromMJCF(BIP_XML)
    model.armature = np.zeros(model.nv)
    for name, (mass, com, at_com) in published_links.items():
        inertia = pin.Inertia(mass, com, np.eye(3))
        inertia.inertia = at_com  # the constructor would refuse it
        model.inertias[model.frames[model.getFrameId(name)].parentJoint] = inertia
    return model


@pytest.fixture(params=range(12))
def published(request, bip) -> PublishedState:
    arrays = np.load(GOLDENS / "bip_reference.npz")
    return PublishedState(bip, {name: arrays[name][request.param] for name in arrays})


@pytest.fixture
def configurations_in_range(bip) -> list[np.ndarray]:
    """200 random postures within the joint ranges, arbitrary pelvis poses."""
    rng = np.random.default_rng(20050218)
    postures = []
    for _ in range(200):
        q = pin.integrate(bip, pin.neutral(bip), np.r_[rng.normal(size=6), np.zeros(15)])
        q[7:] = rng.uniform(bip.lowerPositionLimit[7:], bip.upperPositionLimit[7:])
        postures.append(q)
    return postures
