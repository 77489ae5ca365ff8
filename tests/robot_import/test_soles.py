"""Soles: from shapes, in the plane that they stand on, whichever way the foot's frame and the posture are turned."""

import numpy as np
import pytest

from tests.support.small_biped import BOX_SOLE, LEG, SPHERE_SOLE, biped

BALLS_UNEQUAL = SPHERE_SOLE.replace('size="0.005" pos="0.12', 'size="0.008" pos="0.12')
CAPSULES = "".join(
    f'<geom type="capsule" size="0.01" fromto="-0.05 {y} -0.04 0.11 {y} -0.04" group="3"/>' for y in (-0.03, 0.03)
)


def sole_of(inspection, side=0):
    assert not inspection.problems, inspection.problems
    return inspection.robot.soles[side]


@pytest.mark.parametrize(
    ("shapes", "length", "width", "height"),
    [(BOX_SOLE, 0.18, 0.07, 0.05), (SPHERE_SOLE, 0.18, 0.07, 0.05), (CAPSULES, 0.16, 0.06, 0.05)],
)
def test_the_hull_of_the_lowest_points(inspect, shapes, length, width, height):
    sole = sole_of(inspect(biped(sole=shapes)))
    assert (sole.length_m, sole.width_m, sole.ankle_height_m) == pytest.approx((length, width, height), abs=1e-6)
    assert sole.rotation_in_body == pytest.approx(np.eye(3), abs=1e-9)


def test_the_plane_is_that_of_the_facet_and_not_of_the_posture(inspect):
    """The foot is tilted by 0.2 rad in the posture: the sole is the same, and says so."""
    level, tilted = (
        sole_of(inspect(biped(), f"[posture]\nleft_hip_pitch = {angle}\nright_hip_pitch = {angle}\n"))
        for angle in (0.0, 0.2)
    )
    assert tilted.tilt_deg == pytest.approx(np.degrees(0.2))
    assert tilted.outline.vertices == pytest.approx(level.outline.vertices, abs=1e-9)
    assert tilted.rotation_in_body == pytest.approx(level.rotation_in_body, abs=1e-9)


def test_balls_of_two_sizes_touch_a_plane_that_leans(inspect):
    """By the difference of radii over the distance of the centres: tan = (8 - 5 mm) / 180 mm, sin for tangents."""
    sole = sole_of(inspect(biped(sole=BALLS_UNEQUAL)))
    assert np.sin(np.radians(sole.tilt_deg)) == pytest.approx(0.003 / 0.18, rel=1e-6)


def test_a_foot_whose_frame_is_turned_has_the_same_sole(inspect):
    """The last body's frame turned by a quarter about x, as in files made from CAD: z no longer points up."""
    turned = list(LEG)
    name, _, offset, mass = turned[-1]
    turned[-1] = (name, "1 0 0", offset + '" euler="1.5707963267948966 0 0', mass)
    shape = '<geom type="box" size="0.09 0.01 0.035" pos="0.03 -0.04 0" group="3"/>'
    sole = sole_of(inspect(biped(leg=turned, sole=shape)))
    assert (sole.length_m, sole.width_m, sole.ankle_height_m) == pytest.approx((0.18, 0.07, 0.05), abs=1e-9)
    assert sole.rotation_in_body.T @ (0.0, 1.0, 0.0) == pytest.approx((0.0, 0.0, 1.0), abs=1e-9)


def test_roll_before_pitch_gives_the_same_foot_frame(inspect):
    """The ankle's centre moves to the lower axis; heights count from there."""
    legs = [*LEG[:4], ("ankle_roll", *LEG[4][1:]), ("ankle_pitch", *LEG[5][1:])]
    legs[4], legs[5] = (legs[4][0], "1 0 0", *legs[4][2:]), (legs[5][0], "0 -1 0", *legs[5][2:])
    inspection = inspect(biped(leg=legs))
    sole = sole_of(inspection)
    robot = inspection.robot
    assert robot.tree.joint_name(robot.ankles[0].pitch) == "left_ankle_pitch"
    assert robot.ankles[0].lower == robot.ankles[0].pitch
    assert sole.rotation_in_body == pytest.approx(np.eye(3), abs=1e-9)
    assert sole.ankle_in_body == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert sole.ankle_height_m == pytest.approx(0.05)


def test_corners_in_robot_toml_come_first(inspect):
    corners = "[[-0.05, -0.03, -0.05], [0.1, -0.03, -0.05], [0.1, 0.03, -0.05], [-0.05, 0.03, -0.05]]"
    sole = sole_of(inspect(biped(), f"[feet.left]\ncorners = {corners}\n"))
    assert (sole.length_m, sole.width_m) == pytest.approx((0.15, 0.06))
    assert sole.how == "corners in robot.toml"


def test_a_round_sole_gets_few_corners_and_says_what_it_lost(inspect):
    sole = sole_of(inspect(biped(sole='<geom type="cylinder" size="0.06 0.01" pos="0.02 0 -0.04" group="3"/>')))
    assert len(sole.outline.vertices) == 12
    regular = 0.5 * 12 * np.sin(2.0 * np.pi / 12) / (0.5 * 32 * np.sin(2.0 * np.pi / 32))
    assert 0.0 < sole.area_lost < 1.5 * (1.0 - regular)
