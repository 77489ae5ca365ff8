"""The only place that knows how MuJoCo lays out a state.

MuJoCo: quaternion (w, x, y, z), pelvis linear velocity in world axes. Pinocchio: quaternion (x, y, z, w), pelvis linear
velocity in pelvis axes. Both: angular velocity in pelvis axes, joints in the same order (the file's).
"""

import numpy as np

from surefoot.robot.description import RobotState

_TO_XYZW = np.array([0, 1, 2, 4, 5, 6, 3])
_TO_WXYZ = [0, 1, 2, 6, 3, 4, 5]


def state_from_mujoco(qpos: np.ndarray, qvel: np.ndarray, rotation_pelvis: np.ndarray, time_s: float) -> RobotState:
    """MuJoCo's qpos, qvel and base orientation (3, 3) as a RobotState of our own copies."""
    q, v = qpos.copy(), qvel.copy()
    q[:7] = qpos.take(_TO_XYZW)
    np.dot(qvel[:3], rotation_pelvis, out=v[:3])
    return RobotState(q, v, time_s)


def qpos_from_q(q: np.ndarray) -> np.ndarray:
    """Pinocchio's q in MuJoCo's layout."""
    qpos = q.copy()
    qpos[:7] = q[_TO_WXYZ]
    return qpos
