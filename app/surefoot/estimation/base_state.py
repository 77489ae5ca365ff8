"""From the pose and velocity of the IMU to the state of the robot, and from its covariance to the base's."""

import numpy as np

from surefoot.dynamics.imu_kinematics import ImuView
from surefoot.dynamics.turns import skew_of
from surefoot.geometry.rotations import cross, quaternion_xyzw, rotation_from_xyzw
from surefoot.record import record
from surefoot.robot.description import RobotState

_AS_TOLD = np.eye(9, 12)


@record
class ImuPose:
    """Where the IMU is and how it moves.

    Attributes:
        rotation: (3, 3) IMU axes -> world.
        velocity: (3,) in world [m/s].
        position: (3,) in world [m].
    """

    rotation: np.ndarray
    velocity: np.ndarray
    position: np.ndarray


def robot_state(
    pose: ImuPose, angular_velocity: np.ndarray, view: ImuView, joints: tuple[np.ndarray, np.ndarray], time_s: float
) -> RobotState:
    """The state of a robot whose IMU is believed there.

    Args:
        pose: of the IMU.
        angular_velocity: (3,) of the IMU, its own axes [rad/s].
        view: from the IMU at these joint angles.
        joints: angles (n,) [rad] and velocities (n,) [rad/s].
        time_s: of the state [s].
    """
    R = pose.rotation
    angles, rates = joints
    if view.is_base:
        position, rotation, linear, angular = pose.position, R, pose.velocity.dot(R), angular_velocity
    else:
        into_base = view.base_rotation.T
        position, rotation = pose.position + R.dot(view.base_position), R.dot(view.base_rotation)
        linear = pose.velocity.dot(R) + cross(angular_velocity, view.base_position) + view.base_velocity[:3]
        linear, angular = into_base.dot(linear), into_base.dot(angular_velocity + view.base_velocity[3:])
    q = np.concatenate((position, quaternion_xyzw(rotation), angles))
    return RobotState(q, np.concatenate((linear, angular, rates)), time_s)


def imu_pose(state: RobotState, view: ImuView) -> ImuPose:
    """The other way round: the IMU of a robot in a state, seen by ``view`` at that state's joints."""
    base = rotation_from_xyzw(state.q[3:7])
    rotation = base.dot(view.base_rotation.T)
    angular = view.base_rotation.dot(state.v[3:6]) - view.base_velocity[3:]
    linear = view.base_rotation.dot(state.v[:3]) - view.base_velocity[:3] - cross(angular, view.base_position)
    return ImuPose(rotation, rotation.dot(linear), state.q[:3] - rotation.dot(view.base_position))


def base_covariance(
    pose: ImuPose, angular_velocity: np.ndarray, view: ImuView, covariance: np.ndarray, gyro_noise: float
) -> np.ndarray:
    """(9, 9) covariance of the base's orientation, velocity and position, "true minus believed" in world axes.

    An invariant error e_R turns the world about its origin: v - v^ = e_v + e_R x v^, p - p^ = e_p + e_R x p^, and so
    for the base, which is fixed to the IMU but for the joints between them. With r from the IMU to the base in world,
    an error of the angular velocity, that of the gyro's bias and of its last sample, moves the base by (error x r).

    Args:
        pose: of the IMU.
        angular_velocity: (3,) of the IMU, its own axes [rad/s].
        view: from the IMU.
        covariance: (12, 12) of e_R, e_v, e_p and the gyro's bias (IMU axes); without the last, (9, 9), where the IMU's
            frame is that of the base.
        gyro_noise: standard deviation of a sample [rad/s].
    """
    v, p = pose.velocity, pose.position
    if view.is_base:
        T = _AS_TOLD[:, :9].copy()
        T[3:6, :3], T[6:9, :3] = skew_of(v).T, skew_of(p).T
        return T.dot(covariance).dot(T.T)
    R, lever, T = pose.rotation, view.base_position, _AS_TOLD.copy()
    v = v + R.dot(cross(angular_velocity, lever) + view.base_velocity[:3])
    T[3:6, :3], T[6:9, :3] = skew_of(v).T, skew_of(p + R.dot(lever)).T
    by_gyro = R.dot(skew_of(lever))
    T[3:6, 9:12] = by_gyro  # -skew_of(r) times the error -R b of the angular velocity in world
    P = T.dot(covariance).dot(T.T)
    P[3:6, 3:6] += by_gyro.dot(by_gyro.T) * gyro_noise**2
    return P
