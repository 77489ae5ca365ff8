"""Every named cause of a fall is reached by a construction of its own."""

import mujoco
import numpy as np
import pytest

from surefoot.geometry.rotations import rotation_from_rpy
from surefoot.robot.description import load_robot
from surefoot.robot.feet import Support
from surefoot.simulation.falls import FALL_CAUSES, fall_cause_text


def test_a_standing_robot_has_not_fallen(simulate):
    simulation = simulate()
    for _ in range(20):
        assert simulation.tick().fall_cause is None
    assert simulation.fallen is None
    assert simulation.fall_time_s is None


def test_squatting_below_065_m_is_pelvis_low(limp, put, standing, robot):
    simulation = limp(support="double")
    q = standing(Support.DOUBLE).state.q.copy()
    q[2] = 0.649
    for side in ("left", "right"):
        for joint, angle in (("hip_sagittal", -1.17), ("knee", 1.41), ("ankle_sagittal", -0.24)):
            q[robot.joint_named(f"{side}_{joint}").dof + 1] = angle
    put(simulation, q)
    assert simulation.tick().fall_cause == "pelvis_low"
    assert simulation.fallen == "pelvis_low"
    assert simulation.fall_time_s == 0.0


@pytest.mark.parametrize(("roll", "pitch"), [(0.0, 0.75), (0.0, -0.75), (0.75, 0.0), (-0.75, 0.0)])
def test_leaning_more_than_40_degrees_is_trunk_tilt(limp, put, standing, roll, pitch):
    simulation = limp(support="double")
    q = standing(Support.DOUBLE).state.q.copy()
    q[2] += 1.0
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, rotation_from_rpy(roll, pitch, 0.0).reshape(-1))
    q[3:7] = np.roll(quaternion, -1)
    put(simulation, q)
    assert simulation.tick().fall_cause == "trunk_tilt"


@pytest.mark.parametrize("support", ["left", "right"])
def test_weight_on_the_swing_foot_is_support_lost(limp, standing, support):
    """The robot stands on both feet although one was planned."""
    simulation = limp(support=support)
    simulation.plant.reset(standing(Support.DOUBLE).state.q)
    assert simulation.tick().fall_cause == "support_lost"


@pytest.mark.parametrize("where", ["qpos", "qvel"])
def test_a_state_that_is_no_number_is_nan(simulate, where):
    simulation = simulate()
    simulation.tick()
    getattr(simulation.plant.data, where)[9] = np.nan
    tick = simulation.tick()
    assert tick.fall_cause == "nan"
    assert tick.terms is None
    assert not tick.applied.any()


def test_a_limp_robot_falls_and_the_first_cause_is_kept(limp):
    simulation = limp(support="double")
    causes = [simulation.tick().fall_cause for _ in range(1500)]
    first = next(cause for cause in causes if cause)
    assert simulation.fallen == first
    assert simulation.fall_time_s == pytest.approx(1e-3 * causes.index(first), abs=1e-9)
    assert first in FALL_CAUSES


def test_every_cause_has_a_sentence():
    assert set(FALL_CAUSES) == {
        "pelvis_low",
        "trunk_tilt",
        "nan",
        "controller_error",
        "estimator_error",
        "support_lost",
    }


def test_what_a_cause_means_has_the_numbers_of_the_robot(robot):
    """A fall of Bip: below 0.65 m, more than 50 N; the other robot has 0.81 of its height and 0.33 of its weight."""
    bip, offset = robot.sizes, load_robot("offset").sizes
    assert fall_cause_text("pelvis_low", bip) == "the base is below 0.65 m"
    assert fall_cause_text("support_lost", bip) == "the swing foot carries more than 50 N"
    assert fall_cause_text("pelvis_low", offset) == "the base is below 0.529 m"
    assert fall_cause_text("support_lost", offset) == "the swing foot carries more than 17 N"
