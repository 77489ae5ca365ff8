"""How far an ankle's motors hold the weight: against a lever by hand, and the same for the law and for the report."""

import numpy as np
import pytest

from surefoot.control.balance.ankle_law import ankles_hold_sole
from surefoot.resources import resource_folder
from surefoot.robot.weight_reach import WeightReach, weight_reach
from surefoot.robot_import.inspection import inspect_robot
from surefoot.robot_import.load import load_robot_file
from surefoot.robot_import.report import report

SOLE = np.array(((-0.12, -0.06), (0.17, -0.09), (0.17, 0.09), (-0.12, 0.06)))


def test_the_longer_half_of_the_sole_is_the_lever_of_each_joint():
    pitch, roll = weight_reach((100.0, 100.0), 1000.0, SOLE)
    assert (pitch, roll) == (WeightReach(0.1, 0.17), WeightReach(0.1, 0.09))
    assert not pitch.holds_sole and roll.holds_sole
    assert all(reach.holds_sole for reach in weight_reach((170.0, 90.0), 1000.0, SOLE))


def test_without_a_limit_all_is_held_and_without_a_sole_there_is_no_lever():
    assert all(reach.holds_sole for reach in weight_reach((None, 90.0), 1000.0, SOLE))
    assert weight_reach((1.0, None), 1000.0, np.zeros((0, 2))) == (WeightReach(0.001, 0.0), WeightReach(None, 0.0))


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_the_law_and_the_report_of_a_file_say_the_same(tmp_path, robot, share):
    """Bip, one roll joint given a little more or less than its sole asks for."""
    enough_nm = robot.mass_kg * robot.gravity * np.abs(robot.feet[1].sole.vertices[:, 1]).max()
    file = tmp_path / "robot.toml"
    file.write_text(
        f'mjcf = "{resource_folder("robot_models")}/bip/bip.xml"\n'
        f"[torque_limits]\nright_ankle_frontal = {share * enough_nm}\n"
    )
    right = report(inspect_robot(file))["feet"]["right"]["ankle"]
    assert right["holds_sole"] == {"pitch": True, "roll": share > 1.0}
    assert right["holds_weight_at_m"]["roll"] == pytest.approx(share * right["sole_edge_at_m"]["roll"])
    assert ankles_hold_sole(load_robot_file(file)) is (share > 1.0)
