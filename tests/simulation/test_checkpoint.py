"""A checkpoint holds everything that decides the future: put back, the same ticks follow to the bit."""

import threading

import numpy as np
import pytest

from surefoot.control.registry import controller_named
from surefoot.errors import InvalidInput
from surefoot.simulation.checkpoint import ModelNumbers
from surefoot.simulation.external_forces import Push
from surefoot.simulation.stones import Stone

CONTROLLERS = ("two-part", "optimization", "soft-qp", "two-part-literal")

# All at once: at the checkpoint (0.6 s) a stone rises, the ground tilts, pushes last and torques are on their way
WORLD = {
    "physics": {"control_delay_s": 0.003, "friction": 0.7},
    "ground": {"slope_deg": 1.0, "direction_deg": 30.0, "tilt_start_s": 0.4, "tilt_duration_s": 1.0},
    "stones": [{"x_m": 0.05, "y_m": 0.07, "height_m": 0.004, "rise_start_s": 0.5}],
    "pushes": [{"impulse_ns": 3.0, "start_s": 0.55, "duration_s": 0.2, "direction_deg": 120.0},
               {"link": "trunk", "impulse_ns": 2.0, "start_s": 0.58, "duration_s": 0.2}],
}  # fmt: skip


def future(simulation, ticks):
    """What everything was in each of the next ticks, bit by bit."""
    rows = []
    for _ in range(ticks):
        result = simulation.tick()
        data = simulation.plant.data
        arrays = (data.qpos, data.qvel, result.applied, result.balance.zmp_in_world)
        rows.append((*(array.tobytes() for array in arrays), result.limits, result.fall_cause))
    return rows


def first_difference(one, other):
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=True)) if a != b), None)


def disturb(simulation, height_m):
    """Change what a checkpoint must bring back: stones, model fields, pushes, controller, reference."""
    simulation.plant.stones.place(Stone(x_m=0.05, y_m=0.18, height_m=height_m, rise_start_s=simulation.time_s))
    simulation.plant.stones.remove_last()
    simulation.plant.change_physics(type(simulation.plant.physics)(friction=0.3, mass_scale=1.1))
    simulation.pushes.append(Push(impulse_ns=20.0, start_s=simulation.time_s))


@pytest.mark.parametrize("name", CONTROLLERS)
def test_the_future_repeats_to_the_bit_whatever_happened_in_between(simulate, robot, name):
    simulation = simulate(name, **WORLD)
    future(simulation, 580)
    entry = controller_named(name)
    simulation.switch(entry.build(robot, entry.settings({"com_stiffness": 65.0})))
    future(simulation, 20)  # in the middle of the fade between the two
    kept = simulation.checkpoint()
    once = future(simulation, 3000)
    table = simulation.recorder.table()
    disturb(simulation, 0.02)
    future(simulation, 100)
    for _ in range(2):  # a checkpoint is not used up
        simulation.restore(kept)
        assert simulation.time_s == pytest.approx(0.6)
        assert len(simulation.recorder) == 600
        assert simulation.plant.physics.friction == 0.7
        assert first_difference(once[:200], future(simulation, 200)) is None
    simulation.restore(kept)
    assert first_difference(once, future(simulation, 3000)) is None
    assert simulation.recorder.table().tobytes() == table.tobytes()


def test_a_fall_is_undone_and_comes_again(simulate):
    simulation = simulate("optimization", pushes=[{"impulse_ns": 60.0, "start_s": 0.5}])
    future(simulation, 600)
    kept = simulation.checkpoint()
    once = future(simulation, 1500)
    fall = (simulation.fallen, simulation.fall_time_s, tuple(simulation.watch.events))
    assert simulation.fallen
    on_the_ground = simulation.checkpoint()
    simulation.restore(kept)
    assert simulation.fallen is None
    assert first_difference(once, future(simulation, 1500)) is None
    assert (simulation.fallen, simulation.fall_time_s, tuple(simulation.watch.events)) == fall
    future(simulation, 50)
    simulation.restore(on_the_ground)  # forward again
    assert simulation.fall_time_s == fall[1]


