"""Feet and base as seen from the inertial measurement unit: what joint angles alone say, whatever the base does."""

import numpy as np

from surefoot.dynamics.model import foot_frame_name, with_foot_frames
from surefoot.errors import InvalidInput
from surefoot.geometry.rotations import cross
from surefoot.record import record
from surefoot.robot.description import BASE_DOFS, RobotDescription
from surefoot.robot.pinocchio_library import pin
from surefoot.robot.sensing import ImuMount

_AXES = pin.LOCAL_WORLD_ALIGNED


@record
class ImuView:
    """Relative placements and motions; all in IMU axes, seen by an observer that moves and turns with the IMU.

    Attributes:
        feet_position: (2, 3) ankle centres from the IMU [m].
        feet_rotation: (2, 3, 3) foot axes -> IMU axes.
        feet_velocity: (2, 6) linear [m/s] and angular [rad/s] velocity of the feet.
        base_position: (3,) the base's origin from the IMU [m].
        base_rotation: (3, 3) base axes -> IMU axes.
        base_velocity: (6,) linear [m/s] and angular [rad/s] velocity of the base's origin; 0 for an IMU on the base.
        is_base: the IMU's frame is that of the base: the last three are 0, 1 and 0.
    """

    feet_position: np.ndarray
    feet_rotation: np.ndarray
    feet_velocity: np.ndarray
    base_position: np.ndarray
    base_rotation: np.ndarray
    base_velocity: np.ndarray
    is_base: bool


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
        self._on_base = self._joint == 1  # the free-flyer, which stands still at the origin here
        self._is_base = self._on_base and np.array_equal(self._in_joint.homogeneous, np.eye(4))
        self._data = data = self._model.createData()
        placements = [data.oMf[frame] for frame in self._feet]
        # Arrays that show Pinocchio's own memory, which stays where it is: to ask for them anew takes longer
        self._seen = tuple((placement.translation, placement.rotation) for placement in placements)
        self._q, self._v = pin.neutral(self._model), np.zeros(self._model.nv)
        self._fixed = np.zeros(3), np.eye(3), np.zeros(6)

    def __deepcopy__(self, memo: dict[int, object]) -> "ImuKinematics":
        """Itself: nothing in it outlives a call, so that checkpoints need no copy."""
        return self

    def at(self, joint_positions: np.ndarray, joint_velocities: np.ndarray) -> ImuView:
        """The view at joint angles (n,) [rad] and rates (n,) [rad/s]."""
        model, data = self._model, self._data
        self._q[7:], self._v[BASE_DOFS:] = joint_positions, joint_velocities
        pin.forwardKinematics(model, data, self._q, self._v)
        positions, rotations, velocities = np.empty((2, 3)), np.empty((2, 3, 3)), np.empty((2, 6))
        for i, (frame, (position, rotation)) in enumerate(zip(self._feet, self._seen, strict=True)):
            pin.updateFramePlacement(model, data, frame)
            positions[i], rotations[i] = position, rotation
            velocities[i] = pin.getFrameVelocity(model, data, frame, _AXES).vector
        if self._is_base:
            return ImuView(positions, rotations, velocities, *self._fixed, True)
        imu = data.oMi[self._joint] * self._in_joint
        R_imu, p_imu = imu.rotation, imu.translation
        base_position, base_rotation, base_velocity = -p_imu.dot(R_imu), R_imu.T, self._fixed[2]
        positions = (positions - p_imu).dot(R_imu)
        rotations = np.matmul(base_rotation, rotations)
        velocities = velocities.reshape(4, 3).dot(R_imu).reshape(2, 6)
        if not self._on_base:  # take off how the IMU moves itself
            own = self._in_joint.actInv(data.v[self._joint])
            v, w = own.linear, own.angular
            velocities[:, :3] -= v + np.cross(w, positions)
            velocities[:, 3:] -= w
            base_velocity = -np.concatenate((v + cross(w, base_position), w))
        return ImuView(positions, rotations, velocities, base_position, base_rotation, base_velocity, False)

    def feet_jacobians(self, joint_positions: np.ndarray) -> np.ndarray:
        """(2, 6, n) joint rates -> velocity of the feet as in the view, at joint angles (n,) [rad]."""
        model, data = self._model, self._data
        self._q[7:] = joint_positions
        pin.computeJointJacobians(model, data, self._q)
        imu = data.oMi[self._joint] * self._in_joint
        feet = [pin.updateFramePlacement(model, data, frame).translation.copy() for frame in self._feet]
        jacobians = np.array(
            [pin.getFrameJacobian(model, data, frame, _AXES)[:, BASE_DOFS:] for frame in self._feet], order="C"
        )
        if not self._is_base:
            jacobians = np.matmul(imu.rotation.T, jacobians.reshape(4, 3, -1)).reshape(jacobians.shape)
        if not self._on_base:
            inverse = self._in_joint.toActionMatrixInverse()
            own = inverse.dot(pin.getJointJacobian(model, data, self._joint, pin.LOCAL)[:, BASE_DOFS:])
            for jacobian, foot in zip(jacobians, feet, strict=True):
                position = (foot - imu.translation).dot(imu.rotation)
                jacobian[:3] -= own[:3] + np.cross(own[3:], position, axis=0)
                jacobian[3:] -= own[3:]
        return jacobians
