"""Motors: they saturate, they may be late, and the plant may be heavier than the controller believes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.robot.feet import Support
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant

MASS_KG = 104.81
BIG = np.where(np.arange(15) % 2, 1e4, -1e4)


def mass_of_the_robot(plant: Plant) -> float:
    return float(plant.model.body_subtreemass[plant.model.body("pelvis").id])


def test_torques_saturate_at_the_limits(simulate, scripted, robot):
    simulation = simulate()
    simulation.controller = scripted(lambda tick: BIG)
    tick = simulation.tick()
    assert_allclose(tick.applied, np.sign(BIG) * robot.torque_limits, rtol=0, atol=0)
    data = simulation.plant.data
    assert_allclose(data.qfrc_actuator[6:], tick.applied, rtol=0, atol=0)
    assert_allclose(tick.output.torques, BIG, rtol=0, atol=0)  # what was asked for stays on record


def test_without_limits_they_do_not(simulate, scripted):
    simulation = simulate(physics={"torque_limits": False})
    simulation.controller = scripted(lambda tick: BIG)
    tick = simulation.tick()
    assert_allclose(tick.applied, BIG, rtol=0, atol=0)
    assert_allclose(simulation.plant.data.qfrc_actuator[6:], BIG, rtol=0, atol=0)


def test_limits_can_be_switched_while_it_runs(robot, standing):
    plant = Plant(robot, PhysicsSettings())
    plant.reset(standing(Support.DOUBLE).state.q)
    for limited in (False, True, False):
        plant.change_physics(PhysicsSettings(torque_limits=limited))
        plant.step(BIG)
        expected = np.sign(BIG) * robot.torque_limits if limited else BIG
        assert_allclose(plant.data.qfrc_actuator[6:], expected, rtol=0, atol=0)


@pytest.mark.parametrize(("delay_s", "ticks"), [(0.0, 0), (0.001, 1), (0.002, 2), (0.0049, 5), (0.02, 20)])
def test_torques_reach_the_motors_that_many_ticks_later(simulate, scripted, delay_s, ticks):
    simulation = simulate(physics={"control_delay_s": delay_s})
    simulation.controller = scripted(lambda tick: np.full(15, float(tick)))
    applied = [simulation.tick().applied[0] for _ in range(40)]
    assert applied == [float(max(0, k - ticks)) for k in range(40)]


def test_delay_can_change_while_it_runs(simulate, scripted):
    simulation = simulate(physics={"control_delay_s": 0.003})
    simulation.controller = scripted(lambda tick: np.full(15, float(tick)))
    for _ in range(10):
        tick = simulation.tick()
    assert tick.applied[0] == 6.0
    simulation.plant.change_physics(PhysicsSettings(control_delay_s=0.001))
    assert simulation.tick().applied[0] == 9.0
    simulation.plant.change_physics(PhysicsSettings(control_delay_s=0.002))
    later = [simulation.tick().applied[0] for _ in range(5)]
    assert later == [9.0, 10.0, 11.0, 12.0, 13.0]


def test_mass_scale_scales_the_plant_and_not_what_the_controller_believes(simulate, robot):
    simulation = simulate(physics={"mass_scale": 1.2})
    _, sensing = simulation.plant.sense()
    tick = simulation.tick()
    assert mass_of_the_robot(simulation.plant) == pytest.approx(1.2 * MASS_KG, rel=1e-12)
    assert tick.terms.mass_kg == pytest.approx(MASS_KG, rel=1e-12)
    assert robot.mass_kg == pytest.approx(MASS_KG, rel=1e-12)
    assert sum(sensing.normal_forces) == pytest.approx(1.2 * MASS_KG * 9.81, rel=1e-4)


def test_mass_scale_scales_inertias_alike_and_leaves_rotors_alone(robot):
    plain, heavy = (Plant(robot, PhysicsSettings(mass_scale=scale)).model for scale in (1.0, 1.3))
    assert_allclose(heavy.body_mass, 1.3 * plain.body_mass, rtol=1e-12)
    assert_allclose(heavy.body_inertia, 1.3 * plain.body_inertia, rtol=1e-12)
    assert_allclose(heavy.dof_armature, plain.dof_armature, rtol=0, atol=0)
    assert_allclose(heavy.body_subtreemass, 1.3 * plain.body_subtreemass, rtol=1e-12)


def test_mass_scale_there_and_back_is_the_same_plant(robot):
    plant = Plant(robot, PhysicsSettings())
    mass, inertia = plant.model.body_mass.copy(), plant.model.body_inertia.copy()
    for scale in (1.5, 0.5, 1.1, 1.0):
        plant.change_physics(PhysicsSettings(mass_scale=scale))
        assert_allclose(plant.model.body_mass, scale * mass, rtol=1e-12)
    assert_allclose(plant.model.body_inertia, inertia, rtol=1e-12)


def test_friction_reaches_every_contact(robot):
    plant = Plant(robot, PhysicsSettings(friction=0.3))
    assert (plant.model.geom_friction[:, 0] == 0.3).all()
    plant.change_physics(PhysicsSettings(friction=0.7))
    assert (plant.model.geom_friction[:, 0] == 0.7).all()


def test_plants_do_not_share_their_physics(robot):
    one, other = Plant(robot, PhysicsSettings(mass_scale=1.2)), Plant(robot, PhysicsSettings())
    assert mass_of_the_robot(other) == pytest.approx(MASS_KG, rel=1e-12)
    assert mass_of_the_robot(one) == pytest.approx(1.2 * MASS_KG, rel=1e-12)
