"""kappa and its Jacobian H from MuJoCo: a second road to what ``dynamics`` computes with Pinocchio.

kappa(q) = [CoM 3, base orientation 3, left foot 6, right foot 6, joints in no leg]; two six-joint legs make H square.
"""

import mujoco
import numpy as np

from surefoot.record import record
from surefoot.robot_import.kinematic_tree import KinematicTree
from surefoot.robot_import.legs import Legs
from surefoot.robot_import.sole import Sole


@record
class FootPlace:
    """Where a foot is.

    Attributes:
        body: its index.
        ankle: (3,) the ankle's centre in world [m].
        rotation: (3, 3) foot frame -> world.
    """

    body: int
    ankle: np.ndarray
    rotation: np.ndarray


class TaskKinematics:
    """kappa of one robot at one configuration after the other.

    Args:
        tree: the robot; its configuration is moved.
        bodies: indices of the feet's bodies, left and right.
        soles: of the feet.
        legs: joints by what they move.
    """

    def __init__(self, tree: KinematicTree, bodies: tuple[int, int], soles: tuple[Sole, Sole], legs: Legs):
        self._tree, self._bodies, self._soles = tree, bodies, soles
        self.model, self.data = tree.model, tree.data
        self._upper = [int(self.model.jnt_dofadr[joint]) for joint in legs.upper]
        self._upper_q = [int(self.model.jnt_qposadr[joint]) for joint in legs.upper]

    def move(self, qpos: np.ndarray) -> None:
        """Compute everything at a configuration (nq,)."""
        self.data.qpos[:] = qpos
        self.data.qvel[:] = 0.0
        mujoco.mj_forward(self.model, self.data)

    def feet(self) -> tuple[FootPlace, FootPlace]:
        """Where the feet are."""
        return self._foot(0), self._foot(1)

    def com(self) -> np.ndarray:
        """(3,) in world [m]."""
        return self.data.subtree_com[self._tree.base].copy()

    def upper_angles(self) -> np.ndarray:
        """Angles of the joints in no leg [rad]."""
        return self.data.qpos[self._upper_q].copy()

    def jacobian(self) -> np.ndarray:
        """H (18 + number of joints in no leg, nv), velocities in MuJoCo's layout."""
        nv = self.model.nv
        com, base, unused = np.zeros((3, nv)), np.zeros((3, nv)), np.zeros((3, nv))
        mujoco.mj_jacSubtreeCom(self.model, self.data, com, self._tree.base)
        mujoco.mj_jacBody(self.model, self.data, unused, base, self._tree.base)
        rows = [com, base, *(self.foot_jacobian(index) for index in (0, 1))]
        return np.vstack([*rows, np.eye(nv)[self._upper]])

    def foot_jacobian(self, index: int) -> np.ndarray:
        """(6, nv) linear velocity of the ankle's centre and angular velocity of the foot, in world axes."""
        linear, angular = np.zeros((3, self.model.nv)), np.zeros((3, self.model.nv))
        mujoco.mj_jac(self.model, self.data, linear, angular, self._foot(index).ankle, self._bodies[index])
        return np.vstack((linear, angular))

    def _foot(self, index: int) -> FootPlace:
        body, sole = self._bodies[index], self._soles[index]
        rotation = self._tree.rotation(body)
        return FootPlace(
            body, self._tree.position(body) + rotation @ sole.ankle_in_body, rotation @ sole.rotation_in_body
        )
