"""Pushes give their impulse, no more and no less, at the place they say."""

import math

import mujoco
import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.errors import InvalidInput
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.feet import Support
from surefoot.simulation.conventions import qpos_from_q
from surefoot.simulation.external_forces import Push
from surefoot.simulation.physics import TIMESTEP_S, PhysicsSettings
from surefoot.simulation.plant import Plant

NO_TORQUES = np.zeros(15)


@pytest.fixture
def flying(robot, standing):
    """A plant with the robot at rest two metres up in the air."""
    plant = Plant(robot, PhysicsSettings())
    q = standing(Support.LEFT).state.q.copy()
    q[2] += 2.0
    plant.data.qpos[:] = qpos_from_q(q)
    mujoco.mj_forward(plant.model, plant.data)
    return plant


def momentum(plant, dynamics) -> tuple[np.ndarray, np.ndarray]:
    """Momentum about G (6,) and the place of G."""
    terms = dynamics.evaluate(plant.sense()[0])
    return terms.centroidal_map @ terms.state.v, terms.position_com_in_world


@pytest.mark.parametrize("direction_deg", [0.0, 90.0, 180.0, -120.0])
def test_push_through_the_centre_of_mass_gives_its_impulse_and_turns_nothing(flying, dynamics, direction_deg):
    push = Push(direction_deg=direction_deg, impulse_ns=30.0, start_s=0.02, duration_s=0.1)
    for _ in range(150):
        flying.step(NO_TORQUES, (push,) if push.active_at(flying.time_s) else ())
    gained, _ = momentum(flying, dynamics)
    angle = math.radians(direction_deg)
    impulse = [30.0 * math.cos(angle), 30.0 * math.sin(angle), -104.81 * 9.81 * 0.15]
    # the integrator's step of 1 ms loses some 1e-4 of what moves
    assert_allclose(gained[:3], impulse, rtol=0, atol=0.03)
    assert_allclose(gained[3:], 0.0, rtol=0, atol=0.03)


def rate_of_momentum(plant, dynamics, push) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """m a_G, L_G' and G for a push at rest in the air, by forward dynamics from the generalized force applied."""
    terms = dynamics.evaluate(plant.sense()[0])
    plant.step(NO_TORQUES, (push,))
    Q = plant.data.qfrc_applied.copy()
    Q[:3] = terms.rotation_pelvis_to_world.T @ Q[:3]
    rate = momentum_rate(terms, np.linalg.solve(terms.mass_matrix, Q - terms.bias))
    return rate.linear + [0.0, 0.0, terms.mass_kg * terms.gravity], rate.angular_about_com, terms.position_com_in_world


def test_push_through_the_centre_of_mass_is_a_force_without_a_moment(flying, dynamics):
    push = Push(direction_deg=30.0, impulse_ns=20.0, start_s=0.0, duration_s=0.1)
    force, moment, _ = rate_of_momentum(flying, dynamics, push)
    assert_allclose(force, push.force(), rtol=0, atol=1e-8)
    assert_allclose(moment, 0.0, rtol=0, atol=1e-8)


@pytest.mark.parametrize("link", ["trunk", "pelvis", "l_thigh", "r_foot"])
def test_push_on_a_link_acts_at_that_links_centre_of_mass(flying, dynamics, link):
    push = Push(link=link, direction_deg=-60.0, impulse_ns=20.0, start_s=0.0, duration_s=0.1)
    place = flying.data.xipos[flying.model.body(link).id].copy()
    force, moment, G = rate_of_momentum(flying, dynamics, push)
    assert_allclose(force, push.force(), rtol=0, atol=1e-8)
    assert_allclose(moment, np.cross(place - G, push.force()), rtol=0, atol=1e-8)
    assert np.abs(moment).max() > 1.0


def test_pushes_add_up_and_end(flying, dynamics):
    both = tuple(Push(direction_deg=angle, impulse_ns=10.0, start_s=0.0) for angle in (0.0, 90.0))
    flying.step(NO_TORQUES, both)
    assert flying.data.qfrc_applied.any()
    flying.step(NO_TORQUES)
    assert not flying.data.qfrc_applied.any()


@pytest.mark.parametrize("start_s", [0.0, 0.1, 0.3, 1.0, 2.7])
@pytest.mark.parametrize("duration_s", [0.001, 0.003, 0.1, 0.25])
def test_push_lasts_a_whole_number_of_ticks(start_s, duration_s):
    """Times of ticks are sums of milliseconds with their rounding: none is lost, none is added."""
    push = Push(start_s=start_s, duration_s=duration_s)
    time_s, active = 0.0, []
    for _ in range(3200):
        if push.active_at(time_s):
            active.append(time_s)
        time_s += 0.001
    assert len(active) == round(1000 * duration_s)
    assert active[0] == pytest.approx(start_s, abs=1e-9)


ODD_DURATIONS = [0.001, 0.0010000004, 0.0014, 0.0015, 0.0016, 0.002, 0.00999, 0.1, 0.12345, 1.0000001]


