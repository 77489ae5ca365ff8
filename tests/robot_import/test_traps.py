"""What foreign MJCF files do, each in one small file: it is made fit, or refused with the reason and the remedy."""

import mujoco
import numpy as np
import pytest
from rich.console import Console

from surefoot.cli.robot_tables import print_report
from surefoot.errors import InvalidInput
from surefoot.robot_import.describe import fitted
from surefoot.robot_import.report import report
from tests.support.small_biped import ARM, BOX_SOLE, LEG, SPHERE_SOLE, biped

FINGERS = """
<body name="hand"><inertial pos="0 0 0.3" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
  <frame pos="0.1 0 0" euler="0 0 0.5">
    <replicate count="2" offset="0 0.02 0">
      <body name="finger" pos="0.05 0 0">
        <inertial pos="0.02 0 0" mass="0.05" diaginertia="1e-5 1e-5 1e-5"/><joint name="bend" axis="0 1 0" range="0 1"/>
      </body>
    </replicate>
  </frame>
</body>"""
FINGER_LIMITS = "[torque_limits]\nbend0 = 0.5\nbend1 = 0.5\n"
TOE = """<body name="{side}_toe" pos="0.1 0 -0.03"><inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
  <joint name="{side}_toe" axis="0 1 0" range="-1 1"/><geom type="box" size="0.02 0.03 0.01" group="3"/></body>"""
ROD = '<equality><connect name="rod" body1="left_knee_link" body2="left_ankle_pitch_link" anchor="0 0 0"/></equality>'
GEARED = '<equality><joint name="gear" joint1="waist" joint2="shoulder"/></equality>'
BALL = """<body name="lamp" pos="0 0 0.3"><inertial pos="0 0 0.05" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
  <joint name="globe" type="ball"/></body>"""
TENDON = """<tendon><fixed name="cable"><joint joint="left_knee" coef="1"/><joint joint="left_ankle_pitch" coef="1"/>
  </fixed></tendon><actuator><motor name="pull" tendon="cable"/></actuator>"""
SERVO = '<position name="{joint}" joint="{joint}" kp="50" forcerange="-40 40"/>'


def test_a_plain_robot_is_fit(inspect):
    table = report(inspect(biped()))
    assert table["fit"], table["problems"]
    assert table["trunk"]["body"] == "trunk"
    assert table["upper_joints"] == ["waist", "shoulder"]
    assert [table["feet"][side]["body"] for side in ("left", "right")] == [
        "left_ankle_roll_link",
        "right_ankle_roll_link",
    ]
    assert table["feet"]["left"]["ankle"]["axes_gap_m"] == pytest.approx(0.012)


def test_bodies_that_pinocchio_drops_are_kept(inspect):
    """In MJCF's <frame> and <replicate>: two hinges and 0.1 kg are silently lost by reading the file as it is."""
    inspection = inspect(biped(upper=FINGERS), FINGER_LIMITS)
    robot = inspection.robot
    assert not inspection.problems
    assert robot.model.nv == robot.pinocchio.nv == robot.original.nv
    assert robot.agreement.mass_matrix < 1e-12
    lost = [line for line in robot.plain.changed if "<replicate>" in line]
    assert len(lost) == 1
    assert f"{robot.model.nv - 2} of {robot.model.nv}" in lost[0]


@pytest.mark.parametrize(
    ("mjcf", "topic", "reason", "remedy"),
    [
        (biped(leg=LEG[:5]), "legs", "five-joint legs", "six joints"),
        (biped(after_foot=TOE), "legs", "seven-joint legs", "frozen"),
        (biped(motor=""), "limits", "14 of 14 joints have no torque limit", "[torque_limits]"),
        (biped(sole=""), "feet", "0 chains", "[feet.left] body"),
        (biped(sole='<geom type="sphere" size="0.02" pos="0 0 -0.03" group="3"/>'), "sole", "span no", "corners"),
        (biped(extra=ROD), "loops", "closed loop: equality rod", "serial chain"),
        (biped(extra=GEARED), "loops", "couples the joints waist and shoulder", "frozen"),
        (biped(extra=TENDON), "loops", "cable over left_knee, left_ankle_pitch: a parallel drive", "serial chain"),
        (biped(upper=BALL), "joints", "globe is a ball joint", "frozen"),
        (biped(upper=ARM.replace("<joint", '<joint stiffness="3 1"')), "joints", "is not linear", "stiffness"),
        (biped(motor='<motor joint="{joint}" ctrlrange="-9 9"/>'), "statics", "% of its limit", "[torque_limits]"),
        (biped(leg=(*LEG[:5], ("ankle_yaw", "0 0 1", "0 0 -0.012", 0.7))), "ankles", "do not pitch", "pitch, roll"),
    ],
)
def test_it_is_refused_with_a_reason_and_a_remedy(inspect, mjcf, topic, reason, remedy):
    table = report(inspect(mjcf))
    assert not table["fit"]
    assert any(
        problem["topic"] == topic and reason in problem["reason"] and remedy in problem["remedy"]
        for problem in table["problems"]
    ), table["problems"]


