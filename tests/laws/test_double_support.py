"""Law of the split of (28) in double support: shares add up, loads hand over smoothly."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from surefoot.control.balance.contact_wrench import required_wrench, share_between_feet
from surefoot.control.balance.support import support_geometry
from surefoot.control.registry import controller_named
from surefoot.geometry.rotations import roll_about_forward_axis
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support
from surefoot.robot.sensing import FootSensing
from surefoot.task.posture import standing_reference

EXACT = {"rtol": 0, "atol": 1e-9}  # N, N m


def geometry_with_loads(robot, terms, left_n: float, right_n: float):
    wrenches = np.zeros((2, 6))
    wrenches[:, 2] = left_n, right_n
    sensing = FootSensing(wrenches)
    return support_geometry(robot, terms, Support.DOUBLE, sensing), sensing


@pytest.fixture(params=range(20))
def double(request, robot, dynamics, random_state):
    """Random postures: feet at any heights, turned anyhow; a random q''."""
    terms = dynamics.evaluate(random_state(request.param))
    acceleration = np.random.default_rng(11_000 + request.param).normal(size=21)
    geometry, _ = geometry_with_loads(robot, terms, 500.0, 500.0)
    return terms, geometry, required_wrench(terms, momentum_rate(terms, acceleration), geometry)


def test_shares_add_up_to_the_total_wrench_at_any_heights(double):
    terms, geometry, wrench = double
    shares = share_between_feet(wrench, terms, geometry)
    force, moment = np.zeros(3), np.zeros(3)
    for share in shares:
        lever = terms.feet[share.foot].position_ankle_in_world - geometry.origin
        force += share.force
        moment += share.moment_about_ankle + np.cross(lever, share.force)
    assert_allclose(force, wrench.force, **EXACT)
    assert_allclose(moment, wrench.moment, **EXACT)
    assert sum(share.share for share in shares) == pytest.approx(1.0, abs=1e-12)
    assert all(0.0 <= share.share <= 1.0 for share in shares)


@pytest.mark.parametrize("left_part", [0.0, 0.1, 0.5, 0.8, 1.0])
def test_share_follows_the_lever_rule(robot, standing, left_part):
    """The ZMP on the line between the feet, by statics: the CoM is where it should be, all else at rest."""
    terms = standing(Support.DOUBLE)
    geometry, _ = geometry_with_loads(robot, terms, 500.0, 500.0)
    left, right = geometry.points
    target = left_part * left + (1.0 - left_part) * right
    shift = terms.position_com_in_world - target  # a = g shift / h puts C at the target, for a point mass
    rate = momentum_rate(terms, np.zeros(21))
    force = rate.linear + [0.0, 0.0, terms.mass_kg * terms.gravity]
    force[:2] += terms.mass_kg * terms.gravity / terms.position_com_in_world[2] * shift[:2]
    moment = np.cross(terms.position_com_in_world - geometry.origin, force)
    zmp = np.array((-moment[1], moment[0])) / force[2]
    wrench = type(required_wrench(terms, rate, geometry))(force, moment, zmp)
    shares = share_between_feet(wrench, terms, geometry)
    assert [share.share for share in shares] == pytest.approx([left_part, 1.0 - left_part], abs=1e-9)
    for share in shares:  # C lies on the line between both P: nothing is left over for the feet themselves
        assert_allclose(share.zmp_from_point, 0.0, rtol=0, atol=1e-9)


def test_beyond_a_foot_that_foot_takes_everything(robot, standing):
    terms = standing(Support.DOUBLE)
    geometry, _ = geometry_with_loads(robot, terms, 500.0, 500.0)
    acceleration = np.linalg.solve(terms.output_jacobian, np.r_[0.0, -2.0, np.zeros(19)])
    wrench = required_wrench(terms, momentum_rate(terms, acceleration), geometry)
    assert wrench.zmp[1] > 0.11
    left, right = share_between_feet(wrench, terms, geometry)
    assert (left.share, right.share) == (1.0, 0.0)


def test_a_foot_in_the_air_takes_no_share(robot, standing):
    terms = standing(Support.DOUBLE)
    for loads, expected in (((0.0, 1000.0), (0.0, 1.0)), ((1000.0, 0.0), (1.0, 0.0))):
        geometry, _ = geometry_with_loads(robot, terms, *loads)
        wrench = required_wrench(terms, momentum_rate(terms, np.zeros(21)), geometry)
        assert tuple(share.share for share in share_between_feet(wrench, terms, geometry)) == expected


@pytest.mark.parametrize("wanted_m", [0.0, 0.018, 0.025], ids=["between", "on the left foot", "beyond the left foot"])
@pytest.mark.parametrize(
    ("name", "changes", "joints"),
    [
        ("two-part", {}, [4, 5, 10, 11]),  # the ankles' law; the QP for the others may change its active set
        ("two-part", {"other_joints": "inverse-dynamics"}, range(15)),
        ("two-part-literal", {}, range(15)),
    ],
    ids=["ankles", "all joints", "literal"],
)
def test_torques_change_smoothly_while_a_foot_takes_its_load(
    robot, dynamics, standing, name, changes, joints, wanted_m
):
    """Sensed load of the left foot from nothing to where it counts as loaded, state fixed: torques never jump.

    Also where all the weight is wanted on that foot (the CoM is to be pushed to the right), which is then told to take
    it as soon as it can. The whole way is some hundred N m over 51 N; no step of a thousand is more than a few times
    the mean one.
    """
    rng = np.random.default_rng(3)
    q = dynamics.integrate(standing(Support.DOUBLE).state.q, 0.005 * rng.normal(size=21))
    terms = dynamics.evaluate(RobotState(q, 0.02 * rng.normal(size=21)))
    reference = standing_reference(robot, Support.DOUBLE)
    reference = replace(reference, position_com=terms.position_com_in_world - [0.0, wanted_m, 0.0])
    entry = controller_named(name)
    controller = entry.build(robot, entry.settings(changes))
    steps, full = 1000, 0.05 * terms.mass_kg * terms.gravity
    torques = []
    for load in np.linspace(0.0, full, steps + 1):
        _, sensing = geometry_with_loads(robot, terms, load, 1028.0 - load)
        torques.append(controller.tick(terms, reference, sensing).torques)
    torques = np.clip(torques, -robot.torque_limits, robot.torque_limits)[:, list(joints)]  # as the motors give them
    way = np.abs(torques[-1] - torques[0]).max()
    assert way > 10.0
    assert np.abs(np.diff(torques, axis=0)).max() < 20.0 * way / steps


@pytest.mark.parametrize(("split", "ankle_nm"), [(True, 0.0), (False, 1028.2 * 0.11)], ids=["split", "no split"])
def test_without_the_split_each_ankle_is_given_everything_and_both_feet_roll_over(simulate, robot, split, ankle_nm):
    """At rest the ZMP is midway: the whole F_N, 0.11 m from each ankle, is 113 N m; the feet roll to their stops."""
    simulation = simulate("two-part-literal", support="double", controller={"double_support_split": split})
    frontal = [foot.frontal - 6 for foot in robot.feet]
    first = simulation.tick().applied[frontal]
    assert_allclose(first, ankle_nm, rtol=0.02, atol=2.0)
    roll = np.zeros(2)
    for _ in range(300):
        feet = simulation.tick().terms.feet
        roll = np.maximum(roll, [abs(roll_about_forward_axis(foot.rotation_foot_to_world)) for foot in feet])
    out_of_range = any(event.name == "joint_range" for event in simulation.watch.events)
    if split:
        assert roll.max() < 0.001
        assert not out_of_range
    else:
        assert roll.min() > np.deg2rad(10.0)  # the stops are at 12 degrees
        assert out_of_range
