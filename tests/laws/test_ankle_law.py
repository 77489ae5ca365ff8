"""Law of (28): the ankle torques equal inverse dynamics (RNEA with the ground's wrench), by several roads."""

import numpy as np
import pinocchio as pin
import pytest
from numpy.testing import assert_allclose

from surefoot.control.balance.ankle_law import torques_point_at_ankle, torques_point_on_ground
from surefoot.control.balance.contact_wrench import joint_torques, required_wrench, share_between_feet
from surefoot.dynamics.links import evaluate_links
from surefoot.momentum.delta import contact_moment_from_links, momentum_rate
from surefoot.robot.description import RobotState
from surefoot.robot.feet import Support

EXACT = {"rtol": 0, "atol": 1e-9}  # N m: sums of terms up to 1e3 N m in another order
SEEDS = range(20)


@pytest.fixture(params=[(support, seed) for support in (Support.LEFT, Support.RIGHT) for seed in SEEDS])
def stance(request, dynamics, random_state, on_its_feet):
    """Foot index, terms at a random state, a random q'', and the stance foot's share: the whole wrench."""
    support, seed = request.param
    terms = dynamics.evaluate(random_state(seed))
    acceleration = np.random.default_rng(7000 + seed).normal(scale=3.0, size=21)
    (share,) = shares_of(terms, acceleration, support, on_its_feet)
    return support.reference_foot, terms, acceleration, share


def shares_of(terms, acceleration, support, on_its_feet):
    geometry, _ = on_its_feet(terms, support)
    wrench = required_wrench(terms, momentum_rate(terms, acceleration), geometry)
    return share_between_feet(wrench, terms, geometry)


def rnea(robot, terms, acceleration, foot: int, share) -> np.ndarray:
    """Generalized forces (21,) by recursive Newton-Euler with the ground's wrench on the foot's link."""
    model = robot.pinocchio_model
    joint = model.frames[model.getFrameId(robot.feet[foot].body)].parentJoint
    R = terms.feet[foot].rotation_foot_to_world  # the link's frame sits at the ankle centre
    external = [pin.Force.Zero() for _ in range(model.njoints)]
    external[joint] = pin.Force(R.T @ share.force, R.T @ share.moment_about_ankle)
    return pin.rnea(model, model.createData(), terms.state.q, terms.state.v, acceleration, external)


def test_ankle_torques_equal_inverse_dynamics(robot, stance):
    index, terms, acceleration, share = stance
    foot = robot.feet[index]
    generalized = rnea(robot, terms, acceleration, index, share)
    torques = torques_point_at_ankle(foot, terms, share, acceleration)
    assert np.abs(torques).max() > 1.0
    assert_allclose(torques, generalized[[foot.sagittal, foot.frontal]], **EXACT)
    assert_allclose(generalized[:6], 0.0, **EXACT)  # the share really is all that the pelvis needs


def test_all_joint_torques_equal_inverse_dynamics(robot, stance):
    """(22) for the other joints."""
    index, terms, acceleration, share = stance
    assert_allclose(joint_torques(terms, acceleration, (share,)),
                    rnea(robot, terms, acceleration, index, share)[6:], **EXACT)  # fmt: skip


