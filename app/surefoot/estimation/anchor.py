"""``anchor``: an attitude filter on the IMU, and the place where the loaded feet say that the robot is.

What a foot says is where it was put down (its anchor) less how it lies from the IMU. A foot in the air takes its anchor
along; one that carries keeps it, and gives way only slowly, so that two feet come to agree without a jump.
"""

import math
from collections.abc import Sequence

import numpy as np

from surefoot.dynamics.imu_kinematics import ImuKinematics, ImuView
from surefoot.estimation.anchored_foot import AnchoredFoot
from surefoot.estimation.attitude import AttitudeFilter
from surefoot.estimation.base_state import ImuPose, imu_pose, robot_state
from surefoot.estimation.contact import FootContact
from surefoot.estimation.interface import Estimate, step_between
from surefoot.estimation.joint_filter import JointFilter
from surefoot.geometry.triples import Triple, blend, combine, cross_product
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.sensing import ImuMount, SensorNoise, SensorReadings

# At the start the robot is told its attitude: so long, what the accelerometer differs by is its bias, unless the data
# sheet has less of it than the attitude may be off; likewise what a gyro differs by from feet that stand
CALIBRATION_S, TOLD_TILT_RAD = 1.0, 2e-3
# Rates below are chosen, on Bip with the sensors ``robot``
BIAS_GAIN, BIAS_S = 3.0, 0.2  # the bias is found at 15 1/s at first, and ever more slowly, as a mean would be
POSITION_RATE = 30.0  # 1/s with which the position follows the feet: encoders are noisy, velocity is smooth
# What it admits to be wrong by; chosen, about the errors found standing with ``robot``
VELOCITY_M_S, TILT_NOISE_RAD, HEIGHT_M = 5e-3, 1e-3, 2e-3
STEP_M, STEP_YAW_RAD = 2e-3, 2e-3  # more with each step
_OF_A_STEP = np.diag((0.0, 0.0, STEP_YAW_RAD**2, 0.0, 0.0, 0.0, *3 * (STEP_M**2,)))


