"""The tree of bodies and joints of a compiled model whose joints are one free joint and hinges."""

from collections.abc import Sequence

import mujoco
import numpy as np


class KinematicTree:
    """Which body hangs on which, and where everything is at one configuration.

    Args:
        model: compiled.
        qpos: configuration (nq,) in MuJoCo's layout.
    """

    def __init__(self, model: mujoco.MjModel, qpos: np.ndarray):
        self.model = model
        self.data = mujoco.MjData(model)
        self.data.qpos[:] = qpos
        mujoco.mj_kinematics(model, self.data)
        mujoco.mj_comPos(model, self.data)
        self.hinges = [j for j in range(model.njnt) if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE]
        free = next(j for j in range(model.njnt) if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE)
        self.base = int(model.jnt_bodyid[free])

    def body_name(self, body: int) -> str:
        """Its name; its number where it has none."""
        return self.model.body(body).name or f"body {body}"

    def joint_name(self, joint: int) -> str:
        """Its name."""
        return self.model.joint(joint).name

    def joint_names(self, joints: Sequence[int]) -> list[str]:
        """Their names."""
        return [self.joint_name(joint) for joint in joints]

    def chain(self, body: int) -> list[int]:
        """The hinges from the base down to a body."""
        joints: list[int] = []
        while body > 0:
            first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
            joints[:0] = [j for j in range(first, first + count) if j in self.hinges]
            body = int(self.model.body_parentid[body])
        return joints

    def link(self, body: int) -> list[int]:
        """All bodies that move as one with a body: those without a joint between."""
        weld = self.model.body_weldid[body]
        return [other for other in range(1, self.model.nbody) if self.model.body_weldid[other] == weld]

    def leaves(self) -> list[int]:
        """The bodies with a hinge below which no other hinge comes."""
        with_hinge = {int(self.model.jnt_bodyid[joint]) for joint in self.hinges}
        above = {int(body) for body in self.model.body_weldid[self.model.body_parentid[sorted(with_hinge)]]}
        return sorted(body for body in with_hinge if int(self.model.body_weldid[body]) not in above)

    def geoms(self, body: int) -> list[int]:
        """The geoms of all bodies that move as one with a body."""
        bodies = set(self.link(body))
        return [geom for geom in range(self.model.ngeom) if int(self.model.geom_bodyid[geom]) in bodies]

    def axis(self, joint: int) -> np.ndarray:
        """(3,) unit axis of a hinge in world."""
        return self.data.xaxis[joint].copy()

    def anchor(self, joint: int) -> np.ndarray:
        """(3,) a point on the axis of a hinge in world [m]."""
        return self.data.xanchor[joint].copy()

    def rotation(self, body: int) -> np.ndarray:
        """(3, 3) body -> world."""
        return self.data.xmat[body].reshape(3, 3).copy()

    def position(self, body: int) -> np.ndarray:
        """(3,) origin of a body in world [m]."""
        return self.data.xpos[body].copy()
