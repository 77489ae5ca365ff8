"""robot.toml: what it may say, one clear error for what it may not, and one that is written to start from."""

import tomllib

import pytest

from surefoot.errors import InvalidInput
from surefoot.robot_import.inspection import inspect_robot
from surefoot.robot_import.report import report
from surefoot.robot_import.robot_file_text import robot_file_text
from tests.support.small_biped import LEG, biped


@pytest.mark.parametrize(
    ("toml", "parts"),
    [
        ('colour = "red"\n', ["colour", "no such key", "keyframe", "torque_limits"]),
        ("keyframe = 3\n", ["keyframe", "must be a text"]),
        ('keyframe = "sit"\n', ["keyframe", "'sit'", "no such keyframe"]),
        ('trunk = "chest"\n', ["trunk", "'chest'", "no such body", "pelvis", "trunk"]),
        ('frozen = "waist"\n', ["frozen", "must be a list of joint names"]),
        ('frozen = ["neck"]\n', ["frozen", "'neck'", "no such joint", "waist"]),
        ('[posture]\nleft_knee = "bent"\n', ["posture.left_knee", "must be a number"]),
        ("[posture]\nknee = 1\n", ["posture.knee", "no such joint", "left_knee"]),
        ("[torque_limits]\nwaist = -3\n", ["torque_limits.waist", "more than 0 N m"]),
        ("[torque_limits]\nneck = 3\n", ["torque_limits.neck", "no such joint", "waist"]),
        ('[base]\nforward = "w"\n', ["base.forward", "an axis of the base's frame", "x, -x, y, -y, z, -z"]),
        ('[base]\nforward = "-z"\n', ["base.up", "'z'", "another axis than forward"]),
        ('[base]\nleft = "y"\n', ["base.left", "no such key", "forward, up"]),
        ("[feet.middle]\n", ["feet.middle", "no such key", "left, right"]),
        ("[feet.left]\nsole = 3\n", ["feet.left.sole", "no such key", "body, ankle_joints, corners"]),
        (
            '[feet.left]\nbody = "paw"\n[feet.right]\nbody = "paw"\n',
            ["feet.left.body", "'paw'", "left_ankle_roll_link"],
        ),
        ('[feet.left]\nankle_joints = ["left_knee"]\n', ["feet.left.ankle_joints", "two joints"]),
        ('[feet.left]\nankle_joints = ["waist", "left_knee"]\n', ["feet.left.ankle_joints", "no joint of that leg"]),
        ("[feet.left]\ncorners = [[0, 0], [1, 0], [0, 1]]\n", ["feet.left.corners", "[x, y, z]"]),
    ],
)
def test_what_is_not_understood_is_refused_with_what_would_be(inspect, toml, parts):
    with pytest.raises(InvalidInput) as error:
        inspect(biped(), toml)
    assert all(part in str(error.value) for part in parts), error.value


def test_a_file_without_its_mjcf_and_one_that_is_no_mjcf_are_told(tmp_path):
    file = tmp_path / "robot.toml"
    file.write_text('trunk = "trunk"\n')
    with pytest.raises(InvalidInput, match="which MJCF"):
        inspect_robot(file)
    file.write_text('mjcf = "gone.xml"\n')
    with pytest.raises(InvalidInput, match="no such file"):
        inspect_robot(file)
    (tmp_path / "gone.xml").write_text("<mujoco><nonsense/></mujoco>")
    with pytest.raises(InvalidInput, match="no MJCF that MuJoCo reads"):
        inspect_robot(file)


@pytest.mark.parametrize(
    "mjcf", [biped(), biped(motor=""), biped(leg=LEG[:5]), biped(extra="<keyframe><key/></keyframe>")]
)
def test_the_file_to_start_from_gives_what_was_found_without_it(inspect, tmp_path, mjcf):
    inspection = inspect(mjcf)
    out = tmp_path / "sub" / "robot.toml"
    out.parent.mkdir()
    out.write_text(robot_file_text(inspection, out))
    before, after = report(inspection), report(inspect_robot(out))
    for key in ("fit", "problems", "joints", "legs", "upper_joints"):
        assert after[key] == before[key] or key in ("joints", "problems")
    postures = [[round(joint.pop("posture_rad"), 5) for joint in table["joints"]] for table in (before, after)]
    assert postures[0] == postures[1]
    assert after["joints"] == before["joints"]
    assert [problem["topic"] for problem in after["problems"]] == [problem["topic"] for problem in before["problems"]]


def written_posture(inspection, out):
    return tomllib.loads(robot_file_text(inspection, out)).get("posture", {})


def test_the_file_to_start_from_says_the_angles_that_differ_and_those_once_said(inspect, tmp_path):
    """Bent knees, where the MJCF draws them straight; an arm that is not said stays free to lean with."""
    out = tmp_path / "new.toml"
    bent = {f"{side}_{joint}" for side in ("left", "right") for joint in ("hip_pitch", "knee", "ankle_pitch")}
    assert set(written_posture(inspect(biped()), out)) == bent
    key = f'<keyframe><key name="home" qpos="0 0 1 1 0 0 0 {"0 0 -.3 .6 -.3 0 " * 2} 0 0"/></keyframe>'
    assert written_posture(inspect(biped(extra=key)), out) == {}
    said = {"shoulder": 0.0, "left_knee": 0.5, "right_knee": 0.5}
    lines = "".join(f"{name} = {angle}\n" for name, angle in said.items())
    assert written_posture(inspect(biped(), "[posture]\n" + lines), out).items() >= said.items()


def test_damping_that_is_taken_out_is_not_in_the_table_of_joints(inspect):
    servo = '<position name="{joint}" joint="{joint}" kp="100" forcerange="-60 60"/>'
    for motor, damping in ((servo, 0.0), ('<motor name="{joint}" joint="{joint}" ctrlrange="-60 60"/>', 0.7)):
        table = report(inspect(biped(motor=motor, joint='range="-1.5 1.5" damping="0.7"')))
        assert {joint["damping_nms"] for joint in table["joints"] if "knee" in joint["name"]} == {damping}
