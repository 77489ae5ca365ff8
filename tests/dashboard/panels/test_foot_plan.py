"""The close-up of the feet: forward is up, left is left, and what lies beyond the picture is pointed at."""

import re
from dataclasses import replace

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages.commands import PlaceStone
from surefoot.dashboard.messages.shown_robot import shown_robot
from surefoot.dashboard.panels.balance.foot_plan import HEIGHT, WIDTH, foot_plan, nearest_on_outline, plan_of
from surefoot.dashboard.ui import palette
from surefoot.dashboard.ui.symbols import BY_KEY, mark
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import load_robot

ROBOT = shown_robot("bip", load_robot("bip"))


@pytest.fixture(scope="module")
def standing():
    playback = Playback("stand_left", "two-part")
    for _ in range(100):
        playback.tick()
    return playback.live.observer.geometry()


def test_forward_is_up_and_left_is_left(standing):
    plan, P = plan_of(standing, "left", ROBOT), standing.support_origin[:2]
    x, y = plan.point(P)
    assert plan.point(P + (0.05, 0.0)) == pytest.approx((x, y - 0.05 * plan.scale))
    assert plan.point(P + (0.0, 0.05)) == pytest.approx((x - 0.05 * plan.scale, y))


@pytest.mark.parametrize("scenario", ["stand_left", "stand_double"])
def test_the_support_polygon_is_drawn_whole_and_to_scale(scenario):
    playback = Playback(scenario, "two-part")
    playback.tick()
    geometry, support = playback.live.observer.geometry(), str(playback.live.scenario.support)
    drawn = plan_of(geometry, support, ROBOT).points(geometry.support_polygon)
    assert (drawn > 0.0).all() and (drawn < (WIDTH, HEIGHT)).all()
    svg = foot_plan(geometry, support, ROBOT, 0.05)
    points = re.search(r'<polygon points="([^"]+)" fill="[^"]+" fill-opacity="0.28"', svg)[1]
    corners = np.array([[float(number) for number in pair.split(",")] for pair in points.split()])
    np.testing.assert_allclose(corners, drawn, atol=0.06)
    length = float(re.search(r"v4h([\d.]+)v-4", svg)[1])  # the scale bar says 50 mm
    assert length == pytest.approx(0.05 * plan_of(geometry, support, ROBOT).scale, abs=0.06)
    assert "50 mm" in svg


def test_every_point_has_its_sign_at_its_place(standing):
    svg, plan = foot_plan(standing, "left", ROBOT, 0.05), plan_of(standing, "left", ROBOT)
    for key, place in (("zmp", standing.zmp_measured), ("command", standing.zmp_commanded),
                       ("com", standing.com[:2]), ("capture", standing.capture)):  # fmt: skip
        assert mark(BY_KEY[key], *plan.point(place).tolist()) in svg


def test_a_point_beyond_the_picture_becomes_an_arrowhead_at_its_border(standing):
    far = replace(standing, capture=standing.com[:2] + (0.0, 1.0))  # a metre to the left
    arrow = re.search(r'M8 0L-5 6L-5 -6Z" fill="([^"]+)" transform="translate\(([\d.]+) ([\d.]+)\) rotate\((-?\d+)\)',
                      foot_plan(far, "left", ROBOT, 0.05))  # fmt: skip
    assert arrow[1] == palette.css(palette.CAPTURE)
    assert float(arrow[2]) < 12.0  # the left border
    assert abs(abs(int(arrow[4])) - 180) < 10  # it points left


def test_nothing_unknown_is_drawn(standing):
    nowhere = np.full(2, np.nan)
    svg = foot_plan(
        replace(standing, zmp_measured=nowhere, zmp_commanded=nowhere, capture=nowhere,
                support_polygon=np.empty((0, 3)), trail=np.full((3, 6), np.nan)), "left", ROBOT, float("nan"),
    )  # fmt: skip
    assert "nan" not in svg
    assert palette.css(palette.ZMP_MEASURED) not in svg


@pytest.mark.parametrize(
    ("place", "nearest"), [((0.9, 0.4), (1.0, 0.4)), ((0.5, -2.0), (0.5, 0.0)), ((3.0, 3.0), (1.0, 1.0))]
)
def test_the_nearest_point_of_an_outline(place, nearest):
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    assert nearest_on_outline(square, np.array(place)) == pytest.approx(nearest)


