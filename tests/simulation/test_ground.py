"""Ground that slopes or tilts: where it is, that contacts and stones follow it, and what the robot feels of it."""

import math

import mujoco
import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.robot.feet import Support
from surefoot.simulation.ground import Ground, GroundPose
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant
from surefoot.task.posture import ground_pivot, solve_posture
from surefoot.task.reference import quintic

PIVOT = np.array((0.0, 0.11, 0.0))


def floor_of(plant):
    """Normal (3,) of the plane that MuJoCo collides with, and its height [m] at the pivot."""
    mujoco.mj_forward(plant.model, plant.data)
    floor = plant.model.geom("floor").id
    normal = plant.data.geom_xmat[floor].reshape(3, 3)[:, 2]
    return normal, float(normal @ (plant.data.geom_xpos[floor] - plant.ground.pivot))


@pytest.mark.parametrize(("direction", "rises"), [(0, (1, 0)), (90, (0, 1)), (180, (-1, 0)), (-90, (0, -1))])
def test_the_ground_rises_where_it_is_said_to(direction, rises):
    R = Ground(slope_deg=10.0, direction_deg=direction).rotation_at(0.0)
    assert_allclose(R[:, 2], [*(-math.sin(math.radians(10)) * np.array(rises)), math.cos(math.radians(10))], atol=1e-12)
    assert (R @ [*rises, 0.0])[2] == pytest.approx(math.sin(math.radians(10)))


def test_a_tilt_is_a_quintic_from_level_to_its_slope():
    ground = Ground(slope_deg=8.0, direction_deg=30.0, tilt_start_s=0.5, tilt_duration_s=2.0)
    assert ground.angle_at(0.0) == ground.angle_at(0.5) == 0.0
    for time_s in (0.9, 1.5, 2.2):
        assert ground.angle_at(time_s) == pytest.approx(math.radians(8.0) * quintic((time_s - 0.5) / 2.0)[0])
    assert ground.angle_at(2.5) == ground.angle_at(60.0) == pytest.approx(math.radians(8.0))


def test_level_ground_leaves_every_point_where_it_is():
    pose, point = GroundPose(Ground(), PIVOT), np.array((0.3, -0.2, 0.01))
    assert not pose.move(5.0)
    assert (pose.to_world(point) == point).all()


@pytest.mark.parametrize("wrong", [
    {"slope_deg": -1.0}, {"slope_deg": 21.0}, {"slope_deg": math.nan}, {"direction_deg": 400.0},
    {"tilt_duration_s": 0.01}, {"tilt_start_s": 1.0}, {"tilt_start_s": "soon"},
])  # fmt: skip
def test_a_ground_that_makes_no_sense_is_refused(wrong):
    with pytest.raises(InvalidInput, match=f"ground.{next(iter(wrong))}.*valid"):
        Ground(**wrong)


@pytest.mark.parametrize("support", Support)
@pytest.mark.parametrize("direction", [0.0, 180.0, -90.0, 35.0])
def test_on_a_slope_the_soles_lie_flat_the_trunk_stays_upright_and_the_com_above(robot, dynamics, support, direction):
    scenario = Scenario(support=support, ground=Ground(slope_deg=6.0, direction_deg=direction))
    level, posture = start_posture(Scenario(support=support)), start_posture(scenario)
    R, pivot = scenario.ground.rotation_at(0.0), ground_pivot(robot, support)
    assert_allclose(posture.position_com, level.position_com, rtol=0, atol=0)
    assert_allclose(posture.rotation_pelvis_to_world, level.rotation_pelvis_to_world, rtol=0, atol=0)
    for i, foot in enumerate(robot.feet):
        corners = posture.position_ankles[i] + foot.corners_from_ankle @ posture.rotation_feet_to_world[i].T
        lift = 0.0 if i in support.stance else 0.04
        assert_allclose((corners - pivot) @ R[:, 2], lift, rtol=0, atol=1e-12)
    assert len(solve_posture(dynamics, posture).q) == 22