def test_ankle_torques_equal_the_explicit_formula(robot, stance):
    """tau = -(delta_A + AG x m g z_up - M_below) . a + I_rotor q''_joint, sums over links, axes from the file."""
    index, terms, acceleration, share = stance
    foot, side = robot.feet[index], "lr"[index]
    links = evaluate_links(robot, terms.state, acceleration)
    A, g = terms.feet[index].position_ankle_in_world, terms.gravity
    cross, sole = links.names.index(f"{side}_ankle_cross"), links.names.index(f"{side}_foot")
    whole = contact_moment_from_links(A, links, list(range(len(links.names))), g)

    # the sagittal axis is y of the cross, which hangs below it with the foot; the frontal one is x of the foot
    a_sagittal = links.rotation_link_to_world[cross][:, 1]
    a_frontal = links.rotation_link_to_world[sole][:, 0] * (1.0 if side == "l" else -1.0)
    rotors = {j.dof: j.rotor_inertia_kgm2 for j in robot.joints}
    expected = []
    for axis, below, dof in ((a_sagittal, [cross, sole], foot.sagittal), (a_frontal, [sole], foot.frontal)):
        M_below = contact_moment_from_links(A, links, below, g)
        expected.append(-(whole - M_below) @ axis + rotors[dof] * acceleration[dof])
    assert_allclose(torques_point_at_ankle(foot, terms, share, acceleration), expected, **EXACT)
    assert rotors[foot.sagittal] == 0.573
    assert rotors[foot.frontal] == 0.2327


def level_foot(robot, dynamics, random_state, seed: int, index: int) -> RobotState:
    """A random posture whose stance foot is level, points forward, and has its frontal ankle joint at zero."""
    q = random_state(seed).q.copy()
    foot = robot.feet[index]
    q[foot.frontal + 1] = 0.0
    q[:7] = dynamics.neutral(np.zeros(3))[:7]
    terms = dynamics.evaluate(RobotState(q, np.zeros(21)))
    q[3:7] = pin.Quaternion(terms.feet[index].rotation_foot_to_world.T).coeffs()
    return RobotState(q, random_state(seed).v)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("support", [Support.LEFT, Support.RIGHT])
def test_bracket_turns_point_on_ground_into_the_term_at_the_ankle(
    robot, dynamics, random_state, on_its_feet, support, seed
):
    """Level foot: F_N zeta + h F equals minus the ground's moment about the ankle along +y, and +x left or -x right."""
    index = support.reference_foot
    terms = dynamics.evaluate(level_foot(robot, dynamics, random_state, seed, index))
    assert_allclose(terms.feet[index].rotation_foot_to_world, np.eye(3), rtol=0, atol=1e-12)
    acceleration = np.random.default_rng(8000 + seed).normal(scale=3.0, size=21)
    (share,) = shares_of(terms, acceleration, support, on_its_feet)
    moment, foot = share.moment_about_ankle, robot.feet[index]
    with_bracket = torques_point_on_ground(foot, terms, share, tangential_term=True)
    assert_allclose(with_bracket, [-moment[1], -moment[0] if support is Support.LEFT else moment[0]], **EXACT)
    printed = torques_point_on_ground(foot, terms, share, tangential_term=False)
    dropped = foot.ankle_height_m * share.force[:2] * (1.0, -1.0 if support is Support.LEFT else 1.0)
    assert_allclose(np.subtract(with_bracket, printed), dropped, **EXACT)
    assert np.abs(dropped).max() > 1e-3


@pytest.mark.parametrize("support", [Support.LEFT, Support.RIGHT])
def test_signs_of_the_ankle_torques(robot, standing, on_its_feet, support):
    """To move the ZMP forward the ankle pushes the toes down (+); to the left, it rolls the foot's left edge down."""
    foot, left = robot.feet[support.reference_foot], support is Support.LEFT
    terms = standing(support)
    torques = {}
    for name, com_acceleration in {"rest": (0, 0, 0), "back": (-1, 0, 0), "right": (0, -1, 0)}.items():
        rows = np.r_[com_acceleration, np.zeros(18)]
        acceleration = np.linalg.solve(terms.output_jacobian, rows)
        (share,) = shares_of(terms, acceleration, support, on_its_feet)
        torques[name] = np.array(torques_point_at_ankle(foot, terms, share, acceleration))
    zmp_forward, zmp_left = torques["back"] - torques["rest"], torques["right"] - torques["rest"]
    assert zmp_forward[0] > 50.0
    assert zmp_left[1] * (-1.0 if left else 1.0) > 50.0
