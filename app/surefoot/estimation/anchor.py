"""``anchor``: an attitude filter on the IMU, and the place where the loaded feet say that the robot is.

What a foot says is where it was put down (its anchor) less how it lies from the IMU. A foot in the air takes its anchor
along; one that carries keeps it, and gives way only slowly, so that two feet come to agree without a jump.
"""

import math

import numpy as np

from surefoot.dynamics.imu_kinematics import ImuKinematics, ImuView
from surefoot.estimation.attitude import AttitudeFilter
from surefoot.estimation.base_state import ImuPose, imu_pose, robot_state
from surefoot.estimation.contact import FootContact, FootTrust
from surefoot.estimation.interface import Estimate
from surefoot.estimation.joint_filter import JointFilter
from surefoot.geometry.rotations import cross, rotation_vector, turn_by
from surefoot.robot.description import RobotDescription, RobotState
from surefoot.robot.sensing import ImuMount, SensorNoise, SensorReadings

# At the start the robot is told its attitude: so long, what the accelerometer differs by is its bias, unless the data
# sheet has less of it than the attitude may be off
CALIBRATION_S, TOLD_TILT_RAD = 1.0, 2e-3
# Rates and trusts below are chosen, on Bip with the sensors ``robot``
BIAS_GAIN, BIAS_S = 3.0, 0.2  # the bias is found at 15 1/s at first, and ever more slowly, as a mean would be
POSITION_RATE = 30.0  # 1/s with which the position follows the feet: encoders are noisy, velocity is smooth
# 1/s with which a foot that carries gives way (by a fifth of what two feet disagree by in a step of 0.7 s), and its
# sole (which soft ground turns), and both in the air (at once: 1 over a tick)
SETTLING_RATE, SOLE_SETTLING_RATE, AIR_RATE = 0.3, 1.0, 1000.0
# What is left of a foot at its edge; a sole that turns so fast counts half: on a stone it turns by 0.1 rad/s and more
EDGE_TRUST, TURNING_RAD_S = 0.1, 0.05
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
        self._attitude, self._contacts = AttitudeFilter(robot.gravity), self._new_contacts()
        self._joints = JointFilter(noise)
        may_be_off = TOLD_TILT_RAD * robot.gravity
        self._calibration_s = CALIBRATION_S if noise.accelerometer_bias > may_be_off else 0.0
        self._position, self._anchors = np.zeros(3), np.zeros((2, 3))
        self._soles = [np.eye(3), np.eye(3)]
        self._weights = np.array((0.5, 0.5))
        self._last_s, self._start_s = math.nan, math.nan
        self._gyro, self._accelerometer = np.zeros(3), np.zeros(3)
        self._covariance, self._stood = np.zeros((9, 9)), (False, False)

    def reset(self, state: RobotState) -> None:
        """Start from a state that is told; see the interface."""
        view = self._kinematics.at(state.q[7:], state.v[6:])
        pose = imu_pose(state, view)
        self._attitude, self._contacts = AttitudeFilter(self._robot.gravity), self._new_contacts()
        self._joints.start(state.q[7:], state.v[6:])
        self._attitude.rotation, self._attitude.velocity = pose.rotation, pose.velocity
        self._position = pose.position
        self._anchors = pose.position + view.feet_position.dot(pose.rotation.T)
        self._soles = [pose.rotation.dot(rotation) for rotation in view.feet_rotation]
        self._weights = np.array((0.5, 0.5))
        self._last_s = math.nan
        tilt = TILT_NOISE_RAD**2 + (0.1 * self._noise.accelerometer_bias / self._robot.gravity) ** 2
        self._covariance = np.diag((tilt, tilt, 1e-8, *3 * (VELOCITY_M_S**2,), 1e-8, 1e-8, HEIGHT_M**2))
        self._stood = True, True

    def tick(self, readings: SensorReadings) -> Estimate:
        """Take the readings of one millisecond."""
        filter_ = self._attitude
        if math.isnan(self._last_s):
            self._start_s, step_s = readings.time_s, 0.0
        else:
            step_s = readings.time_s - self._last_s
            gyro, acceleration = (
                0.5 * (self._gyro + readings.gyro),
                0.5 * (self._accelerometer + readings.accelerometer),
            )
            filter_.predict(gyro, acceleration, step_s)
        self._last_s, self._gyro, self._accelerometer = readings.time_s, readings.gyro, readings.accelerometer
        joints = self._joints.update(readings.joint_positions, readings.joint_velocities, step_s)
        view = self._kinematics.at(*joints)
        R, omega = filter_.rotation, readings.gyro - filter_.gyro_bias
        # each foot by itself: how fast the IMU moves if this foot stands, and how far its sole is from its anchor
        motions = view.feet_velocity
        turning = (motions[:, 3:] + omega).dot(R.T)
        left, right = (
            _hold(contact.update(wrench, sole, step_s))
            for contact, wrench, sole in zip(self._contacts, readings.feet.wrenches, turning, strict=True)
        )
        self._note_steps(left > 0.5, right > 0.5)
        weights, hold = self._share(left, right)
        velocity = -R.dot(cross(omega, weights.dot(view.feet_position)) + weights.dot(motions[:, :3]))
        turned = np.array(
            [
                rotation_vector(R.dot(rotation).dot(sole.T))
                for rotation, sole in zip(view.feet_rotation, self._soles, strict=True)
            ]
        )
        since_s = readings.time_s - self._start_s
        bias_rate = BIAS_GAIN / (BIAS_S + since_s) if since_s < self._calibration_s else 0.0
        filter_.correct(velocity, -weights.dot(turned), hold, step_s, bias_rate)
        self._settle(view, (left, right), weights, hold, turned, step_s)
        pose = ImuPose(filter_.rotation, filter_.velocity, self._position)
        state = robot_state(pose, omega, view, joints, readings.time_s)
        return Estimate(state, readings.feet, self._covariance)

    def _note_steps(self, left: bool, right: bool) -> None:
        """A foot that is put down takes over the errors of all before it, and adds its own."""
        stood = self._stood
        if (left, right) != stood:
            steps = (left and not stood[0]) + (right and not stood[1])
            self._covariance = self._covariance + steps * _OF_A_STEP
            self._stood = left, right

    def _share(self, left: float, right: float) -> tuple[np.ndarray, float]:
        """Weights of the feet, and how much both together hold; in the air the last weights stay."""
        total = left + right
        if total > 1e-9:
            self._weights = np.array((left / total, right / total))
        return self._weights, min(1.0, total)

    def _settle(
        self,
        view: ImuView,
        holds: tuple[float, float],
        weights: np.ndarray,
        hold: float,
        turned: np.ndarray,
        step_s: float,
    ) -> None:
        """Move the IMU to where the anchors have it, and the anchors of feet that do not hold to where they are."""
        R, before = self._attitude.rotation, self._position
        feet = view.feet_position.dot(R.T)
        predicted = before + step_s * self._attitude.velocity
        follow = hold * POSITION_RATE * step_s / (1.0 + POSITION_RATE * step_s)
        self._position = predicted + follow * (weights.dot(self._anchors - feet) - predicted)
        in_air = [AIR_RATE * (1.0 - held) ** 4 for held in holds]
        gives = np.array([min(step_s * (SETTLING_RATE + rate), 1.0) for rate in in_air])
        self._anchors = self._anchors + gives[:, None] * (self._position + feet - self._anchors)
        self._soles = [
            turn_by(min(step_s * (SOLE_SETTLING_RATE + rate), 1.0) * off).dot(sole)
            for rate, off, sole in zip(in_air, turned, self._soles, strict=True)
        ]

    def _new_contacts(self) -> tuple[FootContact, FootContact]:
        robot = self._robot
        turning = math.hypot(self._noise.gyro, math.sqrt(6.0) * self._noise.joint_velocity)
        left, right = (FootContact(foot, robot.mass_kg * robot.gravity, turning) for foot in robot.feet)
        return left, right


def _hold(trust: FootTrust) -> float:
    """How much a foot keeps its anchor."""
    rolling = (trust.turning_rad_s / TURNING_RAD_S) ** 2
    return trust.load * (1.0 - (1.0 - EDGE_TRUST) * trust.edge) / (1.0 + rolling)