@pytest.mark.parametrize(
    ("margin_m", "colour"),
    [(0.05, palette.GOOD), (0.02, palette.GOOD), (0.012, palette.WARN), (0.004, palette.BAD), (-0.01, palette.BAD),
     (float("nan"), palette.IDLE)],
)  # fmt: skip
def test_the_colour_of_a_margin(margin_m, colour):
    assert palette.margin_colour(margin_m) == colour


@pytest.mark.parametrize("shape", ["box", "wedge", "half-ball"])
def test_a_stone_is_drawn_where_it_is_and_as_large(shape):
    playback = Playback("stand_left", "two-part")
    playback.apply(PlaceStone(x_m=0.05, y_m=0.18, height_m=0.010, size_m=0.06, shape=shape))
    for _ in range(310):
        playback.tick()
    geometry = playback.live.observer.geometry()
    plan, svg = plan_of(geometry, "left", ROBOT), foot_plan(geometry, "left", ROBOT, 0.05)
    drawn = re.search(r'<polygon data-stone="0" points="([^"]+)"', svg)[1]
    corners = np.array([[float(number) for number in pair.split(",")] for pair in drawn.split()])
    length = 0.06 * plan.scale
    lean = np.array((np.cos(np.deg2rad(10.0)), 1.0)) if shape == "wedge" else np.ones(2)  # a wedge rises to the left
    assert corners.max(axis=0) - corners.min(axis=0) == pytest.approx(length * lean, abs=0.3)
    middle = 0.5 * (corners.max(axis=0) + corners.min(axis=0))
    assert middle == pytest.approx(plan.point(np.array((0.05, 0.18))), abs=0.3)
    assert f"{shape}, 10 mm high, 10 mm now" in svg
    assert ('stroke="#fff" stroke-width="1.4"' in svg) == (shape == "wedge")


def test_a_wedge_points_to_where_it_rises():
    playback = Playback("stand_left", "two-part")
    playback.apply(PlaceStone(x_m=0.05, y_m=0.18, height_m=0.010, size_m=0.06, shape="wedge", slope_direction_deg=90.0))
    for _ in range(310):
        playback.tick()
    svg = foot_plan(playback.live.observer.geometry(), "left", ROBOT, 0.05)
    x, y, u, v = map(float, re.search(r'<path d="M([\d.]+) ([\d.]+)L([\d.]+) ([\d.]+)M', svg).groups())
    assert u < x - 5.0
    assert v == pytest.approx(y, abs=0.2)


def test_a_stone_far_away_is_not_drawn_and_one_in_the_air_is_dashed():
    playback = Playback("stand_left", "two-part")
    playback.apply(PlaceStone(x_m=2.0, y_m=0.0, height_m=0.010, size_m=0.06))
    playback.apply(PlaceStone(x_m=0.18, y_m=0.25, height_m=0.010, size_m=0.04))
    for _ in range(20):
        playback.tick()
    svg = foot_plan(playback.live.observer.geometry(), "left", ROBOT, 0.05)
    assert re.findall(r'data-stone="(\d+)"', svg) == ["1"]
    assert 'stroke-dasharray="4 3"' in svg


@pytest.mark.parametrize(("support", "per_m"), [("left", 780.0), ("right", 780.0), ("double", 620.0)])
def test_of_bip_the_foot_that_stands_is_in_the_middle(standing, support, per_m):
    plan = plan_of(standing, support, ROBOT)
    assert plan.scale == per_m
    assert plan.origin.tolist() == (standing.support_origin[:2] + (0.025, 0.0)).tolist()


@pytest.mark.parametrize("support", ["left", "right", "double"])
def test_both_soles_of_a_smaller_robot_are_seen_and_larger(support):
    playback = Playback(load_scenario("stand_left", {"robot": "offset", "support": support}), "two-part")
    playback.tick()
    geometry, robot = playback.live.observer.geometry(), playback.live.robot
    plan = plan_of(geometry, support, robot)
    drawn = plan.points(geometry.soles.reshape(-1, 3))
    assert (drawn > 0.0).all() and (drawn < (WIDTH, HEIGHT)).all()
    assert plan.scale > plan_of(geometry, support, ROBOT).scale