def test_the_very_first_instant_comes_back(simulate):
    simulation = simulate("two-part", drop_height_m=0.005)
    kept = simulation.checkpoint()
    once = future(simulation, 300)
    simulation.restore(kept)
    assert first_difference(once, future(simulation, 300)) is None


def test_what_the_last_step_left_behind_comes_back_too(simulate):
    """Contacts and poses are of the instant before the state: pictures, and pushes through the CoM, read them."""
    simulation = simulate("two-part", **WORLD)
    future(simulation, 600)
    kept, data = simulation.checkpoint(), simulation.plant.data
    names = ("xpos", "xmat", "xipos", "subtree_com", "cdof", "qacc", "qfrc_constraint", "efc_force", "time")
    before = {name: np.array(getattr(data, name)) for name in names}
    future(simulation, 100)
    simulation.restore(kept)
    for name in names:
        np.testing.assert_array_equal(getattr(data, name), before[name], err_msg=name)


def test_the_model_comes_back_number_by_number(simulate):
    simulation = simulate("two-part", **WORLD)
    future(simulation, 600)
    kept, model = simulation.checkpoint(), simulation.plant.model
    names = ("geom_size", "geom_friction", "geom_pos", "geom_quat", "body_mass", "body_subtreemass", "dof_M0")
    before = {name: getattr(model, name).copy() for name in names}
    disturb(simulation, 0.05)
    future(simulation, 100)
    assert not any(
        np.array_equal(getattr(model, name), values) for name, values in before.items() if name != "geom_pos"
    )
    simulation.restore(kept)
    for name in names:
        np.testing.assert_array_equal(getattr(model, name), before[name], err_msg=name)


class Counting:
    """A controller from outside with a memory of its own."""

    def __init__(self, inner, lock=None):
        self.inner, self.ticks, self.seen, self.lock = inner, 0, [], lock

    def reset(self, last_torques=None):
        self.inner.reset(last_torques)

    def tick(self, terms, reference, sensing):
        self.ticks += 1
        self.seen.append(terms.state.time_s)
        return self.inner.tick(terms, reference, sensing)


def test_a_controller_from_outside_is_kept_with_what_it_remembers(simulate):
    simulation = simulate("two-part")
    simulation.controller = Counting(simulation.controller)
    future(simulation, 50)
    kept = simulation.checkpoint()
    future(simulation, 30)
    for _ in range(2):
        simulation.restore(kept)
        future(simulation, 10)
        assert simulation.controller.ticks == len(simulation.controller.seen) == 60


def test_a_controller_that_cannot_be_copied_is_told_by_name(simulate):
    simulation = simulate("two-part")
    simulation.controller = Counting(simulation.controller, threading.Lock())
    future(simulation, 10)
    with pytest.raises(InvalidInput, match=r"Counting.*cannot be copied.*__deepcopy__"):
        simulation.checkpoint()
    future(simulation, 10)


def test_every_number_of_the_model_but_shapes_is_kept(simulate):
    """Only what describes meshes, their boxes and pictures is left out: nothing else begins with these words."""
    model = simulate("two-part").plant.model
    numbers = ModelNumbers(model)
    once = numbers.copy()
    kept_apart = ("mesh_", "bvh_", "oct_", "skin_", "tex_")
    for structure in (model, model.opt, model.stat):
        for name in dir(structure):
            value = None if name.startswith(("_", *kept_apart)) else getattr(structure, name)
            if isinstance(value, np.ndarray) and value.size:
                before = value.copy()
                value[...] = np.logical_not(value) if value.dtype == bool else value + 1
            elif isinstance(value, int | float) and structure is not model:
                before = value
                setattr(structure, name, value + 1)
            else:
                continue
            assert not np.array_equal(numbers.copy(), once), name
            numbers.paste(once)
            np.testing.assert_array_equal(getattr(structure, name), before, err_msg=name)