@pytest.mark.parametrize("start_s", [0.0, 0.0004, 0.0007, 0.3, 1.99999, 2.0])
@pytest.mark.parametrize("duration_s", ODD_DURATIONS)
def test_the_force_summed_over_the_ticks_is_the_impulse(start_s, duration_s):
    """To 1e-9 of it; the time is added up as the simulator does."""
    push = Push(direction_deg=90.0, impulse_ns=8.0, start_s=start_s, duration_s=duration_s)
    time_s, given = 0.0, 0.0
    for _ in range(3100):
        given += push.force_at(time_s)[1] * TIMESTEP_S
        time_s += TIMESTEP_S
    assert given == pytest.approx(8.0, rel=1e-9, abs=0)


@pytest.mark.parametrize("duration_s", [0.001, 0.003, 0.035, 0.07, 0.1, 0.25])
def test_every_tick_of_a_push_of_whole_ticks_gets_the_whole_force_to_the_bit(duration_s):
    push = Push(direction_deg=30.0, impulse_ns=8.0, start_s=0.1, duration_s=duration_s)
    forces = [push.force_at(0.001 * tick) for tick in range(600)]
    pushed = [force.tobytes() for force in forces if force.any()]
    assert pushed == [push.force().tobytes()] * round(1000 * duration_s)


def test_a_start_that_has_drifted_from_a_whole_tick_is_that_tick():
    """After half an hour the simulator's time is some 1e-8 s off; a page pushes then and there."""
    now = 1800.0 + 3e-8
    push = Push(start_s=now, duration_s=0.002)
    assert [push.share_of_tick(now + 0.001 * tick) for tick in (-1, 0, 1, 2)] == [0.0, 1.0, 1.0, 0.0]


@pytest.mark.parametrize("start_s", [0.02, 0.0204])
@pytest.mark.parametrize("duration_s", [0.0014, 0.0015, 0.0123])
def test_a_robot_in_the_air_gains_the_impulse_of_a_push_that_ends_within_a_tick(flying, start_s, duration_s):
    """MuJoCo's own linear momentum, by the links' masses and velocities."""
    push = Push(direction_deg=90.0, impulse_ns=8.0, start_s=start_s, duration_s=duration_s)
    for _ in range(40):
        flying.step(NO_TORQUES, (push,))
    mujoco.mj_subtreeVel(flying.model, flying.data)
    pelvis = flying.model.body(flying.robot.links[0]).id
    gained = flying.model.body_subtreemass[pelvis] * flying.data.subtree_linvel[pelvis]
    # the integrator loses some 1e-4 of what moves
    assert_allclose(gained[:2], [0.0, 8.0], rtol=0, atol=0.01)


@pytest.mark.parametrize("duration_s", [0.0014, 0.0015, 0.002, 0.0123])
def test_a_run_gives_the_impulse_of_a_push_that_ends_within_a_tick(simulate, duration_s):
    """By the generalized force of the pelvis' translation, which is the whole force of a push through the CoM."""
    push = {"direction_deg": 90.0, "impulse_ns": 8.0, "start_s": 0.004, "duration_s": duration_s}
    simulation, given = simulate(pushes=[push]), np.zeros(2)
    for _ in range(25):
        simulation.tick()
        given += simulation.plant.data.qfrc_applied[:2] * TIMESTEP_S
    assert_allclose(given, [0.0, 8.0], rtol=0, atol=8e-9)


def test_a_push_is_over_only_when_its_last_part_of_a_tick_is_given():
    push = Push(start_s=0.0204, duration_s=0.0015)  # ticks 21 and half of 22, which begins after start + duration
    assert [push.over_at(0.001 * tick) for tick in (20, 21, 22, 23)] == [False, False, False, True]


def test_force_times_duration_is_the_impulse():
    push = Push(direction_deg=90.0, impulse_ns=12.0, duration_s=0.3)
    assert_allclose(push.force() * 0.3, [0.0, 12.0, 0.0], rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    "wrong",
    [{"impulse_ns": math.nan}, {"impulse_ns": -1.0}, {"duration_s": 0.0}, {"start_s": "1"}, {"direction_deg": 400.0}],
)
def test_pushes_out_of_range_are_refused(wrong):
    with pytest.raises(InvalidInput, match=f"push.{next(iter(wrong))}.*valid"):
        Push(**wrong)


def test_a_standing_robot_is_pushed_the_way_it_says(simulate):
    for direction_deg, axis, sign in ((0.0, 0, 1), (180.0, 0, -1), (90.0, 1, 1), (-90.0, 1, -1)):
        push = {"direction_deg": direction_deg, "impulse_ns": 8.0, "start_s": 0.0, "duration_s": 0.05}
        simulation = simulate(pushes=[push])
        for _ in range(50):
            tick = simulation.tick()
        assert sign * tick.terms.velocity_com_in_world[axis] > 0.03
