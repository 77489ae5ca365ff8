"""Reads the ideal signals of an IMU from MuJoCo."""

import mujoco
import numpy as np

from surefoot.robot.sensing import ImuMount


class ImuProbe:
    """What an ideal IMU measured over the last step.

    The accelerometer is MuJoCo's own sensor. A gyro of MuJoCo would be one step older than the joints' angles, since a
    step measures before it moves; the angular velocity after the step, by the Jacobian of before it, is the one that
    the body has just turned with, exact for the free body.

    Args:
        model: the world, built with the IMU.
        mount: where it sits.
        name: of its site and its accelerometer.
    """

    def __init__(self, model: mujoco.MjModel, mount: ImuMount, name: str):
        self._site, self._body = model.site(name).id, model.body(mount.body).id
        self._address = int(model.sensor(name).adr[0])
        self._jacobian = np.empty((3, model.nv))

    def gyro(self, model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
        """(3,) angular velocity, IMU axes [rad/s]."""
        mujoco.mj_jacBody(model, data, None, self._jacobian, self._body)
        return self._jacobian.dot(data.qvel).dot(self._axes(data))

    def accelerometer(self, data: mujoco.MjData) -> np.ndarray:
        """(3,) specific force, IMU axes [m/s2]."""
        return data.sensordata[self._address : self._address + 3].copy()

    def accelerometer_at_rest(self, model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
        """(3,) likewise, of a robot that stands still."""
        return -model.opt.gravity.dot(self._axes(data))

    def _axes(self, data: mujoco.MjData) -> np.ndarray:
        return data.site_xmat[self._site].reshape(3, 3)
