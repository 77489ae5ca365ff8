"""A plant that is not the nominal robot: as far from it as is said, and only where it is said."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.robot.description import load_robot
from surefoot.robot.feet import Support
from surefoot.simulation.imperfections import PERFECT_PLANT, Imperfections
from surefoot.simulation.measurement import contact_forces, measure_balance, sole_outline
from surefoot.simulation.model_error import ModelErrorSettings
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant

PHYSICS = PhysicsSettings()


def plant_with(robot, **errors) -> Plant:
    return Plant(robot, PHYSICS, imperfections=Imperfections(model_error=ModelErrorSettings(**errors)))


@pytest.fixture(scope="module")
def nominal(robot):
    return Plant(robot, PHYSICS, imperfections=PERFECT_PLANT).model


def of_robot(model) -> np.ndarray:
    """Which bodies are links of the robot."""
    return (model.body_rootid == model.body("pelvis").rootid[0]) & (model.body_mass > 0.0)


def differing(model, nominal) -> set[str]:
    """The fields of two models of which a number of the robot differs."""
    fields = ("body_mass", "body_inertia", "body_ipos", "body_pos", "geom_pos", "geom_friction", "body_iquat")
    return {name for name in fields if not np.allclose(getattr(model, name), getattr(nominal, name), rtol=1e-9, atol=0)}


@pytest.mark.parametrize(
    ("errors", "fields"),
    [
        ({}, set()),
        ({"mass": 0.1}, {"body_mass", "body_inertia"}),
        ({"inertia": 0.1}, {"body_inertia"}),
        ({"com_m": 0.01}, {"body_ipos"}),
        ({"length": 0.01}, {"body_pos"}),
        ({"sole_m": 0.002}, {"geom_pos"}),
        ({"friction": 0.3}, {"geom_friction"}),
    ],
)
def test_each_error_is_where_it_belongs(robot, nominal, errors, fields):
    assert differing(plant_with(robot, **errors).model, nominal) == fields


def test_errors_fill_their_range_and_leave_it_nowhere(robot, nominal):
    links = of_robot(nominal)
    ratios, shifts = [], []
    for seed in range(12):
        model = plant_with(robot, seed=seed, mass=0.1, com_m=0.01).model
        ratios.append(model.body_mass[links] / nominal.body_mass[links] - 1.0)
        shifts.append((model.body_ipos - nominal.body_ipos)[links])
    for found, half in ((np.array(ratios), 0.1), (np.array(shifts), 0.01)):
        assert np.abs(found).max() <= half * (1.0 + 1e-9)
        assert found.max() > 0.9 * half
        assert found.min() < -0.9 * half
        assert_allclose(found.std(), half / np.sqrt(3.0), rtol=0.15)


def test_inertia_follows_the_mass(robot, nominal):
    model = plant_with(robot, mass=0.1).model
    links = of_robot(nominal)
    ratio = model.body_mass[links] / nominal.body_mass[links]
    assert_allclose(model.body_inertia[links] / nominal.body_inertia[links], np.tile(ratio, (3, 1)).T, rtol=1e-9)


def test_stones_and_ground_are_as_ever_but_for_their_friction(robot, nominal):
    model = plant_with(robot, preset="cheap").model
    stones = np.flatnonzero(nominal.body_mocapid >= 0)
    assert len(stones)
    assert_allclose(model.body_pos[stones], nominal.body_pos[stones], rtol=0, atol=0)
    assert_allclose(model.geom_size, nominal.geom_size, rtol=0, atol=0)


def test_friction_stays_scaled_when_it_is_changed_while_it_runs(robot):
    plant = plant_with(robot, friction=0.4, seed=1)
    scale = plant.imperfections.model_error.friction_scale
    assert 0.6 <= scale <= 1.4
    assert scale != 1.0
    assert_allclose(plant.model.geom_friction[:, 0], scale * PHYSICS.friction, rtol=1e-12)
    plant.change_physics(PhysicsSettings(friction=0.5))
    assert_allclose(plant.model.geom_friction[:, 0], scale * 0.5, rtol=1e-12)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_robot_with_other_legs_starts_at_rest_carrying_its_own_weight(robot, standing, seed):
    plant = plant_with(robot, preset="robot", seed=seed)
    plant.reset(standing(Support.DOUBLE).state.q)
    carried = sum(float(foot.force[2]) for foot in plant.feet())
    weight = float(plant.model.body_subtreemass[plant.model.body("pelvis").id]) * robot.gravity
    assert carried == pytest.approx(weight, rel=2e-3)
    assert weight != pytest.approx(robot.mass_kg * robot.gravity, rel=1e-6)


def test_the_centre_of_mass_that_is_recorded_is_the_plants_own(simulate):
    simulation = simulate(model_error={"com_m": 0.01})
    for _ in range(20):
        result = simulation.tick()
    com = np.array([simulation.recorder.column(f"com_{a}_m")[-1] for a in "xyz"])
    assert result.position_com.tobytes() == com.tobytes()
    believed = result.terms.position_com_in_world
    own = simulation.plant.position_com()  # of the instant before the last step: that of the tick
    assert_allclose(com, own, rtol=0, atol=1e-12)
    assert 1e-4 < np.linalg.norm(com - believed) < 0.02


def test_the_plants_own_centre_of_mass_moves_as_its_velocity_says(simulate):
    simulation = simulate(model_error={"preset": "cheap", "friction": 0.0}, pushes=[{"impulse_ns": 8.0}])
    for _ in range(60):
        simulation.tick()
    plant = simulation.plant
    (before, _), _ = plant.com_now(), simulation.tick()
    after, velocity = plant.com_now()
    assert np.linalg.norm(velocity) > 1e-3
    assert_allclose((after - before) / 1e-3, velocity, rtol=0, atol=1e-4)


def test_without_errors_both_roads_to_the_centre_of_mass_agree(simulate):
    simulation = simulate(pushes=[{"impulse_ns": 4.0}])
    for _ in range(60):
        simulation.tick()
    com, velocity = simulation.plant.com_now()
    terms = simulation.tick().terms
    assert_allclose(com, terms.position_com_in_world, rtol=0, atol=1e-10)
    assert_allclose(velocity, terms.velocity_com_in_world, rtol=0, atol=1e-10)


@pytest.mark.parametrize("seed", [0, 1])
def test_contacts_are_at_the_soles_that_the_plant_was_built_with(simulate, seed):
    """MuJoCo's contact points against the corners that the ZMP is held against: the nominal ones lie elsewhere."""
    simulation = simulate(support="double", model_error={"sole_m": 0.004, "seed": seed})
    for _ in range(30):
        result = simulation.tick()
    plant = simulation.plant
    points = contact_forces(plant)[:, :2]
    assert len(points) >= 3

    def farthest(robot):
        corners = np.vstack([sole_outline(robot, foot, i) for i, foot in enumerate(plant.feet())])
        return max(np.linalg.norm(corners - point, axis=1).min() for point in points)

    assert farthest(plant.built) < 1e-4
    assert farthest(simulation.robot) > 1e-3
    assert result.balance.zmp_margin != measure_balance(simulation.robot, plant.feet(), Support.DOUBLE).zmp_margin


