"""How good the sensors are: presets with public figures, every one of which can be set alone.

Origin of the figures (``static/help/sensing.md`` has them as a table):

- ``lab``: IMU as a VectorNav VN-100, densities 6.1e-5 rad/s/sqrt(Hz) and 1.37e-3 m/s2/sqrt(Hz) (settings of the
  estimator of the biped Cassie) at 1 kHz; encoders of IHMC's "low" noise, 1e-4 rad (open-robotics-software).
- ``robot``: encoders and joint velocity of IHMC's "medium" noise, 1e-3 rad and 0.02 rad/s, and IHMC's latency, 3 ms;
  the bias of the accelerometer is that of the simulated Atlas of the DARPA Robotics Challenge, 0.1 m/s2.
- ``cheap``: turn-on bias of an ADIS-class IMU (0.5 deg/s, 0.196 m/s2, uuv_simulator); gyro, joint angle and joint
  velocity as MuJoCo Playground trains its humanoids under: uniform +-0.2 rad/s, +-0.03 rad and +-1.5 rad/s, here normal
  with the same standard deviation (the half-width over the square root of 3).
- Of foot sensors no public measurement was found: their figures are chosen. So are those of gyro and accelerometer
  noise in ``robot``, and quantisers and filters of the joint velocity.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from surefoot.field_metadata import check_fields, choice, count, preset_number, take_preset
from surefoot.simulation.presets import CHEAP, LAB, MOST_SEEDS, PERFECT, PRESET_HELP, PRESETS, ROBOT

_ZERO = (
    *("gyro_noise_rad_s", "gyro_bias_rad_s", "accelerometer_noise_m_s2", "accelerometer_bias_m_s2"),
    *("encoder_noise_rad", "encoder_offset_rad", "encoder_step_rad"),
    *("velocity_noise_rad_s", "velocity_step_rad", "velocity_filter_hz"),
    *("foot_force_noise_n", "foot_force_bias_n", "foot_force_drift_n"),
    *("foot_moment_noise_nm", "foot_moment_bias_nm", "foot_moment_drift_nm"),
    *("imu_latency_s", "encoder_latency_s", "foot_latency_s"),
)
_PERFECT = {
    **dict.fromkeys(_ZERO, 0.0),
    **dict.fromkeys(("imu_period_s", "encoder_period_s", "foot_period_s"), 0.001),
}
SENSOR_PRESETS: Mapping[str, Mapping[str, float]] = {
    PERFECT: _PERFECT,
    LAB: {
        **_PERFECT,
        "gyro_noise_rad_s": 0.0019,
        "accelerometer_noise_m_s2": 0.043,
        "encoder_noise_rad": 1e-4,
        "encoder_step_rad": 1e-4,
        "velocity_noise_rad_s": 0.002,
        "velocity_step_rad": 1e-5,
        "velocity_filter_hz": 100.0,
        "foot_force_noise_n": 1.0,
        "foot_moment_noise_nm": 0.05,
        **dict.fromkeys(("imu_latency_s", "encoder_latency_s", "foot_latency_s"), 0.001),
    },
    ROBOT: {
        **_PERFECT,
        "gyro_noise_rad_s": 0.01,
        "gyro_bias_rad_s": 0.005,
        "accelerometer_noise_m_s2": 0.05,
        "accelerometer_bias_m_s2": 0.1,
        "encoder_noise_rad": 1e-3,
        "encoder_step_rad": 1e-4,
        "velocity_noise_rad_s": 0.02,
        "velocity_step_rad": 1e-5,
        "velocity_filter_hz": 100.0,
        "foot_force_noise_n": 2.0,
        "foot_force_bias_n": 10.0,
        "foot_moment_noise_nm": 0.1,
        "foot_moment_bias_nm": 1.0,
        **dict.fromkeys(("imu_latency_s", "encoder_latency_s", "foot_latency_s"), 0.003),
    },
    CHEAP: {
        **_PERFECT,
        "gyro_noise_rad_s": 0.115,
        "gyro_bias_rad_s": 0.0087,
        "accelerometer_noise_m_s2": 0.1,
        "accelerometer_bias_m_s2": 0.196,
        "encoder_noise_rad": 0.017,
        "encoder_step_rad": 1e-3,
        "velocity_noise_rad_s": 0.87,
        "velocity_step_rad": 1e-4,
        "velocity_filter_hz": 50.0,
        "foot_force_noise_n": 5.0,
        "foot_force_bias_n": 20.0,
        "foot_force_drift_n": 5.0,
        "foot_moment_noise_nm": 0.5,
        "foot_moment_bias_nm": 2.0,
        "foot_moment_drift_nm": 0.5,
        **dict.fromkeys(("imu_latency_s", "encoder_latency_s", "foot_latency_s"), 0.005),
    },
}


def _period(of: str) -> float:
    return preset_number(0.001, 0.02, "s", f"time between two samples of the {of}", step=0.001)


def _latency(of: str) -> float:
    return preset_number(0.0, 0.02, "s", f"a sample of the {of} reaches the controller this much later", step=0.001)


@dataclass(frozen=True, kw_only=True)
class SensorSettings:
    """What the sensors add to the truth; what is not said is as in the preset. Validated at creation (InvalidInput).

    ``noise`` is the standard deviation of each sample; ``bias`` and ``offset`` that of an error drawn once for the run;
    ``drift`` that of a random walk after one minute; ``step`` is that of the quantiser.
    """

    preset: str = choice(PERFECT, PRESETS, PRESET_HELP)
    seed: int = count(0, 0, MOST_SEEDS, "of all noise and biases")
    imu_body: str = choice("base", ("base", "trunk"), "what carries the IMU: the free body, or the upright one")
    gyro_noise_rad_s: float = preset_number(0.0, 1.0, "rad/s", "noise of the gyro, each axis")
    gyro_bias_rad_s: float = preset_number(0.0, 0.1, "rad/s", "turn-on bias of the gyro, each axis")
    accelerometer_noise_m_s2: float = preset_number(0.0, 5.0, "m/s2", "noise of the accelerometer, each axis")
    accelerometer_bias_m_s2: float = preset_number(0.0, 1.0, "m/s2", "turn-on bias of the accelerometer, each axis")
    imu_period_s: float = _period("IMU")
    imu_latency_s: float = _latency("IMU")
    encoder_noise_rad: float = preset_number(0.0, 0.05, "rad", "noise of the joints' encoders")
    encoder_offset_rad: float = preset_number(0.0, 0.05, "rad", "error of each encoder's zero")
    encoder_step_rad: float = preset_number(0.0, 0.01, "rad", "quantiser of the joints' encoders")
    encoder_period_s: float = _period("encoders")
    encoder_latency_s: float = _latency("encoders")
    velocity_noise_rad_s: float = preset_number(0.0, 2.0, "rad/s", "noise of the joint velocity")
    velocity_step_rad: float = preset_number(
        0.0, 0.01, "rad", "quantiser of the motors' encoders, whose difference the joint velocity is"
    )
    velocity_filter_hz: float = preset_number(
        0.0, 500.0, "Hz", "cutoff of the first-order filter on that difference; 0: the true velocity in its place"
    )
    foot_force_noise_n: float = preset_number(0.0, 50.0, "N", "noise of each force of the feet's sensors")
    foot_force_bias_n: float = preset_number(0.0, 100.0, "N", "constant error of each force")
    foot_force_drift_n: float = preset_number(0.0, 100.0, "N", "random walk of each force, after a minute")
    foot_moment_noise_nm: float = preset_number(0.0, 5.0, "N m", "noise of each moment of the feet's sensors")
    foot_moment_bias_nm: float = preset_number(0.0, 10.0, "N m", "constant error of each moment")
    foot_moment_drift_nm: float = preset_number(0.0, 10.0, "N m", "random walk of each moment, after a minute")
    foot_period_s: float = _period("feet")
    foot_latency_s: float = _latency("feet")

    def __post_init__(self) -> None:
        """Take from the preset what is not said; refuse NaN, wrong types and values out of range."""
        take_preset(self, SENSOR_PRESETS, "sensors")
        check_fields(self, "sensors")
