"""Motors that are slow, weak at speed, and rub: each against its own formula."""

import math

import mujoco
import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.errors import InvalidInput
from surefoot.robot.feet import Support
from surefoot.simulation.imperfections import Imperfections
from surefoot.simulation.motors import MOTOR_PRESETS, Motors, MotorSettings
from surefoot.simulation.physics import TIMESTEP_S, PhysicsSettings
from surefoot.simulation.plant import Plant

LIMITS = np.array((100.0, 40.0))
STILL = np.zeros(2)


def test_perfect_motors_give_what_is_asked():
    asked = np.array((12.0, -7.0))
    assert Motors(MotorSettings(), LIMITS).give(asked, STILL).tobytes() == asked.tobytes()


def test_a_step_of_torque_comes_as_through_a_first_order_filter():
    motors, bandwidth = Motors(MotorSettings(bandwidth_hz=50.0), LIMITS), 50.0
    motors.give(np.zeros(2), STILL)
    given = np.array([motors.give(np.array((10.0, -4.0)), STILL) for _ in range(40)])
    times = TIMESTEP_S * np.arange(1, 41)
    expected = np.outer(1.0 - np.exp(-2.0 * math.pi * bandwidth * times), (10.0, -4.0))
    assert_allclose(given, expected, rtol=1e-12)


def test_the_first_torques_are_held_already_also_after_a_reset():
    motors, asked = Motors(MotorSettings(bandwidth_hz=5.0), LIMITS), np.array((10.0, -4.0))
    assert_allclose(motors.give(asked, STILL), asked, rtol=0, atol=0)
    assert_allclose(motors.give(np.zeros(2), STILL), asked * math.exp(-2.0 * math.pi * 5.0 * 1e-3), rtol=1e-12)
    motors.reset()
    assert_allclose(motors.give(-asked, STILL), -asked, rtol=0, atol=0)


@pytest.mark.parametrize(
    ("speed", "asked", "given"),
    [
        (0.0, 100.0, 100.0),
        (4.0, 100.0, 60.0),  # the line from the stall torque to the no-load speed
        (4.0, 50.0, 50.0),
        (-4.0, -100.0, -60.0),
        (10.0, 100.0, 0.0),
        (15.0, 100.0, 0.0),
        (4.0, -100.0, -100.0),  # it can brake with all it has
        (-15.0, 80.0, 80.0),
    ],
)
def test_the_faster_it_turns_the_less_it_can_drive(speed, asked, given):
    motors = Motors(MotorSettings(no_load_speed_rad_s=10.0), LIMITS)
    got = motors.give(np.array((asked, 0.0)), np.array((speed, 0.0)))
    assert_allclose(got, (given, 0.0), rtol=1e-12, atol=1e-12)


def test_friction_takes_the_power_that_its_formula_says(robot, standing):
    """What leaves the moving joint's energy: torque times way, dry and viscous, by MuJoCo's mass matrix."""
    energies = {}
    for name, settings in {
        "none": MotorSettings(),
        "dry": MotorSettings(coulomb_share=0.01),
        "viscous": MotorSettings(viscous_nms_rad=2.0),
    }.items():
        plant = Plant(robot, PhysicsSettings(), imperfections=Imperfections(motors=settings))
        plant.reset(standing(Support.DOUBLE).state.q)
        plant.model.opt.gravity[:] = 0.0
        plant.data.qpos[2] += 1.0
        plant.data.qvel[6 + 14] = 1.0
        lost = 0.0
        for _ in range(20):
            speeds = plant.data.qvel[6:].copy()
            plant.step(np.zeros(15))
            speeds = 0.5 * (speeds + plant.data.qvel[6:])
            dry = settings.coulomb_share * robot.torque_limits[14] * abs(speeds[14])
            lost += TIMESTEP_S * (dry + settings.viscous_nms_rad * float(speeds.dot(speeds)))
        full = np.empty((plant.model.nv, plant.model.nv))
        mujoco.mj_forward(plant.model, plant.data)
        mujoco.mj_fullM(plant.model, plant.data, full)
        energies[name] = 0.5 * float(plant.data.qvel.dot(full).dot(plant.data.qvel)), lost
    still = energies["none"][0]
    assert still > 0.1
    for name in ("dry", "viscous"):
        energy, lost = energies[name]
        assert lost > 1e-3 * still
        assert still - energy == pytest.approx(lost, rel=0.1), name


def test_motors_are_part_of_the_run(simulate, scripted):
    simulation = simulate(motors={"bandwidth_hz": 30.0})
    simulation.controller = scripted(lambda tick: np.full(15, 10.0 if tick else 0.0))
    applied = np.array([simulation.tick().applied[0] for _ in range(10)])
    assert_allclose(applied, 10.0 * (1.0 - np.exp(-2.0 * math.pi * 30.0 * 1e-3 * np.arange(10))), rtol=1e-9)


def test_a_preset_fills_what_is_not_said():
    assert MotorSettings(preset="cheap").bandwidth_hz == MOTOR_PRESETS["cheap"]["bandwidth_hz"]
    assert MotorSettings(preset="cheap", bandwidth_hz=7.0).bandwidth_hz == 7.0
    assert MotorSettings(preset="cheap", bandwidth_hz=7.0).coulomb_share == MOTOR_PRESETS["cheap"]["coulomb_share"]
    with pytest.raises(InvalidInput, match=r"no such preset.*perfect, lab, robot, cheap"):
        MotorSettings(preset="splendid")
    with pytest.raises(InvalidInput, match=r"motors\.bandwidth_hz"):
        MotorSettings(bandwidth_hz=math.nan)
