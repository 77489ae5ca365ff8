"""A robot's model file as MuJoCo compiles it, MJCF or URDF."""

import json
from collections.abc import Collection
from pathlib import Path

import mujoco
import numpy as np

from surefoot.errors import InvalidInput
from surefoot.record import record
from surefoot.robot.urdf_files import is_urdf
from surefoot.robot_import.mjcf_source import read_mjcf
from surefoot.robot_import.posture_search import RANGE_MARGIN
from surefoot.robot_import.problem import Problem
from surefoot.robot_import.urdf_source import read_urdf


@record
class ModelSource:
    """What was read.

    Attributes:
        model: as its owner wrote it.
        is_urdf: whether from a URDF.
        moved_meshes: names of the meshes that do not lie as in their files.
        changed: what of the model is other than in the file, one line each.
        left_out: what of the file is not in the model, one line each.
        idle_joints: names of the joints that move nothing that has mass.
    """

    model: mujoco.MjModel
    is_urdf: bool
    moved_meshes: frozenset[str] = frozenset()
    changed: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    idle_joints: tuple[str, ...] = ()

    @property
    def effort(self) -> str:
        """What the file calls the torque limit of a joint."""
        return "effort of the joint's <limit>" if self.is_urdf else "joint actuatorfrcrange"

    def posture(self, frozen: Collection[str]) -> tuple[np.ndarray, list[str]]:
        """Configuration (nq,) to stand in without a keyframe, and the joints that it moves from where they are drawn.

        A URDF is drawn at 0, wherever its ranges are: a hinge that is at an end of its range there, or beyond, is moved
        inside, if it is not taken out. An MJCF stays as it is drawn.
        """
        model, moved = self.model, []
        qpos = model.qpos0.copy()
        for joint in range(model.njnt) if self.is_urdf else ():
            lower, upper = model.jnt_range[joint]
            margin = RANGE_MARGIN * (upper - lower)
            is_kept = model.jnt_limited[joint] and model.joint(joint).name not in frozen
            if is_kept and not lower + margin <= 0.0 <= upper - margin:
                qpos[model.jnt_qposadr[joint]] = np.clip(0.0, lower + margin, upper - margin)
                moved.append(model.joint(joint).name)
        return qpos, moved

    def problems(self, frozen: Collection[str]) -> list[Problem]:
        """Joints that move nothing, but for those that are taken out."""
        idle = [name for name in self.idle_joints if name not in frozen]
        if not idle:
            return []
        reason = f"nothing that has mass hangs on the joints {', '.join(idle)}"
        remedy = f"freeze them in robot.toml: frozen = {json.dumps(idle)}, or give their links an <inertial>"
        return [Problem("joints", reason, remedy)]


def read_model(path: Path) -> ModelSource:
    """Read an MJCF or a URDF. Raises InvalidInput: it cannot be read, or means files that are nowhere."""
    if not path.is_file():
        raise InvalidInput("robot", str(path), "cannot be read: there is no such file")
    if is_urdf(path):
        urdf = read_urdf(path)
        return ModelSource(
            model=urdf.model,
            is_urdf=True,
            changed=urdf.changed,
            left_out=urdf.left_out,
            idle_joints=urdf.idle_joints,
        )
    model, moved_meshes = read_mjcf(path)
    return ModelSource(model=model, is_urdf=False, moved_meshes=moved_meshes)
