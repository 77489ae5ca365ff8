"""What sensors add to the truth: as much as is said, as seldom and as late as is said, and the same again."""

import copy
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.robot.sensing import FootSensing
from surefoot.simulation.sensors.channel import Channel
from surefoot.simulation.sensors.joint_sensors import difference_noise
from surefoot.simulation.sensors.settings import SensorSettings
from surefoot.simulation.sensors.signals import IdealSignals
from surefoot.simulation.sensors.suite import Sensors, sensor_noise

JOINTS = 15
N = 2000


def signals(angles=None, rates=None) -> IdealSignals:
    angles = np.full(JOINTS, 0.3) if angles is None else angles
    rates = np.zeros(JOINTS) if rates is None else rates
    return IdealSignals(np.array((0.1, 0.2, 0.3)), np.array((0.0, 0.0, 9.81)), angles, rates, FEET)


FEET = FootSensing(np.tile((0.0, 0.0, 500.0, 1.0, 2.0, 0.0), (2, 1)))


def all_readings(settings: SensorSettings, n: int = N):
    sensors, ideal = Sensors(settings, JOINTS), signals()
    return [sensors.read(ideal, 1e-3 * k) for k in range(n)]


def flat(readings) -> np.ndarray:
    """(n, all signals)."""
    return np.array(
        [
            np.concatenate((r.gyro, r.accelerometer, r.joint_positions, r.joint_velocities, r.feet.wrenches.ravel()))
            for r in readings
        ]
    )


def test_perfect_sensors_say_the_truth():
    (reading,) = all_readings(SensorSettings(), 1)
    ideal = signals()
    for name in ("gyro", "accelerometer", "joint_positions", "joint_velocities"):
        assert getattr(reading, name).tobytes() == getattr(ideal, name).tobytes()
    assert reading.feet.wrenches.tobytes() == FEET.wrenches.tobytes()


@pytest.mark.parametrize(
    ("setting", "signal"),
    [
        ("gyro_noise_rad_s", lambda r: r.gyro),
        ("accelerometer_noise_m_s2", lambda r: r.accelerometer),
        ("encoder_noise_rad", lambda r: r.joint_positions),
        ("velocity_noise_rad_s", lambda r: r.joint_velocities),
        ("foot_force_noise_n", lambda r: r.feet.wrenches[:, :3].ravel()),
        ("foot_moment_noise_nm", lambda r: r.feet.wrenches[:, 3:].ravel()),
    ],
)
def test_noise_has_the_standard_deviation_that_is_set_is_white_and_centred_on_the_truth(setting, signal):
    readings, ideal = all_readings(SensorSettings(**{setting: 0.01})), all_readings(SensorSettings(), 1)[0]
    errors = np.array([signal(r) for r in readings]) - signal(ideal)
    of_mean = 0.01 / math.sqrt(N)
    assert_allclose(errors.std(axis=0), 0.01, rtol=5.0 / math.sqrt(2.0 * N))
    assert_allclose(errors.mean(axis=0), 0.0, rtol=0, atol=5.0 * of_mean)
    assert_allclose((errors[1:] * errors[:-1]).mean(axis=0), 0.0, rtol=0, atol=5.0 * 0.01 * of_mean)
    table = flat(readings)
    assert (table != table[0]).any(axis=0).sum() == errors.shape[1], "noise in another signal too"


@pytest.mark.parametrize(
    ("setting", "signal"),
    [
        ("gyro_bias_rad_s", lambda r: r.gyro),
        ("accelerometer_bias_m_s2", lambda r: r.accelerometer),
        ("encoder_offset_rad", lambda r: r.joint_positions),
        ("foot_force_bias_n", lambda r: r.feet.wrenches[:, :3].ravel()),
        ("foot_moment_bias_nm", lambda r: r.feet.wrenches[:, 3:].ravel()),
    ],
)
def test_a_bias_stays_for_the_run_and_is_another_for_each_axis_and_seed(setting, signal):
    ideal, found = signal(all_readings(SensorSettings(), 1)[0]), []
    for seed in range(200):
        first, last = (signal(r) for r in all_readings(SensorSettings(seed=seed, **{setting: 0.01}), 2))
        assert first.tobytes() == last.tobytes()
        found.append(first - ideal)
    found = np.array(found)
    assert_allclose(found.std(axis=0), 0.01, rtol=5.0 / math.sqrt(400.0))
    assert len(np.unique(found)) == found.size


