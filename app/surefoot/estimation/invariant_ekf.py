"""``invariant-ekf``: IMU and both feet in one filter, with biases; a foot that may tip or turn is believed less."""

import math

import numpy as np

from surefoot.dynamics.imu_kinematics import ImuKinematics, ImuView
from surefoot.estimation.base_state import ImuPose, base_covariance, imu_pose, robot_state
from surefoot.estimation.contact import FootContact, FootTrust
from surefoot.estimation.interface import Estimate, step_between
from surefoot.estimation.invariant_filter import (
    ACCELEROMETER_BIAS,
    ANKLES,
    ERRORS,
    GYRO_BIAS,
    POSITION,
    ROTATION,
    SOLES,
    VELOCITY,
    FilterNoise,
    InvariantFilter,
)
from surefoot.estimation.joint_filter import JointFilter
from surefoot.geometry.rotations import skew
from surefoot.geometry.triples import combine
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.sensing import ImuMount, SensorNoise, SensorReadings

SAMPLE_S = 1e-3  # the data sheets tell of samples at this rate
# What the start is known to, which is told: a robot is switched on standing on ground that is known to be level
START_TILT_RAD, START_YAW_RAD, START_POSITION_M, START_SPEED_M_S = 2e-3, 1e-4, 1e-4, 1e-2
GYRO_WALK, ACCELEROMETER_WALK = 1e-5, 1e-4  # biases barely wander [rad/s/sqrt(s)], [m/s2/sqrt(s)]

# How a foot may move [m/sqrt(s)], [rad/sqrt(s)]: flat on the ground, which is a little soft; nearly tipping; in the air
STANDING, AT_EDGE, IN_AIR = (3e-4, 1e-3), (3e-3, 1.5e-2), (1.0, 5.0)
TURNS_FOR_S = 0.1  # a sole that turns goes on turning as fast for about so long
ROLLING_ARM_M = 0.1  # and turns about a point that far from the ankle
FINEST_M, FINEST_RAD = 2e-4, 5e-4  # no kinematics is better known than this
JOINT_NOISE_TICKS = 10  # what the encoders' noise does to the feet goes with the posture: it hardly changes in 10 ms
_MOVES_BASE = np.r_[0:9, 21:24]
_OF_BASE = np.ix_(_MOVES_BASE, _MOVES_BASE)  # orientation, velocity, position, and the gyro's bias


