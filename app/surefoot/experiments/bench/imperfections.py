"""Imperfections: which fields of a scenario each is, what a preset sets them to, and which seed draws them.

A preset is the sum of its imperfections: each field in which it differs from ``perfect`` belongs to exactly one.
"""

from collections.abc import Mapping
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.estimation.registry import TRUTH, estimator_named
from surefoot.simulation.model_error import MODEL_ERROR_PRESETS
from surefoot.simulation.motors import MOTOR_PRESETS
from surefoot.simulation.presets import PERFECT, PRESETS
from surefoot.simulation.sensors.settings import SENSOR_PRESETS

KIND = "estimator.kind"
SENSORS, MODEL_ERROR = "sensors.", "model_error."
IMPERFECT = ("motors.", "estimator.", SENSORS, MODEL_ERROR)  # tables that a bench may change, beside physics
PRESETS_OF: Mapping[str, Mapping[str, Mapping[str, float]]] = {
    "sensors": SENSOR_PRESETS,
    "motors": MOTOR_PRESETS,
    "model_error": MODEL_ERROR_PRESETS,
}

# Name -> table, fields
IMPERFECTIONS: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "imu-noise": ("sensors", ("gyro_noise_rad_s", "accelerometer_noise_m_s2")),
    "imu-bias": ("sensors", ("gyro_bias_rad_s", "accelerometer_bias_m_s2")),
    "encoders": ("sensors", ("encoder_noise_rad", "encoder_offset_rad", "encoder_step_rad")),
    "joint-velocity": ("sensors", ("velocity_noise_rad_s", "velocity_step_rad", "velocity_filter_hz")),
    "foot-noise": ("sensors", ("foot_force_noise_n", "foot_moment_noise_nm")),
    "foot-bias": (
        "sensors",
        ("foot_force_bias_n", "foot_moment_bias_nm", "foot_force_drift_n", "foot_moment_drift_nm"),
    ),
    "sampling": ("sensors", ("imu_period_s", "encoder_period_s", "foot_period_s")),
    "latency": ("sensors", ("imu_latency_s", "encoder_latency_s", "foot_latency_s")),
    "torque-loop": ("motors", ("bandwidth_hz",)),
    "motor-friction": ("motors", ("coulomb_share", "viscous_nms_rad")),
    "motor-speed": ("motors", ("no_load_speed_rad_s",)),
    "masses": ("model_error", ("mass", "inertia")),
    "mass-centres": ("model_error", ("com_m",)),
    "lengths": ("model_error", ("length", "sole_m")),
    "friction": ("model_error", ("friction",)),
}

# Table whose seed it is -> beginnings of the paths of what it draws
_DRAWN_BY_SEED = {"sensors": (SENSORS, "estimator.told_tilt_rad"), "model_error": (MODEL_ERROR,)}


def preset_changes(preset: str, estimator: str) -> dict[str, Any]:
    """A whole preset as changes of a scenario (dotted path -> value); none for ``perfect``. Raises InvalidInput.

    Args:
        preset: of sensors, motors and model error alike.
        estimator: what reads the sensors, by name.
    """
    if preset not in PRESETS:
        raise InvalidInput("preset", preset, "no such preset", PRESETS)
    estimator_named(estimator)
    if preset == PERFECT:
        return {}
    return {**{f"{table}.preset": preset for table in PRESETS_OF}, KIND: estimator}


def imperfections_of(preset: str) -> dict[str, dict[str, float]]:
    """Name -> changes of a scenario, of all in which a preset differs from ``perfect``. Raises InvalidInput."""
    if preset not in PRESETS:
        raise InvalidInput("--preset", preset, "no such preset", PRESETS)
    found = {}
    for name, (table, fields) in IMPERFECTIONS.items():
        asked, perfect = PRESETS_OF[table][preset], PRESETS_OF[table][PERFECT]
        changes = {f"{table}.{key}": asked[key] for key in fields if asked[key] != perfect[key]}
        if changes:
            found[name] = changes
    return found


def unread(changes: Mapping[str, Any]) -> list[str]:
    """The changes of sensors that nobody reads, because the controller gets the true state."""
    return [] if changes.get(KIND, TRUTH) != TRUTH else [path for path in changes if path.startswith(SENSORS)]


def knows_all(changes: Mapping[str, Any]) -> bool:
    """Whether the controller gets the true state, of a robot that is as it believes."""
    return changes.get(KIND, TRUTH) == TRUTH and not any(path.startswith(MODEL_ERROR) for path in changes)


def with_seeds(changes: Mapping[str, Any], seed: int) -> dict[str, Any]:
    """The changes, with a cell's seed as that of noise, biases and errors of the model, where there are any."""
    seeds = {
        f"{table}.seed": seed
        for table, drawn in _DRAWN_BY_SEED.items()
        if any(path.startswith(drawn) for path in changes)
    }
    return {**seeds, **changes}
