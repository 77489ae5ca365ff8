"""After a reset the robot stands with the ground carrying its weight: no drop, no spike."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.robot.feet import Support
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.plant import Plant
from surefoot.simulation.stones import Stone
from surefoot.task.posture import solve_posture, standing_reference

WEIGHT_N = 104.81 * 9.81


@pytest.fixture
def posture(robot, dynamics):
    return lambda support: solve_posture(dynamics, standing_reference(robot, Support(support))).q


@pytest.mark.parametrize("mass_scale", [1.0, 1.3, 0.7])
@pytest.mark.parametrize("support", Support)
def test_load_cells_feel_the_weight_at_once(robot, posture, support, mass_scale):
    plant = Plant(robot, PhysicsSettings(mass_scale=mass_scale))
    plant.reset(posture(support))
    _, sensing = plant.sense()
    assert sum(sensing.normal_forces) == pytest.approx(mass_scale * WEIGHT_N, rel=1e-4)
    for i in range(2):
        carries = i in support.stance
        assert (sensing.normal_forces[i] > 0.3 * mass_scale * WEIGHT_N) == carries


@pytest.mark.parametrize("support", Support)
def test_robot_neither_drops_nor_bounces_in_the_first_100_ms(simulate, support):
    simulation = simulate(support=support.value)
    heights, forces = [], []
    for _ in range(100):
        tick = simulation.tick()
        heights.append(tick.terms.position_com_in_world[2])
        forces.append(sum(tick.balance.normal_forces))
    assert np.ptp(heights) < 0.0005
    assert max(forces) < 1.5 * WEIGHT_N
    assert min(forces) > 0.5 * WEIGHT_N


def test_soles_sink_less_than_a_millimetre(robot, posture):
    plant = Plant(robot, PhysicsSettings())
    q = posture(Support.DOUBLE)
    plant.reset(q)
    state, _ = plant.sense()
    assert -0.001 < state.q[2] - q[2] <= 0.0
    assert_allclose(np.delete(state.q, 2), np.delete(q, 2), rtol=0, atol=1e-12)
    assert not state.v.any()


def test_reset_forgets_time_speed_stones_and_torques(simulate):
    simulation = simulate(pushes=[{"impulse_ns": 20.0, "start_s": 0.0}])
    plant = simulation.plant
    first, _ = plant.sense()
    plant.stones.place(Stone())
    for _ in range(50):
        simulation.tick()
    plant.reset(simulation_start(simulation))
    again, _ = plant.sense()
    assert plant.time_s == 0.0
    assert plant.stones.stones == ()
    assert_allclose(again.q, first.q, rtol=0, atol=1e-12)
    assert not again.v.any()
    assert not plant.data.ctrl.any()
    assert not plant.data.qfrc_applied.any()


def simulation_start(simulation) -> np.ndarray:
    """The configuration that the simulation was built with."""
    from surefoot.dynamics.model import DynamicsModel

    return solve_posture(DynamicsModel(simulation.robot), simulation.reference.at(0.0)).q