class Anchor:
    """Composes attitude filter, kinematics and anchors.

    Args:
        robot: the nominal robot.
        mount: where the IMU sits.
        noise: what the sensors' data sheets say.
    """

    def __init__(self, robot: RobotDescription, mount: ImuMount, noise: SensorNoise):
        self._robot, self._noise, self._kinematics = robot, noise, ImuKinematics(robot, mount)
        self._attitude, self._feet = AttitudeFilter(robot.gravity), self._new_feet()
        self._joints = JointFilter(noise)
        self._finds_accelerometer_bias = noise.accelerometer_bias > TOLD_TILT_RAD * robot.gravity
        self._finds_gyro_bias = self._finds_accelerometer_bias or noise.gyro_bias * CALIBRATION_S > TOLD_TILT_RAD
        self._position = (0.0, 0.0, 0.0)
        self._shares = 0.5, 0.5
        self._last_s, self._start_s = math.nan, math.nan
        self._gyro, self._accelerometer = [0.0] * 3, [0.0] * 3
        self._covariance, self._stood = np.zeros((9, 9)), (False, False)

    def reset(self, state: RobotState) -> None:
        """Start from a state that is told; see the interface."""
        view = self._kinematics.at(state.q[7:], state.v[6:])
        pose = imu_pose(state, view)
        self._attitude, self._feet = AttitudeFilter(self._robot.gravity), self._new_feet()
        self._joints.start(state.q[7:], state.v[6:])
        self._attitude.rotation, self._attitude.velocity = pose.rotation, tuple(pose.velocity.tolist())
        self._position = tuple(pose.position.tolist())
        places = pose.position + view.feet_position.dot(pose.rotation.T)
        for foot, place, rotation in zip(self._feet, places.tolist(), view.feet_rotation, strict=True):
            foot.put(tuple(place), pose.rotation.dot(rotation))
        self._shares = 0.5, 0.5
        self._last_s = math.nan
        tilt = TILT_NOISE_RAD**2 + (0.1 * self._noise.accelerometer_bias / self._robot.gravity) ** 2
        self._covariance = np.diag((tilt, tilt, 1e-8, *3 * (VELOCITY_M_S**2,), 1e-8, 1e-8, HEIGHT_M**2))
        self._stood = True, True

    def tick(self, readings: SensorReadings) -> Estimate:
        """Take the readings of one millisecond."""
        filter_ = self._attitude
        step_s = step_between(self._last_s, readings.time_s)
        gyro, accelerometer = readings.gyro.tolist(), readings.accelerometer.tolist()
        if math.isnan(self._last_s):
            self._start_s = readings.time_s
        else:
            means = combine(0.5, self._gyro, 0.5, gyro), combine(0.5, self._accelerometer, 0.5, accelerometer)
            filter_.predict(*means, step_s)
        self._last_s, self._gyro, self._accelerometer = readings.time_s, gyro, accelerometer
        joints = self._joints.update(readings.joint_positions, readings.joint_velocities, step_s)
        view = self._kinematics.at(*joints)
        R, omega = filter_.rotation, np.array(combine(1.0, gyro, -1.0, filter_.gyro_bias))
        turn, (left, right) = R.dot(omega).tolist(), self._feet
        positions, velocities = view.feet_position.dot(R.T), view.feet_velocity.reshape(4, 3).dot(R.T)
        linear_left, angular_left, linear_right, angular_right = velocities.tolist()
        wrench_left, wrench_right = readings.feet.wrenches.tolist()
        left.feel(wrench_left, combine(1.0, turn, 1.0, angular_left), R.dot(view.feet_rotation[0]), step_s)
        right.feel(wrench_right, combine(1.0, turn, 1.0, angular_right), R.dot(view.feet_rotation[1]), step_s)
        self._note_steps(left.hold > 0.5, right.hold > 0.5)
        # how far the soles are from their anchors, and how fast the IMU moves if the feet stand
        shares, hold = self._share(left.hold, right.hold)
        by_feet = _mean(shares, left.turned, right.turned)
        lever, passing = _mean(shares, *positions.tolist()), _mean(shares, linear_left, linear_right)
        velocity = combine(-1.0, passing, 1.0, cross_product(lever, turn))
        since_s = readings.time_s - self._start_s
        calibrates = since_s < CALIBRATION_S
        bias_rate = BIAS_GAIN / (BIAS_S + since_s) if calibrates and self._finds_accelerometer_bias else 0.0
        unknown = calibrates and self._finds_gyro_bias
        filter_.correct(velocity, by_feet, hold, step_s, bias_rate, gyro_unknown=unknown)
        self._settle(view, shares, hold, step_s)
        pose = ImuPose(filter_.rotation, np.array(filter_.velocity), np.array(self._position))
        state = robot_state(pose, omega, view, joints, readings.time_s)
        return Estimate(state, readings.feet, self._covariance)

    def _note_steps(self, left: bool, right: bool) -> None:
        """A foot that is put down takes over the errors of all before it, and adds its own."""
        stood = self._stood
        if (left, right) != stood:
            steps = (left and not stood[0]) + (right and not stood[1])
            self._covariance = self._covariance + steps * _OF_A_STEP
            self._stood = left, right

    def _share(self, left: float, right: float) -> tuple[tuple[float, float], float]:
        """Shares of the feet, and how much both together hold; in the air the last shares stay."""
        total = left + right
        if total > 1e-9:
            self._shares = left / total, right / total
        return self._shares, min(1.0, total)

    def _settle(self, view: ImuView, shares: tuple[float, float], hold: float, step_s: float) -> None:
        """Move the IMU to where the anchors have it, and the anchors of feet that do not hold to where they are."""
        left, right = self._feet
        from_imu = to_left, to_right = view.feet_position.dot(self._attitude.rotation.T).tolist()
        predicted = combine(1.0, self._position, step_s, self._attitude.velocity)
        by_anchors = combine(1.0, _mean(shares, left.place, right.place), -1.0, _mean(shares, to_left, to_right))
        follow = hold * POSITION_RATE * step_s / (1.0 + POSITION_RATE * step_s)
        self._position = position = blend(predicted, by_anchors, follow)
        for foot, lies in zip(self._feet, from_imu, strict=True):
            foot.settle(combine(1.0, position, 1.0, lies), step_s)

    def _new_feet(self) -> tuple[AnchoredFoot, AnchoredFoot]:
        robot = self._robot
        turning = math.hypot(self._noise.gyro, math.sqrt(6.0) * self._noise.joint_velocity)
        weight = robot.mass_kg * robot.gravity
        left, right = (AnchoredFoot(FootContact(foot, weight, turning)) for foot in robot.feet)
        return left, right


def _mean(shares: tuple[float, float], left: Sequence[float], right: Sequence[float]) -> Triple:
    """Of both feet, weighted."""
    return combine(shares[0], left, shares[1], right)
