"""Where the plant's own centre of mass is now: of the true masses at the true state."""

import mujoco
import numpy as np


class TrueCom:
    """Computes it in a copy of the world's data: what the last step left behind stays as it is.

    Args:
        model: the world.
        base: number of the robot's free body.
    """

    def __init__(self, model: mujoco.MjModel, base: int):
        self._model, self._base = model, base
        self._data = mujoco.MjData(model)

    def at(self, qpos: np.ndarray, qvel: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Position (3,) [m] and velocity (3,) [m/s] in world, at a state in MuJoCo's layout."""
        model, data = self._model, self._data
        data.qpos[:], data.qvel[:] = qpos, qvel
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        return data.subtree_com[self._base].copy(), data.subtree_linvel[self._base].copy()
