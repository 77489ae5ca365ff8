"""All sensors of a robot: ideal signals in, readings out, noise from the run's own seed."""

import math

import numpy as np

from surefoot.robot.description import RobotDescription
from surefoot.robot.sensing import FootSensing, ImuMount, SensorNoise, SensorReadings
from surefoot.simulation.physics import TIMESTEP_S
from surefoot.simulation.sensors.channel import Channel, whole_ticks
from surefoot.simulation.sensors.joint_sensors import JointSensors, difference_noise
from surefoot.simulation.sensors.settings import SensorSettings
from surefoot.simulation.sensors.signals import IdealSignals

_MINUTE_S = 60.0  # drifts are said of a minute


def imu_mount(robot: RobotDescription, settings: SensorSettings) -> ImuMount:
    """The IMU at the origin of its link, in the link's axes."""
    body = robot.base if settings.imu_body == "base" else robot.trunk
    return ImuMount(body, np.zeros(3), np.eye(3))


def sensor_noise(settings: SensorSettings) -> SensorNoise:
    """What the sensors' data sheets would say: the settings, with the quantisers' part of the noise."""
    step = settings.encoder_step_rad / math.sqrt(12.0)
    return SensorNoise(
        gyro=settings.gyro_noise_rad_s,
        gyro_bias=settings.gyro_bias_rad_s,
        accelerometer=settings.accelerometer_noise_m_s2,
        accelerometer_bias=settings.accelerometer_bias_m_s2,
        joint_position=math.hypot(settings.encoder_noise_rad, settings.encoder_offset_rad, step),
        joint_velocity=math.hypot(settings.velocity_noise_rad_s, difference_noise(settings)),
        foot_force=settings.foot_force_noise_n,
        foot_force_bias=settings.foot_force_bias_n,
        foot_moment=settings.foot_moment_noise_nm,
        foot_moment_bias=settings.foot_moment_bias_nm,
    )


class Sensors:
    """IMU, joint sensors and foot sensors, each with a stream of noise of its own.

    The streams depend on the seed alone, and errors are drawn as multiples of their standard deviations: two runs that
    differ in one figure share all other errors.

    Args:
        settings: how good they are.
        joints: how many.
    """

    def __init__(self, settings: SensorSettings, joints: int):
        self._settings = s = settings
        self._imu_noise, self._foot_noise = (np.random.default_rng((s.seed, stream)) for stream in (1, 3))
        self._gyro_bias = s.gyro_bias_rad_s * self._imu_noise.standard_normal(3)
        self._accelerometer_bias = s.accelerometer_bias_m_s2 * self._imu_noise.standard_normal(3)
        self._foot_error = _wrenches(s.foot_force_bias_n, s.foot_moment_bias_nm) * self._foot_noise.standard_normal(
            (2, 6)
        )
        walk = math.sqrt(whole_ticks(s.foot_period_s) * TIMESTEP_S / _MINUTE_S)
        self._foot_walk = walk * _wrenches(s.foot_force_drift_n, s.foot_moment_drift_nm)
        self._foot_sample = _wrenches(s.foot_force_noise_n, s.foot_moment_noise_nm)
        self._joints = JointSensors(s, joints)
        self._imu: Channel[tuple[np.ndarray, np.ndarray]] = Channel(s.imu_period_s, s.imu_latency_s)
        self._encoders: Channel[tuple[np.ndarray, np.ndarray]] = Channel(s.encoder_period_s, s.encoder_latency_s)
        self._feet: Channel[FootSensing] = Channel(s.foot_period_s, s.foot_latency_s)

    def read(self, signals: IdealSignals, time_s: float) -> SensorReadings:
        """What the controller gets in this tick; to be called once in every one."""
        gyro, accelerometer = self._imu.pass_on(lambda: self._sample_imu(signals))
        positions, velocities = self._encoders.pass_on(
            lambda: self._joints.sample(signals.joint_positions, signals.joint_velocities)
        )
        feet = self._feet.pass_on(lambda: self._sample_feet(signals))
        return SensorReadings(time_s, gyro, accelerometer, positions, velocities, feet)

    def _sample_imu(self, signals: IdealSignals) -> tuple[np.ndarray, np.ndarray]:
        s, noise = self._settings, self._imu_noise.standard_normal((2, 3))
        gyro = signals.gyro + self._gyro_bias + s.gyro_noise_rad_s * noise[0]
        return gyro, signals.accelerometer + self._accelerometer_bias + s.accelerometer_noise_m_s2 * noise[1]

    def _sample_feet(self, signals: IdealSignals) -> FootSensing:
        walk, noise = self._foot_noise.standard_normal((2, 2, 6))
        self._foot_error = self._foot_error + self._foot_walk * walk
        return FootSensing(signals.feet.wrenches + self._foot_error + self._foot_sample * noise)


def _wrenches(force: float, moment: float) -> np.ndarray:
    """(2, 6) for both feet: force and moment."""
    return np.tile(np.repeat((force, moment), 3), (2, 1))