def test_feet_drift_as_far_in_a_minute_as_is_set():
    drift = []
    for seed in range(40):  # a sixtieth of a minute
        readings = all_readings(SensorSettings(seed=seed, foot_period_s=0.02, foot_force_drift_n=8.0), 1001)
        drift.append(readings[-1].feet.wrenches[:, :3] - readings[0].feet.wrenches[:, :3])
    expected = 8.0 * math.sqrt(1.0 / 60.0)
    assert_allclose(np.std(drift), expected, rtol=5.0 / math.sqrt(2.0 * 40 * 6))


def test_encoders_have_steps():
    angles = np.linspace(-0.5, 0.5, JOINTS)
    reading = Sensors(SensorSettings(encoder_step_rad=0.01), JOINTS).read(signals(angles), 0.0)
    assert_allclose(reading.joint_positions / 0.01, np.round(reading.joint_positions / 0.01), rtol=0, atol=1e-9)
    assert np.abs(reading.joint_positions - angles).max() <= 0.005 + 1e-12
    assert len(np.unique(reading.joint_positions)) == JOINTS


@pytest.mark.parametrize("period_s", [0.001, 0.002])
def test_joint_velocity_is_the_filtered_difference(period_s):
    """The step response of a first-order filter, in value and sign."""
    settings = SensorSettings(velocity_filter_hz=20.0, encoder_period_s=period_s)
    sensors, angles, seen = Sensors(settings, JOINTS), np.zeros(JOINTS), []
    for k in range(100):
        seen.append(sensors.read(signals(angles), 1e-3 * k).joint_velocities[0])
        angles = angles + 2e-3  # 2 rad/s
    every = round(period_s / 1e-3)
    k = np.arange(0, 100, every)
    expected = 2.0 * (1.0 - np.exp(-2.0 * math.pi * 20.0 * 1e-3 * k))
    assert_allclose(np.array(seen)[::every], expected, rtol=1e-9, atol=1e-12)


def test_steps_of_the_motors_encoders_leave_the_noise_that_is_told_to_estimators():
    settings = SensorSettings(velocity_step_rad=1e-4, velocity_filter_hz=100.0)
    sensors, exact = Sensors(settings, JOINTS), Sensors(SensorSettings(velocity_filter_hz=100.0), JOINTS)
    random, seen = np.random.default_rng(1), []
    for k in range(N):
        angles = random.uniform(-1.0, 1.0, JOINTS)  # errors of the quantiser without memory, as the formula has them
        rounded = sensors.read(signals(angles), 1e-3 * k).joint_velocities
        seen.append(rounded - exact.read(signals(angles), 1e-3 * k).joint_velocities)
    assert_allclose(np.std(seen[100:]), difference_noise(settings), rtol=0.02)
    assert sensor_noise(settings).joint_velocity == difference_noise(settings)


@pytest.mark.parametrize(("period_s", "latency_s"), [(0.001, 0.0), (0.001, 0.003), (0.004, 0.0), (0.005, 0.002)])
def test_samples_come_as_seldom_and_as_late_as_is_said(period_s, latency_s):
    channel, period, latency = Channel(period_s, latency_s), round(period_s * 1e3), round(latency_s * 1e3)
    for tick in range(60):
        got = channel.pass_on(lambda tick=tick: tick)
        assert got == max(0, (tick - latency) // period * period)


def test_runs_that_differ_in_one_figure_share_all_other_errors():
    base = {"gyro_noise_rad_s": 0.01, "encoder_noise_rad": 1e-3, "foot_force_noise_n": 1.0}
    one, other = (flat(all_readings(SensorSettings(**base, **more), 50)) for more in ({}, {"gyro_bias_rad_s": 0.01}))
    changed = np.flatnonzero((one != other).any(axis=0))
    assert changed.tolist() == [0, 1, 2]
    twice = flat(all_readings(SensorSettings(**{**base, "gyro_noise_rad_s": 0.02}), 50))
    truth = flat(all_readings(SensorSettings(), 1))
    assert_allclose((twice - truth)[:, :3], 2.0 * (one - truth)[:, :3], rtol=1e-9, atol=1e-15)


def test_a_seed_repeats_to_the_bit_and_another_does_not():
    one, same, other = (flat(all_readings(SensorSettings(preset="cheap", seed=seed), 30)) for seed in (4, 4, 5))
    assert one.tobytes() == same.tobytes()
    assert not (one == other).all(axis=0).any()


def test_a_copy_goes_on_as_the_original_does():
    settings = SensorSettings(preset="cheap")
    sensors, ideal = Sensors(settings, JOINTS), signals()
    for k in range(17):
        sensors.read(ideal, 1e-3 * k)
    copied = copy.deepcopy(sensors)
    futures = [flat([each.read(ideal, 1e-3 * k) for k in range(17, 60)]) for each in (sensors, copied)]
    assert futures[0].tobytes() == futures[1].tobytes()