def test_without_errors_of_the_soles_the_robot_is_the_nominal_one(robot):
    assert plant_with(robot, mass=0.1, length=0.002).built is robot


@pytest.mark.parametrize("extra", [{"model_error": {"mass": 0.2, "seed": 3}}, {"physics": {"mass_scale": 1.1}}])
def test_the_measured_delta_takes_the_weight_that_the_ground_carries(simulate, extra):
    simulation = simulate(**extra)
    for _ in range(5):
        result = simulation.tick()
    model, recorder = simulation.plant.model, simulation.recorder
    mass = float(model.body_mass[of_robot(model)].sum())
    assert simulation.plant.mass_kg == pytest.approx(mass, rel=1e-12)
    assert abs(mass - simulation.robot.mass_kg) > 0.5
    arm, weight = result.position_com - result.balance.origin, np.array((0.0, 0.0, mass * simulation.robot.gravity))
    expected = result.balance.contact_moment - np.cross(arm, weight)
    found = np.array([recorder.column(f"delta_measured_{a}_nm")[-1] for a in "xyz"])
    assert_allclose(found, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_a_flat_foot_stays_possible_whatever_its_inertia_is_scaled_by(seed):
    """The robot ``offset`` has feet whose principal inertias are those of a plate: the largest is the others' sum."""
    offset = load_robot("offset")
    model = plant_with(offset, preset="cheap", seed=seed).model
    for inertia in model.body_inertia[of_robot(model)]:
        assert inertia.max() <= (inertia.sum() - inertia.max()) * (1.0 + 1e-12)
