"""Standing still: torques by the statics against MuJoCo's simulation standing on its soles, and against a lever."""

import mujoco
import numpy as np
import pytest
from rich.console import Console

from surefoot.cli.robot_tables import print_report
from surefoot.robot_import.report import report
from surefoot.robot_import.statics import Load, Statics, _torques, at_limit, stand
from surefoot.robot_import.task_jacobian import TaskKinematics
from tests.support.small_biped import biped


@pytest.fixture
def robot(inspect):
    return inspect(biped(), "[posture]\nleft_knee = 0.5\nright_knee = 0.5\n").robot


def kinematics_of(robot) -> TaskKinematics:
    return TaskKinematics(robot.tree, (robot.feet[0].body, robot.feet[1].body), robot.soles, robot.legs)


def test_the_postures_have_the_com_over_the_soles_and_the_soles_level(robot):
    kinematics = kinematics_of(robot)
    both, left, right = stand(robot)
    for statics, stance in ((both, (0, 1)), (left, (0,)), (right, (1,))):
        kinematics.move(statics.qpos)
        feet = kinematics.feet()
        for index in stance:
            assert feet[index].rotation[2] == pytest.approx((0.0, 0.0, 1.0), abs=1e-7)
        middle = np.mean([feet[i].ankle for i in stance], axis=0)
        assert kinematics.com()[1] == pytest.approx(middle[1], abs=1e-7)
        assert -0.06 < kinematics.com()[0] - middle[0] < 0.12
    assert kinematics.feet()[0].ankle[2] > kinematics.feet()[1].ankle[2] + 0.01


def test_h_is_square_and_turns_velocities_into_those_of_kappa(robot):
    """Against differences of CoM and feet over a small step."""
    kinematics = kinematics_of(robot)
    start = robot.posture.qpos
    kinematics.move(start)
    jacobian = kinematics.jacobian()
    assert jacobian.shape == (robot.model.nv, robot.model.nv)
    step = np.random.default_rng(5).normal(size=robot.model.nv)
    ends = []
    for sign in (-1.0, 1.0):
        qpos = start.copy()
        mujoco.mj_integratePos(robot.model, qpos, step, sign * 1e-6)
        kinematics.move(qpos)
        feet = kinematics.feet()
        ends.append(np.concatenate((kinematics.com(), feet[0].ankle, feet[1].ankle, kinematics.upper_angles())))
    slope = (ends[1] - ends[0]) / 2e-6
    rows = [*range(3), *range(6, 9), *range(12, 15), *range(18, robot.model.nv)]
    assert slope == pytest.approx((jacobian @ step)[rows], abs=1e-6)


def test_on_one_foot_the_hip_carries_what_hangs_on_it(robot):
    """The left hip's roll torque is the moment about its axis of all weight but its own leg's: a lever, by hand."""
    _, left, _ = stand(robot)
    kinematics = kinematics_of(robot)
    kinematics.move(left.qpos)
    tree, data = kinematics._tree, kinematics.data
    hip = tree.model.joint("left_hip_roll").id
    names = ("hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll")
    below = {tree.model.body(f"left_{name}_link").id for name in names}
    moment = np.zeros(3)
    for body in range(1, tree.model.nbody):
        if body not in below:
            weight = np.array((0.0, 0.0, -9.81 * tree.model.body_mass[body]))
            moment += np.cross(data.xipos[body] - tree.anchor(hip), weight)
    limits = {name: limit.torque_nm for name, limit in robot.drives.limits.items()}
    torques = _torques(kinematics, (0,), robot.soles, limits)
    # the motor turns the leg against the rest of the body: what it does to the rest balances the rest's weight
    assert torques["left_hip_roll"] == pytest.approx(float(moment @ tree.axis(hip)), rel=1e-6)


def test_on_two_feet_the_worst_share_is_the_least_there_is(robot):
    """No random inner force between the feet does better than the linear program."""
    kinematics = kinematics_of(robot)
    both = stand(robot)[0]
    kinematics.move(both.qpos)
    limits = {name: limit.torque_nm for name, limit in robot.drives.limits.items()}
    torques = _torques(kinematics, (0, 1), robot.soles, limits)
    gravity = kinematics.data.qfrc_bias[6:]
    ground = gravity - np.array(list(torques.values()))
    feet = np.vstack([kinematics.foot_jacobian(index) for index in (0, 1)])
    wrench = np.linalg.lstsq(feet.T, np.concatenate((kinematics.data.qfrc_bias[:6], ground)), rcond=None)[0]
    assert feet[:, :6].T @ wrench == pytest.approx(kinematics.data.qfrc_bias[:6], abs=1e-8)
    assert wrench[2] + wrench[8] == pytest.approx(9.81 * float(robot.model.body_mass.sum()))
    limit = np.array([limits[name] for name in torques])
    best = both.torque.percent / 100.0
    inner = np.linalg.svd(feet[:, :6].T)[2][6:]
    random = np.random.default_rng(7)
    for _ in range(200):
        other = gravity - feet[:, 6:].T @ (wrench + inner.T @ random.normal(scale=3.0, size=len(inner)))
        assert (np.abs(other) / limit).max() > best - 1e-9


@pytest.mark.parametrize(("share", "said"), [(0.97, ["left_hip_roll"]), (0.9, [])])
def test_who_has_next_to_nothing_left_on_one_foot_is_fit_and_told(inspect, capsys, share, said):
    """Its hip is given as much as makes what it has to hold 97 % of that."""
    bent = "[posture]\nleft_knee = 0.5\nright_knee = 0.5\n"
    needs = {one["support"]: one["torque"] for one in report(inspect(biped(), bent))["statics"]}["left foot"]
    assert needs["joint"] == "left_hip_roll"
    table = report(inspect(biped(), f"{bent}[torque_limits]\nleft_hip_roll = {abs(needs['nm']) / share}\n"))
    assert table["fit"] and [one["joint"] for one in table["at_limit"]] == said
    print_report(table, Console(width=200))
    last = capsys.readouterr().out.splitlines()[-1]
    at = "fit, but at its limit on one foot: left_hip_roll at 97 % of its torque limit (left foot)"
    assert last == (at if said else "fit: nothing is in the way")


def test_who_stands_at_the_end_of_a_range_on_one_foot_is_told_which():
    at_the_end = Load("right_ankle_roll", 99.0, 0.3)
    easy = Load("right_knee", 40.0, 20.0)
    found = [
        Statics("two feet", True, torque=Load("left_knee", 98.0, 50.0), range=at_the_end),
        Statics("left foot", True, torque=easy, range=Load("left_ankle_roll", 94.9, 0.2)),
        Statics("right foot", True, torque=easy, range=at_the_end),
    ]
    (told,) = at_limit(found)
    assert (told.support, told.load, told.of) == ("right foot", at_the_end, "range")


def test_a_robot_too_weak_for_its_weight_is_told_the_joint_and_the_share(inspect):
    table = report(
        inspect(biped(), "[posture]\nleft_knee = 0.5\nright_knee = 0.5\n[torque_limits]\nleft_hip_roll = 2\n")
    )
    problems = [problem["reason"] for problem in table["problems"]]
    assert len(problems) == 1
    assert problems[0].startswith("left foot: left_hip_roll needs")
