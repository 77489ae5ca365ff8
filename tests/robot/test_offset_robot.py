"""A robot that is not Bip: ankle axes that do not meet, roll before pitch, flipped signs, arms, turned foot links."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

from surefoot.control.balance.ankle_law import torques_point_at_ankle, torques_point_on_ground, with_zmp_shift
from surefoot.control.balance.contact_wrench import joint_torques, required_wrench, share_between_feet
from surefoot.control.balance.support import support_geometry
from surefoot.dynamics.model import DynamicsModel
from surefoot.dynamics.terms import FOOT_ROWS, PELVIS, UPPER
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.momentum.delta import momentum_rate
from surefoot.robot.description import RobotState, load_robot
from surefoot.robot.feet import Support
from surefoot.robot.leg_chains import leg_joints
from surefoot.robot.sensing import FULLY_LOADED
from surefoot.simulation.measurement import contact_forces
from surefoot.task.posture import solve_posture, standing_com_height, standing_reference

EXACT = {"rtol": 0, "atol": 1e-10}  # N m: sums of terms up to 1e2 N m in another order
SEEDS = range(20)


@pytest.fixture(scope="module")
def robot():
    return load_robot("offset")


@pytest.fixture(scope="module")
def dynamics(robot):
    return DynamicsModel(robot)


@pytest.fixture(scope="module")
def draw(robot, dynamics):
    """Seed -> terms at a random state inside the joint ranges, and a random q''."""

    def evaluate(seed: int):
        rng = np.random.default_rng(seed)
        pose = np.concatenate((rng.normal(size=6), np.zeros(len(robot.joints))))
        q = dynamics.integrate(dynamics.neutral(np.zeros(3)), pose)
        q[7:] = rng.uniform(robot.joint_lower, robot.joint_upper)
        return dynamics.evaluate(RobotState(q, rng.normal(size=robot.dofs))), rng.normal(scale=3.0, size=robot.dofs)

    return evaluate


def names_of(robot, dofs) -> list[str]:
    return [joint.name for dof in dofs for joint in robot.joints if joint.dof == dof]


def test_legs_ankles_and_upper_joints_are_found_from_the_chains(robot):
    assert names_of(robot, robot.upper) == ["waist_yaw", "left_shoulder", "right_shoulder"]
    for side, foot in zip(("left", "right"), robot.feet, strict=True):
        parts = ("hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_roll", "ankle_pitch")
        assert names_of(robot, foot.leg) == [f"{side}_{part}" for part in parts]
        assert names_of(robot, (foot.sagittal, foot.frontal)) == [f"{side}_ankle_pitch", f"{side}_ankle_roll"]
        assert foot.ankle_height_m == pytest.approx(0.0675, abs=1e-12)
        assert_allclose(foot.sole.vertices.min(axis=0), (-0.065, -0.045), rtol=0, atol=1e-12)
        assert_allclose(foot.sole.vertices.max(axis=0), (0.135, 0.045), rtol=0, atol=1e-12)


def test_a_leg_of_another_number_of_joints_is_refused(robot):
    with pytest.raises(InvalidInput, match=r"l_shank.* 4 joints \(valid: 6\)"):
        leg_joints(robot.pinocchio_model, "l_shank", "r_foot")


def test_every_ratio_of_bip_to_itself_is_one():
    sizes = load_robot("bip").sizes
    assert (sizes.weight, sizes.leg, sizes.com_height, sizes.base_height) == (1.0, 1.0, 1.0, 1.0)
    assert (sizes.foot_spread_m, sizes.base_below_com_m) == (0.11, 0.1)


@pytest.mark.parametrize("seed", range(4))
def test_output_jacobian_is_the_derivative_of_kappa(dynamics, draw, seed):
    """Central differences along v over 1e-5 s: truncation and rounding of some 1e-10, times derivatives of tens."""
    terms, _ = draw(seed)
    q, v, step = terms.state.q, terms.state.v, 1e-5
    ways = (step * v, -step * v)
    after, before = (dynamics.evaluate(RobotState(dynamics.integrate(q, way), v)) for way in ways)
    rates = terms.output_velocity
    assert_allclose((after.upper_rad - before.upper_rad) / (2 * step), rates[UPPER], rtol=0, atol=1e-8)
    assert_allclose(rates[PELVIS], terms.rotation_pelvis_to_world @ v[3:6], rtol=0, atol=1e-12)
    for i, rows in enumerate(FOOT_ROWS):
        moved = after.feet[i].position_ankle_in_world - before.feet[i].position_ankle_in_world
        turned = after.feet[i].rotation_foot_to_world @ before.feet[i].rotation_foot_to_world.T
        assert_allclose(np.r_[moved, pin.log3(turned)] / (2 * step), rates[rows], rtol=0, atol=1e-7)
    assert_allclose(
        (after.output_velocity - before.output_velocity) / (2 * step), terms.output_drift, rtol=0, atol=1e-6
    )


@pytest.mark.parametrize("support", [Support.LEFT, Support.RIGHT])
@pytest.mark.parametrize("seed", SEEDS)
def test_ankle_torques_equal_inverse_dynamics(robot, draw, on_feet, support, seed):
    """(28) by recursive Newton-Euler with the ground's wrench on the foot's link; the force's lever is part of it."""
    terms, acceleration = draw(seed)
    share, foot = on_feet(terms, acceleration, support), robot.feet[support.reference_foot]
    model = robot.pinocchio_model
    link = model.frames[model.getFrameId(foot.body)]
    R = terms.feet[share.foot].rotation_foot_to_world @ foot.rotation_in_body.T
    about_link = share.moment_about_ankle + np.cross(R @ foot.ankle_in_body, share.force)
    external = [pin.Force.Zero() for _ in range(model.njoints)]
    external[link.parentJoint] = link.placement.act(pin.Force(R.T @ share.force, R.T @ about_link))
    generalized = pin.rnea(model, model.createData(), terms.state.q, terms.state.v, acceleration, external)

    torques = torques_point_at_ankle(foot, terms, share, acceleration)
    assert_allclose(torques, generalized[[foot.sagittal, foot.frontal]], **EXACT)
    assert_allclose(joint_torques(terms, acceleration, (share,)), generalized[6:], **EXACT)
    lever = terms.feet[share.foot].jacobian[:3, [foot.sagittal, foot.frontal]]
    assert np.abs(share.force @ lever).max() > 0.1  # what a law for axes that meet would leave out


