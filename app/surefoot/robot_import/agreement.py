"""Whether MuJoCo and Pinocchio read the same robot: names, degrees of freedom, mass; M, CoM, bias at random states."""

import tempfile
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np

from surefoot.record import record
from surefoot.robot.pinocchio_library import pin
from surefoot.robot_import.hinge_chains import split_hinges
from surefoot.robot_import.problem import Problem

LARGEST_DIFFERENCE = 1e-9  # of an element of M [kg m2], of the CoM [m] and of an element of the bias [N m]
_STATES = 50
_SEED = 1


@record
class Agreement:
    """What the two libraries make of one MJCF.

    Attributes:
        dofs: (MuJoCo, Pinocchio).
        mass_kg: (MuJoCo, Pinocchio).
        same_names: whether the joints have the same names in the same order.
        mass_matrix: largest difference of an element of M; None where the degrees of freedom differ.
        com_m: largest difference of the CoM.
        bias: largest difference of an element of N q' + G, at rates of some rad/s.
        states: number of random states.
    """

    dofs: tuple[int, int]
    mass_kg: tuple[float, float]
    same_names: bool
    mass_matrix: float | None
    com_m: float | None
    bias: float | None
    states: int = _STATES


def pinocchio_model(mjcf: str) -> pin.Model:
    """Pinocchio's own reading of a plain MJCF text (it reads files only), with one joint for each hinge.

    The massless links of ``split_hinges`` are frames of another kind than the robot's links: MuJoCo has none of them.
    The base loses the pose that it is drawn in: Pinocchio 4.1 misplaces a base that is drawn turned.
    """
    root = ElementTree.fromstring(mjcf)
    carriers = split_hinges(root)
    for body in root.findall("worldbody/body"):  # a free joint counts from the world
        body.attrib.pop("pos", None)
        body.attrib.pop("quat", None)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.xml"
        path.write_text(ElementTree.tostring(root, encoding="unicode"), encoding="utf-8")
        model = pin.buildModelFromMJCF(str(path))
    for carrier in carriers:
        model.frames[model.getFrameId(carrier)].type = pin.FrameType.OP_FRAME
    return model


def compare(model: mujoco.MjModel, other: pin.Model) -> Agreement:
    """Compare a model of MuJoCo (a free base and hinges) with one of Pinocchio."""
    dofs, masses = (model.nv, other.nv), (float(model.body_mass.sum()), float(sum(i.mass for i in other.inertias)))
    hinges = [model.joint(joint).name for joint in range(1, model.njnt)]
    same = hinges == list(other.names)[2:]
    if not same or dofs[0] != dofs[1]:
        return Agreement(dofs, masses, same, None, None, None)
    random, data, twin = np.random.default_rng(_SEED), mujoco.MjData(model), other.createData()
    rates, worst = np.random.default_rng(_SEED + 1), np.zeros(3)
    for _ in range(_STATES):
        data.qpos[:] = _random_configuration(model, random)
        data.qvel[:] = rates.normal(size=model.nv)
        mujoco.mj_forward(model, data)
        mine = _rigid_body_terms(model, data)
        q, v = _state_of(model, data)
        pin.computeAllTerms(other, twin, q, v)
        upper = np.triu(twin.M)
        others = (upper + np.triu(upper, 1).T, twin.com[0], twin.nle)
        worst = np.maximum(worst, [np.abs(one - two).max() for one, two in zip(mine, others, strict=True)])
    matrix, com, bias = worst.tolist()
    return Agreement(dofs, masses, same, matrix, com, bias)


def _state_of(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[np.ndarray, np.ndarray]:
    """(q, v) in Pinocchio's layout, the base's velocity in its own axes."""
    qpos, turn = data.qpos, _velocity_turn(model, data)
    return np.concatenate((qpos[:3], qpos[4:7], qpos[3:4], qpos[7:])), turn.T @ data.qvel


def _velocity_turn(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """T (nv, nv), v_MuJoCo = T v_Pinocchio: MuJoCo has the base's linear velocity in world, Pinocchio in the base."""
    turn = np.eye(model.nv)
    turn[:3, :3] = data.xmat[model.jnt_bodyid[0]].reshape(3, 3)
    return turn


def _rigid_body_terms(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(M, CoM in world, bias) of MuJoCo, for velocities v in Pinocchio's layout.

    With MuJoCo's own M_w w' + b_w = T^-T tau, w = T v, and w' = T v' + d, where d = omega x v_base in world in its
    first rows: M = T^T M_w T and bias = T^T (b_w + M_w d).
    """
    matrix, turn = np.zeros((model.nv, model.nv)), _velocity_turn(model, data)
    mujoco.mj_fullM(model, data, matrix)
    drift = np.zeros(model.nv)
    drift[:3] = np.cross(turn[:3, :3] @ data.qvel[3:6], data.qvel[:3])
    return turn.T @ matrix @ turn, data.subtree_com[0].copy(), turn.T @ (data.qfrc_bias + matrix @ drift)


def agreement_problems(found: Agreement) -> list[Problem]:
    """What differs by more than rounding."""
    remedy = "this is a defect of the import: please report it with the MJCF"
    if found.mass_matrix is None or found.com_m is None or found.bias is None:
        reason = f"MuJoCo reads {found.dofs[0]} degrees of freedom and {found.mass_kg[0]:.3f} kg, "
        reason += f"Pinocchio {found.dofs[1]} and {found.mass_kg[1]:.3f} kg"
        return [Problem("agreement", reason, remedy)]
    if max(found.mass_matrix, found.com_m, found.bias) > LARGEST_DIFFERENCE:
        reason = f"MuJoCo and Pinocchio differ by {found.mass_matrix:.1e} in M, {found.com_m:.1e} m in the CoM "
        reason += f"and {found.bias:.1e} N m in the bias"
        return [Problem("agreement", reason, remedy)]
    return []


def lost_by_pinocchio(path: Path, model: mujoco.MjModel) -> str | None:
    """What Pinocchio would have dropped of the file as it is; None: nothing.

    Args:
        path: of the file.
        model: as MuJoCo compiles it.
    """
    try:
        raw = pin.buildModelFromMJCF(str(path))
    except Exception as error:  # whatever it cannot read; the plain MJCF is what counts
        return f"Pinocchio does not read the file as it is ({' '.join(str(error).split())[:120]})"
    mass, own = float(sum(inertia.mass for inertia in raw.inertias)), float(model.body_mass.sum())
    if raw.nv == model.nv and abs(mass - own) < 1e-6 * max(own, 1.0):
        return None
    return (
        f"Pinocchio would drop bodies of the file as it is (in <frame> or <replicate>): "
        f"{raw.nv} of {model.nv} degrees of freedom, {mass:.3f} of {own:.3f} kg"
    )


def _random_configuration(model: mujoco.MjModel, random: np.random.Generator) -> np.ndarray:
    """(nq,) within the joint ranges."""
    quaternion = random.normal(size=4)
    hinges = random.uniform(model.jnt_range[1:, 0], model.jnt_range[1:, 1])
    return np.concatenate((random.normal(size=3), quaternion / np.linalg.norm(quaternion), hinges))
