"""Every named limit that can go first on the way to a fall is reached by a construction of its own."""

import numpy as np
import pytest

from surefoot.robot.feet import Support
from surefoot.simulation.falls import LIMITS, PERSISTENCE_TICKS


def first_limit(simulation, ticks: int = 400) -> str | None:
    for _ in range(ticks):
        simulation.tick()
        if simulation.watch.first:
            assert simulation.watch.first.name in LIMITS
            return simulation.watch.first.name
    return None


def test_more_torque_than_the_motor_has_is_the_torque_limit(limp, robot):
    torques = np.zeros(15)
    torques[robot.joint_named("trunk_yaw").dof - 6] = 301.0
    simulation = limp(torques, support="double")
    for _ in range(PERSISTENCE_TICKS - 1):
        simulation.tick()
        assert "torque" not in [event.name for event in simulation.watch.events]
    simulation.tick()
    assert "torque" in [event.name for event in simulation.watch.events]
    event = next(event for event in simulation.watch.events if event.name == "torque")
    assert event.time_s == pytest.approx(0.0, abs=1e-9)  # when it began, not when it had lasted


def test_no_torque_limit_no_torque_event(limp, robot):
    torques = np.zeros(15)
    torques[robot.joint_named("trunk_yaw").dof - 6] = 301.0
    simulation = limp(torques, support="double", physics={"torque_limits": False})
    for _ in range(20):
        simulation.tick()
    assert "torque" not in [event.name for event in simulation.watch.events]


def test_an_infeasible_tick_counts_at_once(limp):
    simulation = limp(infeasible=True, support="double")
    simulation.tick()
    assert [event.name for event in simulation.watch.events] == ["qp_infeasible"]


def test_a_joint_beyond_its_range_is_joint_range(limp, put, standing, robot):
    simulation = limp(support="double")
    q = standing(Support.DOUBLE).state.q.copy()
    q[robot.joint_named("trunk_frontal").dof + 1] = 0.1  # range +-0.08
    q[2] += 1.0
    put(simulation, q)
    simulation.tick()
    for _ in range(PERSISTENCE_TICKS):
        simulation.tick()
    assert "joint_range" in [event.name for event in simulation.watch.events]


def test_a_stance_foot_that_leaves_the_ground_is_foot_lost(limp, put, standing):
    simulation = limp(support="left")
    for _ in range(3):
        simulation.tick()
    q = standing(Support.LEFT).state.q.copy()
    q[2] += 0.5
    put(simulation, q)
    for _ in range(PERSISTENCE_TICKS):
        simulation.tick()
    event = next(event for event in simulation.watch.events if event.name == "foot_lost")
    assert event.time_s == pytest.approx(0.003, abs=1e-9)


def test_a_push_on_ice_is_slip(simulate):
    push = {"direction_deg": 0.0, "impulse_ns": 20.0, "start_s": 0.0, "duration_s": 0.1}
    simulation = simulate("soft-qp", support="double", pushes=[push], physics={"friction": 0.01})
    for _ in range(400):
        simulation.tick()
    assert "slip" in [event.name for event in simulation.watch.events]


def test_tipping_over_the_toes_is_zmp_edge(simulate):
    """The literal law, which asks for any ZMP, after a hard push."""
    push = {"direction_deg": 0.0, "impulse_ns": 45.0, "start_s": 0.0, "duration_s": 0.1}
    simulation = simulate("two-part-literal", pushes=[push])
    assert first_limit(simulation) == "zmp_edge"
    # the margin is measured against the true sole: it was inside before
    assert simulation.watch.first.time_s > 0.0


def test_every_limit_has_a_sentence():
    assert set(LIMITS) == {"zmp_edge", "qp_infeasible", "torque", "joint_range", "slip", "foot_lost"}
