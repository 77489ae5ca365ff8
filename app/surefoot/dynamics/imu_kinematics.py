"""Feet and base as seen from the inertial measurement unit: what joint angles alone say, whatever the base does."""

import numpy as np

from surefoot.dynamics.model import foot_frame_name, with_foot_frames
from surefoot.errors import InvalidInput
from surefoot.geometry.rotations import cross
from surefoot.record import record
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.pinocchio_library import pin
from surefoot.robot.sensing import ImuMount


@record
class ImuView:
    """Relative placements and motions; all in IMU axes, seen by an observer that moves and turns with the IMU.

    Attributes:
        feet_position: (2, 3) ankle centres from the IMU [m].
        feet_rotation: (2, 3, 3) foot axes -> IMU axes.
        feet_jacobian: (2, 6, n) joint rates -> linear [m/s] and angular [rad/s] velocity of the feet.
        base_position: (3,) the base's origin from the IMU [m].
        base_rotation: (3, 3) base axes -> IMU axes.
        base_velocity: (6,) linear [m/s] and angular [rad/s] velocity of the base's origin; 0 for an IMU on the base.
    """

    feet_position: np.ndarray
    feet_rotation: np.ndarray
    feet_jacobian: np.ndarray
    base_position: np.ndarray
    base_rotation: np.ndarray
    base_velocity: np.ndarray


class ImuKinematics:
    """Computes the view from an IMU.

    Args:
        robot: the nominal robot.
        mount: where the IMU sits; raises InvalidInput, listing the links, where there is no such one.
    """

    def __init__(self, robot: RobotDescription, mount: ImuMount):
        if mount.body not in robot.links:
            raise InvalidInput("sensors.imu_body", mount.body, "no such link", robot.links)
        self._model = with_foot_frames(robot)
        self._feet = tuple(self._model.getFrameId(foot_frame_name(foot)) for foot in robot.feet)
        link = self._model.getFrameId(mount.body)
        frame = self._model.frames[link]
        self._joint = frame.parentJoint
        self._in_joint = frame.placement * pin.SE3(mount.rotation_in_body, mount.position_in_body)
        self._on_base = self._joint == 1  # the free-flyer
        self._has_base_axes = self._on_base and self._in_joint.rotation.tolist() == np.eye(3).tolist()
        self._data = self._model.createData()
        self._q = pin.neutral(self._model)
        self._still = np.zeros(6)

    def __deepcopy__(self, memo: dict[int, object]) -> "ImuKinematics":
        """Itself: nothing in it outlives a call, so that checkpoints need no copy."""
        return self

    def at(self, joint_positions: np.ndarray, joint_velocities: np.ndarray) -> ImuView:
        """The view at joint angles (n,) [rad] and rates (n,) [rad/s]."""
        model, data, axes = self._model, self._data, pin.LOCAL_WORLD_ALIGNED
        self._q[7:] = joint_positions
        pin.computeJointJacobians(model, data, self._q)  # the base stands at the origin: its axes are the world's
        imu = data.oMi[self._joint] * self._in_joint
        R_imu, p_imu = imu.rotation, imu.translation
        base_position, base_rotation = -p_imu.dot(R_imu), R_imu.T
        positions, rotations = np.empty((2, 3)), np.empty((2, 3, 3))
        jacobians = np.empty((2, 6, len(joint_positions)))
        for i, frame in enumerate(self._feet):
            placement = pin.updateFramePlacement(model, data, frame)
            jacobian = pin.getFrameJacobian(model, data, frame, axes)[:, BASE_DOFS:]
            positions[i] = placement.translation
            rotations[i] = placement.rotation
            jacobians[i] = jacobian
        positions = (positions - p_imu).dot(R_imu)
        if not self._has_base_axes:
            rotations = np.matmul(base_rotation, rotations)
            jacobians = np.matmul(base_rotation, jacobians.reshape(4, 3, -1)).reshape(jacobians.shape)
        base_velocity = self._still
        if not self._on_base:  # take off how the IMU moves itself
            own = self._own_jacobian()
            for jacobian, position in zip(jacobians, positions, strict=True):
                jacobian[:3] -= own[:3] + np.cross(own[3:], position, axis=0)
                jacobian[3:] -= own[3:]
            v, w = np.split(own.dot(joint_velocities), 2)
            base_velocity = -np.concatenate((v + cross(w, base_position), w))
        return ImuView(positions, rotations, jacobians, base_position, base_rotation, base_velocity)

    def _own_jacobian(self) -> np.ndarray:
        """(6, n) joint rates -> velocity of the IMU on a base at rest, IMU axes."""
        jacobian = pin.getJointJacobian(self._model, self._data, self._joint, pin.LOCAL)
        return self._in_joint.toActionMatrixInverse().dot(jacobian[:, BASE_DOFS:])