class InvariantEKF:
    """Composes the filter: kinematics in, trust in the feet, state out.

    Args:
        robot: the nominal robot.
        mount: where the IMU sits.
        noise: what the sensors' data sheets say.
    """

    def __init__(self, robot: RobotDescription, mount: ImuMount, noise: SensorNoise):
        self._robot, self._noise = robot, noise
        self._kinematics = ImuKinematics(robot, mount)
        self._gyro_noise = max(noise.gyro, 1e-4)
        accelerometer = max(noise.accelerometer, 1e-2)
        root = math.sqrt(SAMPLE_S)
        self._densities = FilterNoise(self._gyro_noise * root, accelerometer * root, GYRO_WALK, ACCELEROMETER_WALK)
        self._joint_noise = max(noise.joint_position, 1e-5)
        self._finest = np.diag([FINEST_M**2] * 6 + [FINEST_RAD**2] * 6)
        self._filter = InvariantFilter(self._densities, robot.gravity)
        self._contacts, self._joints = self._new_contacts(), JointFilter(noise)
        self._last_s, self._gyro, self._accelerometer = math.nan, [0.0] * 3, [0.0] * 3
        self._ticks, self._seen_noise = 0, self._finest

    def reset(self, state: RobotState) -> None:
        """Start from a state that is told; see the interface."""
        view = self._kinematics.at(state.q[7:], state.v[6:])
        pose = imu_pose(state, view)
        self._filter = f = InvariantFilter(self._densities, self._robot.gravity)
        self._contacts = self._new_contacts()
        self._joints.start(state.q[7:], state.v[6:])
        self._last_s, self._ticks = math.nan, 0
        f.rotation = pose.rotation
        f.vectors = np.vstack((pose.velocity, pose.position, pose.position + view.feet_position.dot(pose.rotation.T)))
        f.soles = [pose.rotation.dot(rotation) for rotation in view.feet_rotation]
        f.covariance = self._start_covariance(f)

    def tick(self, readings: SensorReadings) -> Estimate:
        """Take the readings of one millisecond."""
        f, step_s = self._filter, step_between(self._last_s, readings.time_s)
        gyro, accelerometer = readings.gyro.tolist(), readings.accelerometer.tolist()
        joints = self._joints.update(readings.joint_positions, readings.joint_velocities, step_s)
        view = self._kinematics.at(*joints)
        trust = self._trust(view, gyro, readings.feet.wrenches, step_s)
        if not math.isnan(self._last_s):  # between two samples the mean of both
            means = combine(0.5, self._gyro, 0.5, gyro), combine(0.5, self._accelerometer, 0.5, accelerometer)
            f.propagate(*means, step_s, _may_move(trust))
        self._last_s, self._gyro, self._accelerometer = readings.time_s, gyro, accelerometer
        if self._ticks % JOINT_NOISE_TICKS == 0:
            self._seen_noise = self._joint_covariance(joints[0])
        self._ticks += 1
        f.correct(view.feet_position, view.feet_rotation, self._seen_noise)
        pose = ImuPose(f.rotation, f.vectors[0], f.vectors[1])
        omega = np.array(combine(1.0, gyro, -1.0, f.gyro_bias))
        state = robot_state(pose, omega, view, joints, readings.time_s)
        of_base = f.covariance[:9, :9] if view.is_base else f.covariance[_OF_BASE]
        covariance = base_covariance(pose, omega, view, of_base, self._gyro_noise)
        return Estimate(state, readings.feet, covariance)

    def _trust(
        self, view: ImuView, gyro: list[float], wrenches: np.ndarray, step_s: float
    ) -> tuple[FootTrust, FootTrust]:
        f, (left, right) = self._filter, self._contacts
        turn = f.rotation.dot(np.array(combine(1.0, gyro, -1.0, f.gyro_bias))).tolist()
        _, of_left, _, of_right = view.feet_velocity.reshape(4, 3).dot(f.rotation.T).tolist()
        wrench_left, wrench_right = wrenches.tolist()
        return (
            left.update(wrench_left, combine(1.0, turn, 1.0, of_left), step_s),
            right.update(wrench_right, combine(1.0, turn, 1.0, of_right), step_s),
        )

    def _joint_covariance(self, angles: np.ndarray) -> np.ndarray:
        """(12, 12) of ankles, then soles, in world axes, by the noise of the encoders."""
        R, jacobians = self._filter.rotation, self._kinematics.feet_jacobians(angles)
        rows = np.concatenate((jacobians[:, :3], jacobians[:, 3:])).reshape(4, 3, -1)
        in_world = np.matmul(R, rows).reshape(12, -1) * self._joint_noise
        return in_world.dot(in_world.T) + self._finest

    def _start_covariance(self, f: InvariantFilter) -> np.ndarray:
        """Independent errors of where the robot is, and feet where it says they are."""
        noise = self._noise
        spread = np.zeros(15)
        spread[:3] = START_TILT_RAD, START_TILT_RAD, START_YAW_RAD
        spread[3:6], spread[6:9] = START_SPEED_M_S, START_POSITION_M
        spread[9:12], spread[12:15] = max(noise.gyro_bias, 1e-4), max(noise.accelerometer_bias, 1e-3)
        L = np.zeros((ERRORS, 15))
        L[:9, :9] = np.eye(9)
        # told are plain errors: e_v = (v - v^) - e_R x v^, and so for the position
        L[VELOCITY, :3], L[POSITION, :3] = skew(f.vectors[0]), skew(f.vectors[1])
        for ankle, sole in zip(ANKLES, SOLES, strict=True):  # e_d = e_p, e_C = e_R: the joints say where they are
            L[ankle], L[sole] = L[POSITION], L[ROTATION]
        L[GYRO_BIAS, 9:12] = L[ACCELEROMETER_BIAS, 12:15] = np.eye(3)
        L *= spread
        P = L.dot(L.T)
        P[9:21, 9:21] += self._finest + self._joint_noise**2 * np.eye(12)
        return P

    def _new_contacts(self) -> tuple[FootContact, FootContact]:
        robot = self._robot
        weight = robot.mass_kg * robot.gravity
        turning = math.hypot(self._noise.gyro, math.sqrt(6.0) * self._noise.joint_velocity)
        left, right = (FootContact(foot, weight, turning) for foot in robot.feet)
        return left, right


def _may_move(trust: tuple[FootTrust, FootTrust]) -> np.ndarray:
    """(12,) process noise of ankles, then soles."""
    both = [_densities(foot) for foot in trust]
    (left, left_sole), (right, right_sole) = both
    return np.array((left, left, left, right, right, right, *3 * (left_sole,), *3 * (right_sole,)))


def _densities(trust: FootTrust) -> tuple[float, float]:
    """Of one foot's ankle and sole: between standing and in the air in proportion on a logarithmic scale."""
    if trust.load == 0.0:
        return IN_AIR
    turning = trust.turning_rad_s * math.sqrt(2.0 * TURNS_FOR_S)
    ankle = math.hypot(STANDING[0], trust.edge * AT_EDGE[0], ROLLING_ARM_M * turning)
    sole = math.hypot(STANDING[1], trust.edge * AT_EDGE[1], turning)
    if trust.load == 1.0:
        return ankle, sole
    off = 1.0 - trust.load
    return ankle * (IN_AIR[0] / ankle) ** off, sole * (IN_AIR[1] / sole) ** off
