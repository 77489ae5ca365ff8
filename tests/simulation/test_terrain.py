"""Blocks on the ground: where MuJoCo has them, what carries the robot, and that they turn with the ground."""

import mujoco
import numpy as np
import pytest

from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.robot.feet import Support
from surefoot.simulation.ground import Ground
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant
from surefoot.simulation.terrain import LEVEL, Block, Terrain
from surefoot.simulation.world import TERRAIN
from surefoot.task.posture import ground_pivot, solve_posture

SLAB = Block(0.0, 0.0, 0.6, 0.8, 0.0)
ROUGH = Terrain((SLAB, Block(0.5, 0.1, 0.2, 0.3, 0.02), Block(0.55, 0.1, 0.05, 0.05, 0.05)), 0.03)


def plant_on(robot, dynamics, terrain: Terrain, ground: Ground | None = None) -> Plant:
    scenario = Scenario(support=Support.DOUBLE, ground=ground or Ground())
    pivot = ground_pivot(robot, Support.DOUBLE)
    plant = Plant(robot, PhysicsSettings(), scenario.ground, pivot, terrain)
    plant.reset(solve_posture(dynamics, start_posture(scenario)).q)
    return plant


def height_by_ray(plant: Plant, x: float, y: float) -> float:
    """Height above level zero, along the ground's normal, that a ray from above the ground finds."""
    ground = plant.ground
    start = ground.to_world(np.array((x, y, 1.0)))
    groups, geom = np.ones(6, dtype=np.uint8), np.full(1, -1, dtype=np.int32)
    return 1.0 - mujoco.mj_ray(plant.model, plant.data, start, -ground.up, groups, 1, -1, geom)


def take_robot_away(plant: Plant) -> None:
    plant.data.qpos[1] += 50.0
    mujoco.mj_kinematics(plant.model, plant.data)


@pytest.mark.parametrize("ground", [Ground(), Ground(slope_deg=6.0, direction_deg=40.0)])
def test_blocks_are_where_they_are_said_to_be_on_a_slope_too(robot, dynamics, ground):
    plant = plant_on(robot, dynamics, ROUGH, ground)
    take_robot_away(plant)
    random = np.random.default_rng(3)
    heights = set()
    for x, y in random.uniform((-0.6, -0.6), (0.9, 0.6), (200, 2)):
        expected = ROUGH.height_at(x, y)
        heights.add(expected)
        assert height_by_ray(plant, x, y) == pytest.approx(expected, abs=1e-9)
    assert heights == {-0.03, 0.0, 0.02, 0.05}


@pytest.mark.parametrize("terrain", [LEVEL, ROUGH])
def test_the_robot_is_carried_from_the_first_instant(robot, dynamics, terrain):
    plant = plant_on(robot, dynamics, terrain)
    _, sensing = plant.sense()
    assert sum(sensing.normal_forces) == pytest.approx(robot.mass_kg * robot.gravity, rel=1e-3)
    assert plant.position_com()[2] == pytest.approx(plant_on(robot, dynamics, LEVEL).position_com()[2], abs=5e-4)


def test_blocks_turn_with_ground_that_tilts_and_come_back_with_a_rewind(robot, dynamics):
    tilt = Ground(slope_deg=5.0, direction_deg=90.0, tilt_start_s=0.0, tilt_duration_s=0.05)
    plant = plant_on(robot, dynamics, ROUGH, tilt)
    for _ in range(20):
        plant.step(np.zeros(15))
    kept, state, angle = plant.memory.save_state(), plant.data.qpos.copy(), plant.ground.rotation.copy()
    for _ in range(40):
        plant.step(np.zeros(15))
    ahead = plant.data.qpos.copy()
    take_robot_away(plant)
    assert height_by_ray(plant, 0.5, 0.0) == pytest.approx(0.02, abs=1e-9)
    plant.memory.restore_state(kept)
    plant.ground.lie(angle)
    assert (plant.data.qpos == state).all()
    for _ in range(40):
        plant.step(np.zeros(15))
    assert (plant.data.qpos == ahead).all()


def test_a_world_without_blocks_is_the_one_that_there_was(robot):
    plain, rough = (Plant(robot, PhysicsSettings(), terrain=terrain).model for terrain in (LEVEL, ROUGH))
    assert rough.ngeom == plain.ngeom + len(ROUGH.blocks)
    assert rough.nbody == plain.nbody + 1
    assert all(plain.body(i).name != TERRAIN for i in range(plain.nbody))
