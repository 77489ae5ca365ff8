"""A base with another frame than x forward, z up is the same robot as one with it."""

import numpy as np
import pytest

from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot_import.base_frame import AXIS_NAMES, BaseAxes
from surefoot.robot_import.report import report
from tests.support.several_hinges import Y_UP, several_hinges

TOML = '[base]\nforward = "z"\nup = "y"\n'


def test_it_is_the_robot_that_lies_as_it_should(inspect):
    turned, upright = report(inspect(several_hinges(base=Y_UP), TOML)), report(inspect(several_hinges()))
    assert turned["fit"], turned["problems"]
    for side in ("left", "right"):
        one, other = (table["feet"][side]["sole"]["corners_m"] for table in (turned, upright))
        assert np.allclose(one, other, rtol=0.0, atol=1e-9)
    for one, other in zip(turned["statics"], upright["statics"], strict=True):
        assert one["torque"]["percent"] == pytest.approx(other["torque"]["percent"], abs=1e-6)
        assert one["condition_of_h"] == pytest.approx(other["condition_of_h"], rel=1e-6)
    assert any("z was forward and y up" in line for line in turned["changed"])


def test_a_run_is_the_same_to_rounding(tmp_path):
    push = [{"start_s": 0.05, "direction_deg": 0.0, "impulse_ns": 1.0, "duration_s": 0.05}]
    tables = []
    for name, base, toml in (("upright", "", ""), ("turned", Y_UP, TOML)):
        (tmp_path / f"{name}.xml").write_text(several_hinges(base=base) if base else several_hinges())
        (tmp_path / f"{name}.toml").write_text(f'mjcf = "{name}.xml"\n{toml}')
        over = {"duration_s": 0.15, "pushes": push, "robot": str(tmp_path / f"{name}.toml")}
        result = run(load_scenario("stand_left", over, robot_files=True), "two-part")
        assert not result.summary["fell"]
        tables.append(np.array([result.recorder.column(f"com_{axis}_m") for axis in "xyz"]))
    assert np.ptp(tables[0][0]) > 1e-3  # the push was felt, ahead
    assert np.allclose(tables[0], tables[1], rtol=0.0, atol=1e-9)


def test_without_being_told_it_is_refused_with_how_to_tell_it(inspect):
    problems = report(inspect(several_hinges(base=Y_UP)))["problems"]
    assert any("[base] forward" in problem["remedy"] for problem in problems), problems


def test_a_keyframe_that_stands_upright_still_does(inspect):
    """There the base of the file is turned, so that its y points up."""
    joints = " ".join(["0"] * 16)
    key = f'<keyframe><key name="home" qpos="0 0 0.7 0.5 0.5 0.5 0.5 {joints}"/></keyframe>'
    robot = inspect(several_hinges(base=Y_UP, extra=key), TOML).robot
    assert robot.keyframe == "home"
    assert np.allclose(robot.tree.rotation(robot.tree.base), np.eye(3), atol=1e-15)


@pytest.mark.parametrize("forward", AXIS_NAMES)
def test_the_turned_frame_is_right_handed(forward):
    """x along what is forward, z along what is up; the scalar part is not negative or zero by half turns only."""
    up = "z" if forward[-1] != "z" else "-x"
    w, *vector = BaseAxes(forward, up).quaternion
    turn = (2.0 * w * w - 1.0) * np.eye(3) + 2.0 * np.outer(vector, vector)
    turn += (
        2.0 * w * np.array(((0.0, -vector[2], vector[1]), (vector[2], 0.0, -vector[0]), (-vector[1], vector[0], 0.0)))
    )
    axes = {sign + name: (-1.0 if sign else 1.0) * np.eye(3)[i] for i, name in enumerate("xyz") for sign in ("", "-")}
    assert np.allclose(turn[:, 0], axes[forward], atol=1e-15)
    assert np.allclose(turn[:, 2], axes[up], atol=1e-15)
    assert np.linalg.det(turn) == pytest.approx(1.0)


def test_a_base_that_hangs_on_slides_and_hinges_gets_a_free_joint(inspect):
    """As planar walkers and converted skeletons have it; the base stands where a keyframe has put it."""
    axes = ("1 0 0", "0 1 0", "0 0 1")
    root = "".join(f'<joint name="t{i}" type="slide" axis="{axis}"/>' for i, axis in enumerate(axes))
    root += "".join(f'<joint name="r{i}" axis="{axis}"/>' for i, axis in enumerate(axes))
    joints = " ".join(["0"] * 16)
    key = f'<keyframe><key name="home" qpos="0.1 0.2 0.3 0 0 0.5 {joints}"/></keyframe>'
    mjcf = several_hinges(extra=key).replace('<freejoint name="root"/>', root)
    table, upright = report(inspect(mjcf)), report(inspect(several_hinges()))
    assert table["fit"], table["problems"]
    assert table["joint_count"] == 16
    assert "the base pelvis hung on the world by t0, t1, t2, r0, r1, r2: given a free joint" in table["changed"]
    assert [one["torque"]["percent"] for one in table["statics"]] == pytest.approx(
        [one["torque"]["percent"] for one in upright["statics"]], abs=1e-6
    )
    robot = inspect(mjcf).robot
    assert np.allclose(robot.posture.qpos[:7], (0.1, 0.2, 1.0, np.cos(0.25), 0.0, 0.0, np.sin(0.25)))
