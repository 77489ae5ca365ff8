"""The observer of an offset of the CoM: what it finds, how fast, and that dynamics and a run are then of that robot."""

import math

import numpy as np
import pytest

from surefoot.dynamics.model import DynamicsModel
from surefoot.estimation.com_offset import LEAST_LOAD_SHARE, MOST_SHARE_OF_HEIGHT, CoMOffset
from surefoot.geometry.rotations import quaternion_xyzw, rotation_from_rpy
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing

TICK_S, RATE = 1e-3, 2.0
WRONG_MODEL = {"support": "double", "model_error": {"com_m": 0.02, "seed": 3}}


def turned(state: RobotState, yaw: float) -> RobotState:
    """The same robot about the world's upright axis."""
    rotation, q = rotation_from_rpy(0.0, 0.0, yaw), state.q.copy()
    q[:3] = rotation.dot(q[:3])
    q[3:7] = quaternion_xyzw(rotation)
    return RobotState(q, state.v, 0.0)


def held_up_below(point: np.ndarray, terms, share: float = 1.0) -> FootSensing:
    """Both feet carry a part of the weight, half each, whose common centre of pressure is a place of the world (2,)."""
    wrenches, force = np.zeros((2, 6)), np.array((0.0, 0.0, 0.5 * share * terms.mass_kg * terms.gravity))
    for wrench, foot in zip(wrenches, terms.feet, strict=True):
        arm = np.array((*point, 0.0)) - foot.position_ankle_in_world
        wrench[:3] = foot.rotation_foot_to_world.T.dot(force)
        wrench[3:] = foot.rotation_foot_to_world.T.dot(np.cross(arm, force))
    return FootSensing(wrenches)


@pytest.mark.parametrize("yaw", [0.0, 2.0])
def test_an_offset_of_who_stands_still_is_found_as_fast_as_is_said(robot, dynamics, standing, yaw):
    """e(t) = e_0 (1 + r t) exp(-r t), in axes of the robot and not of the world."""
    state = turned(standing(Support.DOUBLE).state, yaw)
    observer, terms = CoMOffset(robot, RATE), dynamics.evaluate(state)
    off = np.array((2e-3, -1.5e-3))  # the CoM is there, from where it is believed, heading axes
    turn = rotation_from_rpy(0.0, 0.0, yaw)[:2, :2]
    sensing = held_up_below(terms.position_com_in_world[:2] + turn.dot(off), terms)
    for i in range(1500):
        observer.evaluate(RobotState(state.q, state.v, i * TICK_S), sensing)
        if i in (500, 1499):
            left = (1.0 + RATE * i * TICK_S) * math.exp(-RATE * i * TICK_S)
            assert observer.offset == pytest.approx((1.0 - left) * off, rel=0.01)
    found = observer.evaluate(RobotState(state.q, state.v, 1.5), sensing).position_com_in_world
    assert found[:2] - terms.position_com_in_world[:2] == pytest.approx(turn.dot(observer.offset), abs=1e-5)


def test_what_the_sensor_of_a_foot_in_the_air_says_is_not_heard(robot, dynamics, standing):
    state = standing(Support.LEFT).state
    terms, biased = dynamics.evaluate(state), np.zeros((2, 6))
    arm = np.array((*terms.position_com_in_world[:2], 0.0)) - terms.feet[0].position_ankle_in_world
    force = np.array((0.0, 0.0, terms.mass_kg * terms.gravity))
    biased[0, :3], biased[0, 3:] = force, np.cross(arm, force)
    biased[1] = (5.0, -8.0, 30.0, 2.0, 3.0, 0.0)
    observer = CoMOffset(robot, RATE)
    for i in range(500):
        observer.evaluate(RobotState(state.q, state.v, i * TICK_S), FootSensing(biased))
    assert np.abs(observer.offset).max() < 1e-6


def test_it_learns_nothing_in_the_air_and_never_too_much(robot, dynamics, standing):
    state = standing(Support.DOUBLE).state
    terms = dynamics.evaluate(state)
    far = terms.position_com_in_world[:2] + (0.5, 0.0)
    in_air, standing_far = CoMOffset(robot, RATE), CoMOffset(robot, 5.0)
    for i in range(3000):
        now = RobotState(state.q, state.v, i * TICK_S)
        if i < 100:
            in_air.evaluate(now, held_up_below(far, terms, 0.9 * LEAST_LOAD_SHARE))
        standing_far.evaluate(now, held_up_below(far, terms))
    assert not in_air.offset.any()
    height = float(terms.position_com_in_world[2]) - min(
        float(foot.point_below(now.position_ankle_in_world, now.rotation_foot_to_world)[2])
        for now, foot in zip(terms.feet, robot.feet, strict=True)
    )
    assert standing_far.offset == pytest.approx((MOST_SHARE_OF_HEIGHT * height, 0.0), abs=1e-3)


def test_a_moved_com_is_a_robot_of_its_own_gravity_and_the_nominal_one_stays(robot, dynamics, standing):
    """By two roads: where the CoM is, and the moment of gravity about the base."""
    state = standing(Support.DOUBLE).state
    moved, by = DynamicsModel(robot, adaptable=True), np.array((0.02, -0.01, 0.0))
    before = dynamics.evaluate(state)
    moved.move_com(np.ones(3))
    moved.move_com(by)  # from the nominal place, not from the last one
    after = moved.evaluate(state)
    turn = before.rotation_pelvis_to_world
    assert after.position_com_in_world - before.position_com_in_world == pytest.approx(turn.dot(by), abs=1e-12)
    assert after.mass_kg == before.mass_kg
    weight = turn.T.dot((0.0, 0.0, before.mass_kg * before.gravity))
    assert after.bias[:3] == pytest.approx(before.bias[:3], abs=1e-9)
    assert after.bias[3:6] - before.bias[3:6] == pytest.approx(np.cross(by, weight), abs=1e-9)
    assert after.bias[6:] == pytest.approx(before.bias[6:], abs=1e-9)  # gravity in the joints is of the links below
    assert np.array_equal(dynamics.evaluate(state).bias, before.bias)


def test_a_run_finds_the_offset_of_a_plant_that_is_not_its_model_and_comes_again(simulate):
    simulation = simulate(**WRONG_MODEL, estimator={"kind": "anchor", "com_offset_rate": 3.0})
    first = np.hypot(*simulation.tick().belief.dcm_error)
    for _ in range(1000):
        simulation.tick()
    kept, last = simulation.checkpoint(), simulation.tick()
    assert first > 5e-4 and np.hypot(*last.belief.dcm_error) < 0.35 * first  # without it, it stays as it is
    after = [simulation.tick().output.torques for _ in range(50)]
    offset = simulation.senses.com_offset.offset.copy()
    simulation.restore(kept)
    simulation.tick()
    again = [simulation.tick().output.torques for _ in range(50)]
    assert np.array_equal(after, again)
    assert np.array_equal(offset, simulation.senses.com_offset.offset)
