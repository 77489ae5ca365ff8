"""In the plan of the feet: where a foot is really carried, against what the estimator takes it to stand on."""

import re

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.shown_robot import shown_robot
from surefoot.dashboard.panels.balance.foot import foot_html
from surefoot.dashboard.panels.balance.foot_believed import assumed_support, contact_patches, hull
from surefoot.dashboard.panels.balance.foot_plan import foot_plan
from surefoot.geometry.polygon import convex_hull
from surefoot.robot.description import load_robot
from tests.support.playback import ticks

ROBOT = shown_robot("bip", load_robot("bip"))


def area(corners):
    x, y = corners.T
    return 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))


@pytest.fixture(scope="module")
def on_a_stone():
    """Standing on its left foot, below whose outer edge a stone has come up, with good sensors."""
    playback = Playback("stand_left", "two-part")
    playback.apply(cmd.ChangeSensing({"preset": "lab"}, "anchor"))
    ticks(playback, 50)
    before = playback.live.observer.geometry()
    playback.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.010, size_m=0.06))
    ticks(playback, 450)
    assert playback.live.simulation.fallen is None
    return before, playback.live.observer.geometry()


def test_on_flat_ground_the_patch_is_the_sole(on_a_stone):
    flat, _ = on_a_stone
    left, right = contact_patches(flat)
    assert len(right) == 0
    assert area(hull(left)) == pytest.approx(area(flat.soles[0][:, :2]), rel=0.02)
    assert area(assumed_support(flat)) == pytest.approx(area(hull(left)), rel=0.02)
    np.testing.assert_allclose(hull(left).mean(axis=0), assumed_support(flat).mean(axis=0), atol=3e-3)


def test_on_a_stone_the_foot_is_carried_by_less_than_is_assumed(on_a_stone):
    _, stone = on_a_stone
    points = contact_patches(stone)[0]
    assert len(points) >= 2
    assert len(hull(points)) == 0 or area(hull(points)) < 0.7 * area(assumed_support(stone))
    sole = convex_hull((stone.soles[0][:, :2] - stone.soles[0][:, :2].mean(axis=0)).tolist())
    for point in points - stone.soles[0][:, :2].mean(axis=0):
        assert sole.signed_margin(point) > -2e-3  # no foot is carried beside it


def test_both_are_drawn_only_where_there_is_an_estimator(on_a_stone, playback):
    _, stone = on_a_stone
    svg = foot_plan(stone, "left", ROBOT, 0.02)
    assert len(re.findall("data-assumed", svg)) == 1
    ticks(playback, 5)
    assert "data-assumed" not in foot_html(playback.snapshot())
    assert "assumed support" not in foot_html(playback.snapshot())
    playback.apply(cmd.ChangeSensing({"preset": "robot"}, "anchor"))
    ticks(playback, 5)
    assert "assumed support" in foot_html(playback.snapshot())


def test_the_believed_robot_is_off_by_what_the_record_says():
    playback = Playback("stand_left", "two-part")
    playback.apply(cmd.ChangeSensing({"preset": "cheap"}, "invariant-ekf"))
    assert playback.snapshot().geometry.believed is None  # before the first tick nobody has believed anything
    ticks(playback, 60)
    before = playback.live.observer.geometry()
    ticks(playback, 1)
    after, recorder = playback.live.observer.geometry(), playback.live.simulation.recorder
    off = [recorder.column(f"position_error_{a}_m")[-1] for a in "xyz"]
    np.testing.assert_allclose(after.believed.qpos[:3] - before.qpos[:3], off, atol=1e-12)
    assert np.linalg.norm(off) > 0.0
    com = [recorder.column(f"believed_com_{a}_m")[-1] for a in "xyz"]
    np.testing.assert_array_equal(after.believed.com, com)
    sole = load_robot("bip").feet[0].sole
    length = np.ptp(sole.vertices[:, 0])
    assert np.ptp(after.believed.soles[0][:, 0]) == pytest.approx(length, rel=0.01)
    # as the record has it, its DCM is off by that as seen from the feet, which are off by what they have drifted
    drift = (after.believed.soles[0] - after.soles[0]).mean(axis=0)[:2]
    error = np.array([recorder.column(f"dcm_error_{a}_m")[-1] for a in "xy"])
    capture = np.array([recorder.column(f"capture_{a}_m")[-1] for a in "xy"])
    np.testing.assert_allclose(after.believed.capture - capture - drift, error, atol=2e-3)
