"""Stones: they rise as described, from under the ground, out of a pool that recycles the oldest."""

import math

import mujoco
import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.errors import InvalidInput
from surefoot.robot.feet import Support
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant
from surefoot.simulation.stones import POOL_SIZE, Stone
from surefoot.task.reference import quintic

FAR = {"x_m": 2.0, "y_m": 1.0}
WEIGHT_N = 104.81 * 9.81


@pytest.fixture
def plant(robot, standing):
    plant = Plant(robot, PhysicsSettings())
    plant.reset(standing(Support.DOUBLE).state.q)
    return plant


def box_of(plant, stone: Stone) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper corner (3,) in world [m] of the box that MuJoCo collides with for a stone."""
    mujoco.mj_forward(plant.model, plant.data)
    for geom in range(plant.model.ngeom):
        if plant.model.geom(geom).name.startswith("stone"):
            place, half = plant.data.geom_xpos[geom], plant.model.geom_size[geom]
            if np.allclose(place[:2], (stone.x_m, stone.y_m), atol=1e-9) and place[2] > -1.0:
                return place - half, place + half
    raise AssertionError(f"{stone} is nowhere")


def test_a_stone_is_a_box_of_its_size_that_rises_to_its_height(plant):
    stone = Stone(**FAR, height_m=0.03, size_m=(0.08, 0.05), rise_start_s=0.1, rise_duration_s=0.2)
    plant.stones.place(stone)
    assert plant.stones.stones == (stone,)
    tops = {}
    for tick in range(400):
        plant.data.time = tick * 1e-3
        plant.stones.move(plant.data.time)
        lower, upper = box_of(plant, stone)
        assert_allclose((upper - lower)[:2], (0.08, 0.05), rtol=0, atol=1e-12)
        assert lower[2] < -0.01  # rooted in the ground: a thin sheet would be walked through
        tops[tick] = upper[2]
    assert tops[99] < -0.01  # hidden before it starts
    for tick in (100, 150, 200, 250, 300):
        expected = 0.03 * quintic((tick * 1e-3 - 0.1) / 0.2)[0]
        assert tops[tick] == pytest.approx(expected, abs=1e-9)
    assert tops[200] == pytest.approx(0.015, abs=1e-9)
    assert tops[399] == pytest.approx(0.03, abs=1e-12)


def test_a_stone_stays_up(plant):
    stone = Stone(**FAR, height_m=0.02, rise_start_s=0.0, rise_duration_s=0.05)
    plant.stones.place(stone)
    for time_s in np.arange(0.0, 30.0, 0.5):
        plant.stones.move(time_s)
    assert stone.settled_at(30.0)
    assert box_of(plant, stone)[1][2] == pytest.approx(0.02, abs=1e-12)


def test_a_dropped_stone_falls_freely_and_then_lies(plant):
    stone = Stone(**FAR, height_m=0.02, rise_start_s=0.1, drops=True)
    assert stone.top_at(0.0) < 0.0
    heights = [stone.top_at(0.1 + t) for t in (0.0, 0.1, 0.2, 1.0)]
    assert heights == pytest.approx([0.32, 0.32 - 0.04905, 0.32 - 0.1962, 0.02], abs=1e-9)


def test_the_pool_holds_at_least_sixteen_and_recycles_the_oldest(plant):
    assert POOL_SIZE >= 16
    stones = [Stone(x_m=-3.0 + 0.1 * i, y_m=2.0, height_m=0.01, rise_start_s=0.0) for i in range(POOL_SIZE + 3)]
    for stone in stones:
        plant.stones.place(stone)
    assert plant.stones.stones == tuple(stones[3:])
    for stone in stones[3:]:
        box_of(plant, stone)
    for stone in stones[:3]:
        with pytest.raises(AssertionError, match="nowhere"):
            box_of(plant, stone)


def test_the_newest_is_removed_first_and_its_place_is_free_again(plant):
    first, second = Stone(**FAR), Stone(x_m=-2.0)
    plant.stones.place(first)
    plant.stones.place(second)
    assert plant.stones.remove_last()
    assert plant.stones.stones == (first,)
    assert plant.stones.remove_last()
    assert not plant.stones.remove_last()
    plant.stones.place(second)
    plant.stones.clear()
    assert plant.stones.stones == ()
    mujoco.mj_forward(plant.model, plant.data)
    for geom in range(plant.model.ngeom):
        if plant.model.geom(geom).name.startswith("stone"):
            assert plant.data.geom_xpos[geom][2] < -1.0


def test_a_recycled_place_has_the_new_size(plant):
    for i in range(POOL_SIZE):
        plant.stones.place(Stone(x_m=-3.0 + 0.1 * i, y_m=2.0, size_m=(0.02, 0.02)))
    large = Stone(**FAR, height_m=0.05, size_m=(0.4, 0.3), rise_start_s=0.0, rise_duration_s=0.05)
    plant.stones.place(large)
    plant.stones.move(1.0)
    lower, upper = box_of(plant, large)
    assert_allclose((upper - lower)[:2], (0.4, 0.3), rtol=0, atol=1e-12)
    assert upper[2] == pytest.approx(0.05, abs=1e-12)


def test_a_scenarios_stone_rises_under_the_stance_foot_without_a_blow(simulate):
    """Placed from the point below the stance ankle; it lifts the outer edge, and no force shows an interpenetration."""
    stone = {"x_m": 0.05, "y_m": 0.07, "height_m": 0.01, "rise_start_s": 0.05, "rise_duration_s": 0.3}
    simulation = simulate(support="left", stones=[stone])
    (placed,) = simulation.plant.stones.stones
    assert (placed.x_m, placed.y_m) == pytest.approx((0.05, 0.11 + 0.07))
    forces, roll = [], 0.0
    for _ in range(500):
        tick = simulation.tick()
        assert tick.fall_cause is None
        forces.append(sum(tick.balance.normal_forces))
        roll = max(roll, tick.terms.feet[0].rotation_foot_to_world[2, 1])
    assert roll > 0.035  # rolled: the left edge is up
    assert max(forces) < 2.0 * WEIGHT_N


def test_a_scenarios_stone_is_placed_from_the_right_foot_in_right_support(simulate):
    simulation = simulate(support="right", stones=[{"x_m": 0.3, "y_m": -0.07}])
    (placed,) = simulation.plant.stones.stones
    assert (placed.x_m, placed.y_m) == pytest.approx((0.3, -0.11 - 0.07))


@pytest.mark.parametrize(
    "wrong",
    [
        {"height_m": -1.0}, {"height_m": 10.0}, {"height_m": math.nan}, {"x_m": 99.0}, {"rise_duration_s": 0.0},
        {"size_m": (0.06,)}, {"size_m": (0.06, 3.0)}, {"size_m": "big"}, {"size_m": (math.nan, 0.06)},
    ],
)  # fmt: skip
def test_stones_that_make_no_sense_are_refused(wrong):
    with pytest.raises(InvalidInput, match=f"stone.{next(iter(wrong))}.*valid"):
        Stone(**wrong)
