"""Joint angles from encoders, and joint velocities as drives make them: differences, filtered."""

import math

import numpy as np

from surefoot.simulation.physics import TIMESTEP_S
from surefoot.simulation.sensors.channel import whole_ticks
from surefoot.simulation.sensors.settings import SensorSettings


def sampling_time(settings: SensorSettings) -> float:
    """T [s] between two samples of the encoders: whole ticks."""
    return whole_ticks(settings.encoder_period_s) * TIMESTEP_S


def filter_share(settings: SensorSettings) -> float:
    """Part of the way to its input that the velocity filter goes in one sample: 1 - exp(-2 pi f T)."""
    return 1.0 - math.exp(-2.0 * math.pi * settings.velocity_filter_hz * sampling_time(settings))


def difference_noise(settings: SensorSettings) -> float:
    """Standard deviation [rad/s] that the motors' quantiser leaves in the filtered difference.

    White noise e of variance step^2 / 12 in the angle, through (a/T) (1 - z^-1) / (1 - (1 - a) z^-1): the variance is
    multiplied by (a/T)^2 2 / (2 - a).
    """
    a = filter_share(settings)
    return settings.velocity_step_rad / math.sqrt(12.0) * a / sampling_time(settings) * math.sqrt(2.0 / (2.0 - a))


class JointSensors:
    """Encoders of the joints (offset, noise, quantiser), and of the motors (quantiser), which velocities come from.

    A drive differences the encoder on its motor, before the gear: its steps are a hundred times finer than those of the
    joint's encoder, whose noise, differenced at 1 kHz, would leave nothing to control with.

    Args:
        settings: how good they are.
        joints: how many.
    """

    def __init__(self, settings: SensorSettings, joints: int):
        self._settings = settings
        self._noise = np.random.default_rng((settings.seed, 2))
        self._offset = settings.encoder_offset_rad * self._noise.standard_normal(joints)
        self._share, self._sampling_s = filter_share(settings), sampling_time(settings)
        self._last: np.ndarray | None = None
        self._velocity = np.zeros(joints)

    def sample(self, angles: np.ndarray, velocities: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What is measured [rad], [rad/s] where the truth is (n,) [rad] and (n,) [rad/s]."""
        s, noise = self._settings, self._noise.standard_normal((2, len(angles)))
        measured = _in_steps(angles + self._offset + s.encoder_noise_rad * noise[0], s.encoder_step_rad)
        if s.velocity_filter_hz > 0.0:
            motor = _in_steps(angles, s.velocity_step_rad)
            if self._last is not None:  # the robot stands when the drives are switched on
                difference = (motor - self._last) / self._sampling_s
                self._velocity = self._velocity + self._share * (difference - self._velocity)
            self._last = motor
        else:
            self._velocity = velocities
        return measured, self._velocity + s.velocity_noise_rad_s * noise[1]


def _in_steps(angles: np.ndarray, step: float) -> np.ndarray:
    return angles if step == 0.0 else step * np.round(angles / step)
