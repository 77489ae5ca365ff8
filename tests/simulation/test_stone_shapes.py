"""Wedges and half-balls: where their surface is, what a foot feels of them, and that a pool can be put back."""

import mujoco
import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.robot.feet import Support
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant
from surefoot.simulation.stone_pool import STONE_PREFIX
from surefoot.simulation.stones import POOL_SIZE, Stone

X, Y, HEIGHT, LENGTH, WIDTH = 1.5, 1.0, 0.03, 0.12, 0.08
RISEN = {"rise_start_s": 0.0, "rise_duration_s": 0.05}
WEDGE_SLOPE = np.deg2rad(15.0)


@pytest.fixture
def plant(robot, standing):
    plant = Plant(robot, PhysicsSettings())
    plant.reset(standing(Support.DOUBLE).state.q)
    return plant


def height_at(plant, x: float, y: float) -> float:
    """Height [m] of whatever a plumb line meets first, by MuJoCo's own ray caster."""
    mujoco.mj_forward(plant.model, plant.data)
    geom = np.zeros(1, dtype=np.int32)
    start, down = np.array((x, y, 1.0)), np.array((0.0, 0.0, -1.0))
    reach = mujoco.mj_ray(plant.model, plant.data, start, down, None, 1, -1, geom, None)
    return 1.0 - reach


def stone(shape: str, **more) -> Stone:
    return Stone(x_m=X, y_m=Y, height_m=HEIGHT, size_m=(LENGTH, WIDTH), shape=shape, **RISEN, **more)


def wedge_surface(dx: float, dy: float) -> float:
    """A plane that rises to the left and reaches its height at the box's left edge, half a width along the slope."""
    return HEIGHT - np.tan(WEDGE_SLOPE) * (0.5 * WIDTH * np.cos(WEDGE_SLOPE) - dy)


def ball_surface(dx: float, dy: float) -> float:
    return HEIGHT * np.sqrt(1.0 - (2.0 * dx / LENGTH) ** 2 - (2.0 * dy / WIDTH) ** 2)


@pytest.mark.parametrize(
    ("placed", "surface"),
    [
        (stone("box"), lambda dx, dy: HEIGHT),
        (stone("wedge", slope_deg=15.0, slope_direction_deg=90.0), wedge_surface),
        (stone("half-ball"), ball_surface),
    ],
    ids=["box", "wedge", "half-ball"],
)
def test_its_surface_is_where_its_description_says(plant, placed, surface):
    plant.stones.place(placed)
    plant.stones.move(1.0)
    for dx, dy in ((0.0, 0.0), (0.03, 0.0), (-0.04, 0.01), (0.01, -0.02), (0.0, 0.035)):
        assert height_at(plant, X + dx, Y + dy) == pytest.approx(surface(dx, dy), abs=1e-6)
    highest = max(height_at(plant, X, Y + dy) for dy in np.linspace(-0.05, 0.05, 401))
    assert highest == pytest.approx(HEIGHT, abs=1e-4)


def test_a_wedge_may_rise_to_any_side_and_starts_hidden(plant):
    placed = stone("wedge", slope_deg=15.0, slope_direction_deg=180.0)
    plant.stones.place(placed)
    assert height_at(plant, X, Y) == pytest.approx(0.0, abs=1e-9)
    plant.stones.move(1.0)
    assert height_at(plant, X - 0.05, Y) > height_at(plant, X, Y) > height_at(plant, X + 0.05, Y)


def test_a_foot_on_a_wedge_feels_the_wedges_normal(simulate):
    wedge = {
        "x_m": 0.05, "y_m": 0.07, "height_m": 0.02, "shape": "wedge", "slope_deg": 20.0, "slope_direction_deg": 90.0,
        "rise_start_s": 0.05, "rise_duration_s": 0.2,
    }  # fmt: skip
    simulation = simulate(support="left", stones=[wedge])
    plant, normals = simulation.plant, []
    for _ in range(150):
        simulation.tick()
        for i in range(plant.data.ncon):
            contact = plant.data.contact[i]
            stones = [plant.model.geom(int(geom)).name.startswith(STONE_PREFIX) for geom in contact.geom]
            if any(stones):
                normals.append(contact.frame[:3] * (1.0 if stones[0] else -1.0))  # from the stone to the foot
    assert normals
    expected = (0.0, -np.sin(np.deg2rad(20.0)), np.cos(np.deg2rad(20.0)))  # it rises to the left, so it leans right
    np.testing.assert_allclose(normals[0], expected, rtol=0, atol=1e-3)


def test_half_balls_have_a_pool_of_their_own(plant):
    boxes = [Stone(x_m=-3.0 + 0.1 * i, y_m=2.0) for i in range(POOL_SIZE)]
    balls = [Stone(x_m=-3.0 + 0.1 * i, y_m=-2.0, shape="half-ball") for i in range(POOL_SIZE)]
    for placed in (*boxes, *balls):
        plant.stones.place(placed)
    assert plant.stones.stones == (*boxes, *balls)
    plant.stones.place(stone("half-ball"))
    assert plant.stones.stones == (*boxes, *balls[1:], stone("half-ball"))


def test_stones_are_moved_and_removed_by_their_number(plant):
    first = plant.stones.place(stone("box"))
    second = plant.stones.place(stone("half-ball"))
    plant.stones.move_to(first, stone("box").at(-2.0, -1.0))
    plant.stones.move(1.0)
    assert height_at(plant, -2.0, -1.0) == pytest.approx(HEIGHT, abs=1e-9)
    plant.stones.remove(second)
    assert height_at(plant, X, Y) == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(InvalidInput, match=r"there is no such stone .*valid: 1"):
        plant.stones.remove(second)


def test_a_pool_is_put_back_to_the_bit(plant):
    plant.stones.place(stone("wedge"))
    plant.stones.place(stone("half-ball").at(-1.0, 1.0))
    plant.data.time = 0.02
    plant.stones.move(0.02)
    state = plant.stones.state()
    before = (plant.data.mocap_pos.copy(), plant.data.mocap_quat.copy(), plant.model.geom_size.copy())
    plant.stones.remove_last()
    plant.stones.place(stone("box"))
    plant.stones.place(Stone(x_m=0.0, y_m=2.0, size_m=(0.3, 0.3), shape="half-ball"))
    plant.stones.restore(state)
    used = [placed.slot for placed in plant.stones.placed]
    mocap = [int(plant.model.body(f"{STONE_PREFIX}{slot}").mocapid[0]) for slot in used]
    geoms = [plant.model.geom(f"{STONE_PREFIX}{slot}").id for slot in used]
    assert plant.stones.state() == state
    np.testing.assert_array_equal(plant.data.mocap_pos, before[0])
    np.testing.assert_array_equal(plant.data.mocap_quat[mocap], before[1][mocap])
    np.testing.assert_array_equal(plant.model.geom_size[geoms], before[2][geoms])


@pytest.mark.parametrize(
    ("wrong", "says"),
    [({"shape": "cone"}, "box, wedge, half-ball"), ({"slope_deg": 12.0}, "wedge"),
     ({"shape": "half-ball", "slope_direction_deg": 0.0}, "wedge"), ({"shape": "wedge", "slope_deg": 60.0}, "1 to 30")],
)  # fmt: skip
def test_shapes_that_make_no_sense_are_refused(wrong, says):
    with pytest.raises(InvalidInput, match=says):
        Stone(**wrong)