@pytest.fixture(scope="module")
def on_feet(robot):
    """Terms, q'' and a single support -> the stance foot's share: the whole wrench."""

    def share(terms, acceleration, support):
        geometry = support_geometry(robot, terms, support, FULLY_LOADED)
        wrench = required_wrench(terms, momentum_rate(terms, acceleration), geometry)
        return share_between_feet(wrench, terms, geometry)[0]

    return share


@pytest.mark.parametrize("support", [Support.LEFT, Support.RIGHT])
def test_the_printed_law_moves_the_zmp_as_the_exact_one_does(robot, dynamics, on_feet, support):
    """Both answer a ZMP 10 mm ahead, and one 10 mm to the left, alike up to the tilt of the axes (some 0.4 rad)."""
    posture = solve_posture(dynamics, standing_reference(robot, support))
    terms = dynamics.evaluate(RobotState(posture.q, np.zeros(robot.dofs)))
    foot, rest = robot.feet[support.reference_foot], np.zeros(robot.dofs)
    share = on_feet(terms, rest, support)
    for axis, shift in ((0, np.array((0.01, 0.0))), (1, np.array((0.0, 0.01)))):
        moved = with_zmp_shift(share, shift)
        exact = np.subtract(*(torques_point_at_ankle(foot, terms, s, rest) for s in (moved, share)))[axis]
        printed = np.subtract(
            *(torques_point_on_ground(foot, terms, s, tangential_term=False) for s in (moved, share))
        )[axis]
        assert abs(printed) == pytest.approx(0.01 * share.force[2], rel=1e-9)
        assert exact == pytest.approx(printed, rel=0.1)


@pytest.mark.parametrize("name", ["two-part", "soft-qp", "optimization"])
def test_it_stands_for_five_seconds_on_two_feet(robot, name):
    scenario = scenario_from_table({"robot": "offset", "support": "double", "duration_s": 5.0})
    setup = build_simulation(scenario, name, rows=1)
    assert setup.warnings == ()
    simulation, infeasible = setup.simulation, 0
    for _ in range(scenario.ticks):
        tick = simulation.tick()
        infeasible += tick.output.infeasible
    assert simulation.fallen is None
    assert infeasible == 0
    assert_allclose(tick.terms.position_com_in_world, tick.reference.position_com, rtol=0, atol=1e-3)

    # the plant's feet and the controllers' are the same, and so is what the ground does to them
    points = contact_forces(simulation.plant)
    assert points[:, 5].sum() == pytest.approx(robot.mass_kg * robot.gravity, rel=1e-3)
    for foot, truth in zip(tick.terms.feet, simulation.plant.feet(), strict=True):
        assert_allclose(truth.position_ankle, foot.position_ankle_in_world, rtol=0, atol=1e-12)
        assert_allclose(truth.rotation, foot.rotation_foot_to_world, rtol=0, atol=1e-12)
        near = points[np.sign(points[:, 1]) == np.sign(truth.position_ankle[1])]
        assert_allclose(truth.force, near[:, 3:].sum(axis=0), rtol=0, atol=1e-6)
        about = np.cross(near[:, :3] - truth.position_ankle, near[:, 3:]).sum(axis=0)
        assert_allclose(truth.moment, about, rtol=0, atol=1e-6)


def test_it_stands_on_one_foot(robot):
    scenario = scenario_from_table({"robot": "offset", "support": "right", "duration_s": 1.0})
    simulation = build_simulation(scenario, "two-part", rows=1).simulation
    ticks = [simulation.tick() for _ in range(scenario.ticks)]
    assert simulation.fallen is None
    assert max(np.abs(tick.output.torques / robot.torque_limits).max() for tick in ticks) < 1.0


def test_a_given_standing_posture_is_where_heights_and_upper_joints_come_from(robot, dynamics):
    """Of a posture that was solved: the same height of G, to a millimetre, and the arm where it was put."""
    q = solve_posture(dynamics, standing_reference(robot, Support.DOUBLE)).q
    angles = {joint.name: float(q[joint.dof + 1]) for joint in robot.joints}
    posed = replace(robot, posture_rad=angles | {"left_shoulder": 0.3})
    assert standing_com_height(posed) == pytest.approx(standing_com_height(robot), abs=2e-3)
    solved = solve_posture(DynamicsModel(posed), standing_reference(posed, Support.DOUBLE))
    assert solved.out_of_range == ()
    assert solved.q[posed.joint_named("left_shoulder").dof + 1] == pytest.approx(0.3, abs=1e-9)