def test_a_coupled_or_foreign_joint_can_be_frozen(inspect):
    assert not inspect(biped(extra=GEARED), 'frozen = ["waist", "shoulder"]\n').problems
    inspection = inspect(biped(after_foot=TOE), 'frozen = ["left_toe", "right_toe"]\n')
    assert report(inspection)["fit"], inspection.problems


def test_servos_become_motors_and_lose_the_damping_that_stood_in_for_their_rate_gain(inspect):
    inspection = inspect(biped(motor=SERVO, joint='range="-1.5 1.5" damping="30"'))
    table = report(inspection)
    assert table["fit"], table["problems"]
    assert {joint["torque_limit_nm"] for joint in table["joints"]} == {40.0}
    assert {joint["limit_source"] for joint in table["joints"]} == {"actuator forcerange"}
    assert "14 position or speed actuators became torque motors" in table["changed"]
    model = mujoco.MjModel.from_xml_string(fitted(inspection.robot).text())
    assert not model.dof_damping.any()
    data = mujoco.MjData(model)
    data.ctrl[:] = 7.0
    mujoco.mj_forward(model, data)
    assert np.allclose(data.qfrc_actuator[6:], 7.0)


def test_friction_that_no_controller_knows_is_said(inspect):
    notes = report(inspect(biped(joint='range="-1.5 1.5" frictionloss="6" damping="0.5"')))["notes"]
    assert notes[0].startswith("dry friction in 12 joints, up to 6 N m (left_hip_yaw, 10 % of its limit)")
    assert notes[1].startswith("damping in 12 joints, up to 0.5 N m s/rad")


def test_spheres_become_one_sole_that_touches_the_ground(inspect):
    inspection = inspect(biped(sole=SPHERE_SOLE))
    model = mujoco.MjModel.from_xml_string(fitted(inspection.robot).text())
    foot = model.body("left_ankle_roll_link")
    geoms = [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == foot.id and model.geom_contype[geom]]
    assert [model.geom(geom).name for geom in geoms] == ["left_sole"]
    assert (model.geom_contype[geoms[0]], model.geom_conaffinity[geoms[0]]) == (1, 2)
    assert report(inspection)["feet"]["left"]["sole"]["length_m"] == pytest.approx(0.18)


def test_a_sole_that_only_a_pair_switches_on_counts(inspect):
    table = report(inspect(biped(sole=BOX_SOLE.replace("<geom", '<geom contype="0" conaffinity="0"'))))
    assert table["fit"], table["problems"]
    assert "contype 0" in table["feet"]["left"]["sole"]["how"]


def test_a_base_that_is_fixed_to_the_world_is_freed(inspect):
    table = report(inspect(biped(free="")))
    assert table["fit"], table["problems"]
    assert any("fixed to the world" in line for line in table["changed"])


def test_a_joint_without_a_range_is_said(inspect):
    table = report(inspect(biped(joint='armature="0.01"')))
    assert table["fit"]
    assert any(line.startswith("joints without a range") and "left_knee" in line for line in table["changed"])


def test_limits_come_from_the_file_the_joint_or_the_actuator_and_it_is_said_from_which(inspect):
    joint = 'range="-1.5 1.5" actuatorfrcrange="-30 20"'
    table = report(inspect(biped(joint=joint), "[torque_limits]\nleft_knee = 25\n"))
    limits = {row["name"]: (row["torque_limit_nm"], row["limit_source"]) for row in table["joints"]}
    assert limits["left_knee"] == (25.0, "robot.toml")
    assert limits["right_knee"] == (20.0, "joint actuatorfrcrange")
    assert limits["waist"] == (60.0, "motor ctrlrange")
    assert any("differ by direction" in line and "right_knee" in line for line in table["changed"])


def test_another_tree_and_the_world_are_left_out(inspect):
    ball = '<body name="ball" pos="1 0 0.1"><freejoint/><geom type="sphere" size="0.1"/></body>'
    mjcf = biped().replace("</worldbody>", f'{ball}<geom type="plane" size="1 1 1"/></worldbody>')
    table = report(inspect(mjcf))
    assert table["fit"], table["problems"]
    assert table["base"]["body"] == "pelvis"
    assert "bodies beside the robot: 1" in table["dropped"]


def test_a_knee_that_is_bent_the_wrong_way_is_told_as_that(inspect):
    """Nobody is sent to look for a sole because an angle has the wrong sign."""
    with pytest.raises(InvalidInput, match=r"posture.left_knee.*outside the joint's range.*-0.1 to 2 rad"):
        inspect(biped(joint='range="-0.1 2"'), "[posture]\nleft_knee = -0.5\n")


def test_an_ankle_that_cannot_hold_its_sole_says_how_far_it_can(inspect, capsys):
    """Its limit over the robot's weight, against a lever of that length by hand."""
    inspection = inspect(biped(), "[torque_limits]\nleft_ankle_pitch = 4.0\n")
    table = report(inspection)
    reach = table["feet"]["left"]["ankle"]["holds_weight_at_m"]
    assert reach["pitch"] * 9.81 * table["mass_kg"] == pytest.approx(4.0)
    print_report(table, Console(width=400))
    said = [line for line in capsys.readouterr().out.splitlines() if "whole weight" in line]
    assert len(said) == 1 and "left ankle" in said[0] and f"{1e3 * reach['pitch']:.0f} of " in said[0]
