"""Everybody's own camera, told through a real websocket."""

from types import SimpleNamespace

import numpy as np
import pytest

from surefoot.dashboard.access.gate import Gate
from surefoot.dashboard.access.guarded_server import guarded_server
from surefoot.dashboard.scene.cameras import Cameras
from surefoot.dashboard.scene.light import Light
from surefoot.dashboard.scene.scene import CAMERA_LOOK_AT, CAMERA_POSITION
from tests.support.visitor import Visitor

FAR, AWAY = np.array((2.0, 0.0, 0.8)), np.array((2.0, 0.0, 0.0))


@pytest.fixture
def running():
    server = guarded_server("127.0.0.1", 0, Gate(None))
    yield SimpleNamespace(server=server)
    server.stop()


def looks_at(running, visitor):
    return running.server.get_clients()[visitor.client_id].camera.look_at


def is_told(visitor, position):
    """Wait until a visitor's camera is told to be somewhere."""
    positions = []
    while not any(at == pytest.approx(position) for at in positions):
        camera = [message for message in visitor.hear() if message["type"] == "SetCameraPositionMessage"]
        positions += [message["position"] for message in camera if not message["initial"]]


def settled(cameras, robot):
    for _ in range(60):
        cameras.update(robot)


def test_each_person_s_camera_follows_or_not(running):
    cameras = Cameras(running.server)
    one, other = Visitor(running), Visitor(running)
    settled(cameras, np.zeros(3))
    cameras.set_follows(running.server.get_clients()[other.client_id], False)
    cameras.update(FAR)
    is_told(one, CAMERA_POSITION + AWAY)
    assert looks_at(running, one) == pytest.approx(CAMERA_LOOK_AT + AWAY)
    assert looks_at(running, other) == pytest.approx(CAMERA_LOOK_AT)


def test_who_comes_late_looks_at_where_the_robot_is(running):
    cameras = Cameras(running.server)
    cameras.update(FAR)
    visitor = Visitor(running)
    is_told(visitor, CAMERA_POSITION + AWAY)
    settled(cameras, FAR)
    assert looks_at(running, visitor) == pytest.approx(CAMERA_LOOK_AT + AWAY)


def test_a_page_that_goes_to_its_first_view_by_itself_is_brought_to_where_the_robot_is(running):
    first = running.server.initial_camera
    first.position, first.look_at = CAMERA_POSITION, CAMERA_LOOK_AT
    cameras = Cameras(running.server)
    cameras.update(FAR)
    visitor = Visitor(running)
    for i in range(1, 101):  # a slow page: the robot walks on, and what its camera is told is waiting
        cameras.update(FAR + (0.01 * i, 0.0, 0.0))
    now = FAR + (1.0, 0.0, 0.0)
    for own in (FAR, 0.9 * FAR):  # it loads, and later its person presses viser's "Reset View"
        visitor.look(CAMERA_POSITION, CAMERA_LOOK_AT)
        settled(cameras, now)
        assert looks_at(running, visitor) == pytest.approx(CAMERA_LOOK_AT + AWAY + (1.0, 0.0, 0.0))
        visitor.look(CAMERA_POSITION + own, own)  # the person's own view stays
        settled(cameras, now)
        assert looks_at(running, visitor) == pytest.approx(own)


def test_a_page_that_needs_rest_is_left_in_peace_and_a_robot_that_is_no_number_is_not_followed(running):
    cameras = Cameras(running.server, rest_s=lambda client_id: np.inf)
    visitor = Visitor(running)
    settled(cameras, np.zeros(3))
    cameras.update(FAR)  # the first is sent
    cameras.update(2.0 * FAR)
    cameras.update(np.full(3, np.nan))
    assert looks_at(running, visitor)[0] == pytest.approx(FAR[0])


def test_the_lamp_goes_with_the_robot_and_stays_where_it_stands(running):
    light = Light(running.server)
    lamp = running.server.scene._handle_from_node_name["/light/lamp"]
    before = lamp.position.copy()
    light.follow(np.array((0.1, 0.1, 0.8)))
    assert lamp.position == pytest.approx(before)
    light.follow(20.0 * np.array((1.0, 0.0, 0.04)))
    assert lamp.position - before == pytest.approx((20.0, 0.0, 0.0))
