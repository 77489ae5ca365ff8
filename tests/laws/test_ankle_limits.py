"""Ankles too weak for their soles: which robots have them, and what the two-part law then leaves to the QP."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.control.balance.ankle_law import ankles_hold_sole, beyond_limits
from surefoot.control.registry import controllers
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.bounds import push_bound
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.resources import resource_folder
from surefoot.robot.description import BASE_DOFS
from surefoot.robot.feet import Support
from surefoot.robot_import.load import load_robot_file
from surefoot.task.posture import standing_reference

WEAK = {"sagittal": 95.0, "frontal": 90.0}  # N m; Bip's own 250 and 150


@pytest.fixture
def weak_file(tmp_path):
    """Bip with ankles that hold its weight at some 90 mm of the 170 that its soles reach ahead."""
    limits = "".join(f"{side}_ankle_{axis} = {nm}\n" for side in ("left", "right") for axis, nm in WEAK.items())
    file = tmp_path / "robot.toml"
    file.write_text(f'mjcf = "{resource_folder("robot_models")}/bip/bip.xml"\n[torque_limits]\n{limits}')
    return file


def with_limit(robot, dof, limit):
    joints = list(robot.joints)
    joints[dof - BASE_DOFS] = replace(joints[dof - BASE_DOFS], torque_limit_nm=limit)
    return replace(robot, joints=tuple(joints))


@pytest.mark.parametrize("axis", ["sagittal", "frontal"])
def test_an_ankle_holds_its_sole_where_the_weight_at_any_corner_is_within_its_torque(robot, standing, axis):
    """Against J^T of the weight at every corner of the standing foot; Bip's axes are tilted by a few degrees."""
    terms, foot = standing(Support.LEFT), robot.feet[0]
    dof = getattr(foot, axis)
    weight = np.array((0.0, 0.0, terms.mass_kg * terms.gravity))
    column = terms.feet[0].jacobian[:, dof]
    torques = [column[:3] @ weight + column[3:] @ np.cross(corner, weight) for corner in foot.corners_from_ankle]
    most = np.abs(torques).max()
    assert ankles_hold_sole(robot)
    assert ankles_hold_sole(with_limit(robot, dof, 1.02 * most))
    assert not ankles_hold_sole(with_limit(robot, dof, 0.98 * most))


def test_beyond_is_more_than_the_motor_gives_either_way(robot):
    dof = robot.feet[0].sagittal
    limit = float(robot.torque_limits[dof - BASE_DOFS])
    assert not beyond_limits(robot, {dof: limit, robot.feet[1].frontal: 0.0})
    assert beyond_limits(robot, {robot.feet[1].frontal: 0.0, dof: -1.001 * limit})


def pushed(weak_file, share, setting):
    """Summary of a run: pushed ahead to the left on two feet by a share of J_cap."""
    push = {"direction_deg": 45.0, "impulse_ns": 1.0, "start_s": 0.2, "duration_s": 0.1}
    table = {
        "robot": str(weak_file),
        "support": "double",
        "duration_s": 2.5,
        "pushes": [push],
        "controller": {"ankle_limits": setting},
    }
    push["impulse_ns"] = share * push_bound(scenario_from_table(table, robot_files=True)).impulse_ns
    return run(scenario_from_table(table, robot_files=True), "two-part").summary


def test_weak_ankles_are_saved_by_the_qp_that_knows_their_limits(weak_file):
    """By itself, as auto has it for such a robot; the law alone asks one foot for what it cannot give."""
    assert not ankles_hold_sole(load_robot_file(weak_file))
    assert pushed(weak_file, 0.8, "law")["fell"]
    assert not pushed(weak_file, 0.8, "auto")["fell"]


def test_where_the_law_stays_within_the_limits_nothing_differs(weak_file):
    law, qp = (pushed(weak_file, 0.1, setting) for setting in ("law", "qp"))
    assert law["com_error_max_m"] == qp["com_error_max_m"] > 0.0
    assert law["com_error_final_m"] == qp["com_error_final_m"]


def test_torques_of_a_tick_beyond_the_limits_are_within_them(robot, standing, on_its_feet):
    """One tick of a robot that moves ahead to the left: the law is beyond a weak ankle, the QP's torques are not."""
    weak = robot
    for foot in robot.feet:
        weak = with_limit(weak, foot.sagittal, WEAK["sagittal"])
    velocity = np.zeros(21)
    velocity[:2] = 0.4, 0.3  # base, ahead to the left [m/s]
    terms = standing(Support.DOUBLE, velocity)
    reference = standing_reference(robot, Support.DOUBLE)
    sensing = on_its_feet(terms, Support.DOUBLE)[1]
    entry = controllers()["two-part"]
    law, qp = (
        entry.make(weak, entry.settings({"ankle_limits": name})).tick(terms, reference, sensing).torques
        for name in ("law", "auto")
    )
    assert (np.abs(law) > weak.torque_limits).any()
    assert (np.abs(qp) <= weak.torque_limits * (1.0 + 1e-9)).all()
