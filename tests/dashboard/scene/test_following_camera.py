"""A person's camera beside a walking robot, with a browser that says late where its camera is."""

from collections import deque

import numpy as np
import pytest

from surefoot.dashboard.scene.following_camera import FollowingCamera
from surefoot.dashboard.scene.scene import WHOLE_ROBOT

CLOSE = ((3.0, 0.0, 1.0), (0.0, 0.0, 0.8))
STEP_M = 0.25 / 60.0  # Bip's way in one frame


class Browser:
    """A camera that is moved by messages, and tells where it is some frames later.

    Args:
        late: how many frames.
    """

    def __init__(self, late=5):
        self.camera, self.pose = FollowingCamera(), np.array(WHOLE_ROBOT)
        self.on_the_way = deque([self.pose] * late, maxlen=late)
        self.says, self.robot, self.moves, self.restarted, self.dragging = self.pose, np.zeros(2), 0, False, False
        self.walk(40, 0.0)

    def walk(self, frames, step=STEP_M):
        for _ in range(frames):
            self.robot = self.robot + (step, 0.0)
            self.says = self.on_the_way[0]  # an older pose takes the place of what the camera was told meanwhile
            self.on_the_way.append(self.pose)
            told = self.camera.update(self.robot, self.says, restarted=self.restarted, dragging=self.dragging)
            self.restarted = False
            if told is not None:
                self.camera.told(told)
                self.moves, self.pose = self.moves + 1, told

    def person(self, pose):
        self.pose = pose

    def behind(self):
        """How far the robot is ahead of what the camera looks at [m]."""
        return float(self.robot[0] - self.pose[1, 0])


@pytest.mark.parametrize("late", [1, 5, 30])
def test_it_follows_a_walk_evenly_at_the_person_s_own_angle_however_late_the_browser_is(late):
    browser = Browser(late)
    browser.walk(240)
    ways, before = [], browser.pose
    for _ in range(240):
        browser.walk(1)
        ways.append(float(browser.pose[1, 0] - before[1, 0]))
        before = browser.pose
    assert ways == pytest.approx([STEP_M] * 240, abs=2e-5)
    assert browser.behind() == pytest.approx(0.2 + STEP_M / 0.12, abs=0.01)
    np.testing.assert_allclose(browser.pose[0] - browser.pose[1], np.subtract(*WHOLE_ROBOT), atol=1e-12)
    assert browser.pose[1, 2] == WHOLE_ROBOT[1][2]


def test_a_robot_that_stands_leaves_the_camera_alone():
    browser = Browser()
    for _ in range(10):
        browser.walk(20, +0.008)
        browser.walk(20, -0.008)
    assert browser.moves == 0


def test_a_person_who_turns_the_camera_is_let_finish_and_keeps_the_new_view():
    browser = Browser()
    browser.walk(240)
    target = browser.pose[1]
    for turned in np.linspace(0.1, 1.5, 60):
        browser.person(np.array((target + 3.0 * np.array((np.cos(turned), np.sin(turned), 0.2)), target)))
        moves = browser.moves
        browser.walk(1)
    assert browser.moves == moves  # not one of the last movements was disturbed
    view = browser.pose[0] - browser.pose[1]
    browser.walk(200)
    assert browser.behind() < 0.3
    np.testing.assert_allclose(browser.pose[0] - browser.pose[1], view, atol=1e-12)


def test_one_push_of_the_picture_in_the_middle_of_a_walk_is_not_lost():
    browser = Browser()
    browser.walk(240)
    before = browser.behind()
    browser.person(browser.pose + (0.0, 0.7, 0.1))  # what is under way to the browser undoes it
    browser.walk(20)
    browser.walk(300, 0.0)
    assert browser.pose[1, 1:] == pytest.approx((WHOLE_ROBOT[1][1] + 0.7, WHOLE_ROBOT[1][2] + 0.1))
    assert browser.behind() == pytest.approx(before, abs=0.05)


def test_nothing_moves_under_a_hand_that_drags():
    browser = Browser()
    browser.walk(100)
    browser.dragging, moves = True, browser.moves
    browser.walk(100)
    assert browser.moves == moves
    browser.dragging = False
    browser.walk(120)
    assert browser.behind() < 0.3


def test_who_does_not_follow_stays_and_who_follows_again_begins_where_it_looks():
    browser = Browser()
    browser.walk(240)
    browser.camera.set_follows(False, browser.robot)
    moves, seen = browser.moves, browser.pose
    browser.walk(240)
    assert browser.moves == moves
    browser.camera.set_follows(True, browser.robot)
    browser.walk(30)
    np.testing.assert_array_equal(browser.pose, seen)
    browser.walk(240)
    assert browser.pose[1, 0] > seen[1, 0] + 0.5


def test_a_reset_brings_the_camera_back_to_where_it_was():
    browser = Browser()
    start = browser.pose
    browser.walk(90)  # 0.375 m: near enough for a walk back
    browser.robot, browser.restarted = np.zeros(2), True
    browser.walk(2, 0.0)
    np.testing.assert_allclose(browser.pose, start, atol=1e-12)
    browser.walk(600)
    browser.robot = np.zeros(2)  # far away in one frame: a seek
    browser.walk(2, 0.0)
    np.testing.assert_allclose(browser.pose, start, atol=1e-12)


def test_a_place_is_beside_the_robot_of_now():
    browser = Browser()
    browser.walk(480)
    pose = browser.camera.place(CLOSE, browser.robot)
    np.testing.assert_allclose(pose, np.array(CLOSE) + (*browser.robot, 0.0))
    standing = FollowingCamera()
    np.testing.assert_array_equal(standing.place(CLOSE, np.array((0.03, 0.1))), CLOSE)


def test_a_place_holds_against_movements_that_the_browser_tells_of_later():
    browser = Browser(late=1)
    browser.walk(480)
    browser.walk(80, 0.0)
    browser.pose = browser.camera.place(CLOSE, browser.robot)
    browser.on_the_way.append(np.array(WHOLE_ROBOT) + 0.3)  # the person's, before the button
    browser.walk(1, 0.0)
    browser.walk(100, 0.0)
    np.testing.assert_array_equal(browser.pose, np.array(CLOSE) + (*browser.robot, 0.0))
    browser.robot, browser.restarted = np.zeros(2), True
    browser.walk(2, 0.0)
    np.testing.assert_allclose(browser.pose, CLOSE, atol=1e-12)


def test_a_place_that_the_browser_has_not_taken_is_told_again():
    camera, robot = FollowingCamera(), np.array((2.0, 0.0))
    first = np.array(WHOLE_ROBOT)
    camera.told(first)
    place = camera.place(WHOLE_ROBOT, robot)
    told = [camera.update(robot, first, restarted=False, dragging=False) for _ in range(100)]
    again = next(pose for pose in told if pose is not None)
    np.testing.assert_array_equal(again, place)
    camera.told(again)
    assert all(camera.update(robot, again, restarted=False, dragging=False) is None for _ in range(200))