def test_at_rest_on_a_slope_the_contacts_carry_the_weight_along_the_normal_and_along_the_slope(simulate):
    """Six degrees need friction 0.105: the foot's force is vertical, as large as the weight, and nothing slides."""
    simulation = simulate(support="left", ground={"slope_deg": 6.0, "direction_deg": 180.0})
    normal, height = floor_of(simulation.plant)
    assert_allclose(normal, Ground(slope_deg=6.0, direction_deg=180.0).rotation_at(0.0)[:, 2], rtol=0, atol=1e-12)
    assert height == pytest.approx(0.0, abs=1e-12)
    start = simulation.plant.feet()[0].position_ankle
    for _ in range(600):
        tick = simulation.tick()
    foot = simulation.plant.feet()[0]
    weight = simulation.robot.mass_kg * simulation.robot.gravity
    assert_allclose(foot.force, (0.0, 0.0, weight), rtol=0, atol=0.5)
    assert foot.force @ normal == pytest.approx(weight * math.cos(math.radians(6.0)), rel=1e-3)
    assert_allclose(foot.rotation[:, 2], normal, rtol=0, atol=1e-4)
    assert_allclose(foot.position_ankle, start, rtol=0, atol=1e-3)
    assert tick.fall_cause is None
    frames = [c.frame[:3] for c in simulation.plant.data.contact]
    assert frames
    assert_allclose(frames, np.tile(normal, (len(frames), 1)), rtol=0, atol=1e-9)


def test_the_first_millisecond_on_a_slope_is_no_blow(robot, dynamics):
    scenario = Scenario(ground=Ground(slope_deg=10.0, direction_deg=180.0))
    plant = Plant(robot, PhysicsSettings(), scenario.ground, ground_pivot(robot, Support.LEFT))
    plant.reset(solve_posture(dynamics, start_posture(scenario)).q)
    carried = sum(foot.force @ plant.ground.up for foot in plant.feet())
    assert carried == pytest.approx(robot.mass_kg * robot.gravity * math.cos(math.radians(10.0)), rel=1e-3)


def test_the_stance_sole_follows_tilting_ground_and_the_robot_stays_over_it(simulate):
    table = {"slope_deg": 5.0, "direction_deg": 0.0, "tilt_start_s": 0.1, "tilt_duration_s": 0.6}
    simulation = simulate(support="left", ground=table)
    lag = 0.0
    for _ in range(1000):
        assert simulation.tick().fall_cause is None
        up, sole = simulation.plant.ground.up, simulation.plant.feet()[0].rotation[:, 2]
        lag = max(lag, float(np.linalg.norm(np.cross(up, sole))))
    assert_allclose(simulation.plant.ground.up, Ground(**table).rotation_at(9.0)[:, 2], rtol=0, atol=1e-12)
    assert lag < np.deg2rad(0.3)
    assert simulation.plant.position_com()[2] > 0.97


def test_stones_lie_on_the_slope_and_tilt_with_it(simulate):
    stone = {"x_m": 0.4, "y_m": 0.0, "height_m": 0.02, "lying": True}
    table = {"slope_deg": 10.0, "direction_deg": 0.0, "tilt_start_s": 0.1, "tilt_duration_s": 0.2}
    simulation = simulate(support="left", stones=[stone], ground=table)
    for _ in range(350):
        simulation.tick()
    plant = simulation.plant
    geom = plant.model.geom("stone_0").id
    R = plant.data.geom_xmat[geom].reshape(3, 3)
    top = plant.data.geom_xpos[geom] + R @ [0.0, 0.0, plant.model.geom_size[geom][2]]
    expected = PIVOT + Ground(**table).rotation_at(9.0) @ [0.4, 0.0, 0.02]
    assert_allclose(R, Ground(**table).rotation_at(9.0), rtol=0, atol=1e-9)
    assert_allclose(top, expected, rtol=0, atol=1e-9)


def test_a_reset_brings_the_ground_back_to_its_start(simulate):
    ground = {"slope_deg": 5.0, "tilt_start_s": 0.0, "tilt_duration_s": 0.05}
    simulation = simulate(support="double", ground=ground)
    q = simulation.plant.sense()[0].q
    for _ in range(80):
        simulation.tick()
    assert floor_of(simulation.plant)[0][2] < 0.9999
    simulation.plant.reset(q)
    assert_allclose(floor_of(simulation.plant)[0], (0.0, 0.0, 1.0), rtol=0, atol=1e-15)


def test_released_above_the_ground_the_robot_falls_freely_and_then_is_carried(simulate):
    simulation = simulate(support="double", drop_height_m=0.01)
    assert simulation.tick().balance.normal_forces == (0.0, 0.0)
    simulation.plant.step(np.zeros(15))
    for _ in range(400):
        tick = simulation.tick()
    assert sum(tick.balance.normal_forces) == pytest.approx(simulation.robot.mass_kg * 9.81, rel=0.01)
    assert all(limit.name not in ("foot_lost", "slip") for limit in simulation.watch.events)


def test_the_soles_start_at_the_drop_height(simulate):
    simulation = simulate(support="left", drop_height_m=0.02)
    assert simulation.plant.feet()[0].position_ankle[2] == pytest.approx(0.083 + 0.02, abs=1e-9)
    assert simulation.plant.feet()[0].force[2] == 0.0
