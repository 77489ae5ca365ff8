"""Whether MuJoCo and Pinocchio read the same robot: names, degrees of freedom, mass, M and CoM at random states."""

import tempfile
from pathlib import Path

import mujoco
import numpy as np

from surefoot.record import record
from surefoot.robot.pinocchio_library import pin
from surefoot.robot_import.problem import Problem

LARGEST_DIFFERENCE = 1e-9  # of an element of M [kg m2] and of the CoM [m]
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
        states: number of random states.
    """

    dofs: tuple[int, int]
    mass_kg: tuple[float, float]
    same_names: bool
    mass_matrix: float | None
    com_m: float | None
    states: int = _STATES


def pinocchio_model(mjcf: str) -> pin.Model:
    """Pinocchio's own reading of an MJCF text; it reads files only."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.xml"
        path.write_text(mjcf, encoding="utf-8")
        return pin.buildModelFromMJCF(str(path))


def compare(model: mujoco.MjModel, other: pin.Model) -> Agreement:
    """Compare a model of MuJoCo (a free base and hinges) with one of Pinocchio."""
    dofs, masses = (model.nv, other.nv), (float(model.body_mass.sum()), float(sum(i.mass for i in other.inertias)))
    hinges = [model.joint(joint).name for joint in range(1, model.njnt)]
    same = hinges == list(other.names)[2:]
    if not same or dofs[0] != dofs[1]:
        return Agreement(dofs, masses, same, None, None)
    random, data, twin = np.random.default_rng(_SEED), mujoco.MjData(model), other.createData()
    matrix, worst_matrix, worst_com = np.zeros((model.nv, model.nv)), 0.0, 0.0
    for _ in range(_STATES):
        qpos = _random_configuration(model, random)
        data.qpos[:] = qpos
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, matrix)
        q = np.concatenate((qpos[:3], qpos[4:7], qpos[3:4], qpos[7:]))
        # MuJoCo gives the base's linear velocity in world, Pinocchio in the base: v_world = R v_base
        turn = np.eye(model.nv)
        turn[:3, :3] = data.xmat[model.jnt_bodyid[0]].reshape(3, 3)
        upper = np.triu(pin.crba(other, twin, q))
        full = upper + np.triu(upper, 1).T
        worst_matrix = max(worst_matrix, float(np.abs(turn.T @ matrix @ turn - full).max()))
        com = pin.centerOfMass(other, twin, q)
        worst_com = max(worst_com, float(np.abs(data.subtree_com[0] - com).max()))
    return Agreement(dofs, masses, same, worst_matrix, worst_com)


def agreement_problems(found: Agreement) -> list[Problem]:
    """What differs by more than rounding."""
    remedy = "this is a defect of the import: please report it with the MJCF"
    if found.mass_matrix is None or found.com_m is None:
        reason = f"MuJoCo reads {found.dofs[0]} degrees of freedom and {found.mass_kg[0]:.3f} kg, "
        reason += f"Pinocchio {found.dofs[1]} and {found.mass_kg[1]:.3f} kg"
        return [Problem("agreement", reason, remedy)]
    if max(found.mass_matrix, found.com_m) > LARGEST_DIFFERENCE:
        reason = f"MuJoCo and Pinocchio differ by {found.mass_matrix:.1e} in M and {found.com_m:.1e} m in the CoM"
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
