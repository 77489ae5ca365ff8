"""The page with a robot that is not Bip: stone, push, twin and rewind; its run is kept and replayed; the menu."""

import time
from dataclasses import replace

import numpy as np
import pytest

from surefoot.dashboard.engine.coordinator import Coordinator
from surefoot.dashboard.engine.worker import InlineWorker
from surefoot.dashboard.launch import start_dashboard
from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.shown_robot import robot_choices, shown_robot, view_scale
from surefoot.dashboard.panels.help import tour
from surefoot.dashboard.replay.frames import ReplayFrames
from surefoot.dashboard.replay.html_export import replay_html
from surefoot.dashboard.scene.click_to_place import stone_place
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.run_writer import write_run
from surefoot.experiments.runs.saved_world import force_scale
from surefoot.experiments.scenario.robots import robot_named
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import load_robot
from tests.support.small_biped import write_small_robot

JOINTS, STEPS = 15, 400


@pytest.fixture
def offset():
    return Playback(load_scenario("stand_left", {"robot": "offset"}), "two-part")


def played(coordinator, ticks, *commands):
    coordinator.turn(commands, 0, snapshot=False)
    for _ in range(ticks // 20):
        coordinator.turn((), 20, snapshot=False)
    coordinator.turn((), 0, snapshot=True)
    return coordinator.snapshot(1, 1.0)


def clicked_stone(snapshot):
    """A ctrl-click straight from above on the outer half of the left sole."""
    sole = snapshot.geometry.soles[0]
    x, y = sole[:, :2].mean(axis=0) + (0.0, 0.3 * np.ptp(sole[:, 1]))
    place = stone_place((x, y, 1.0), (0.0, 0.0, -1.0), snapshot.geometry.soles)
    assert place == pytest.approx((x, y))
    return cmd.PlaceStone(x_m=place[0], y_m=place[1], height_m=0.003, size_m=0.03)


def test_a_stone_a_push_a_twin_and_the_way_back(offset):
    coordinator = Coordinator(InlineWorker(offset), InlineWorker)
    first = played(coordinator, 200)
    assert first.robot.title == "Offset"
    assert first.geometry.qpos.shape == (7 + JOINTS,)
    assert np.linalg.norm(first.geometry.com[:2] - first.geometry.support_origin[:2]) < 0.05
    both = played(coordinator, 20, cmd.StartTwin(controller="soft-qp"))
    assert both.twin.other.robot.title == "Offset"
    stone = clicked_stone(both)
    after = played(coordinator, STEPS, stone, cmd.PushNow(direction_deg=0.0, impulse_ns=1.0, duration_s=0.1))
    for one in (after, after.twin.other):
        assert one.balance.fall_cause is None
        assert [view.stone.height_m for view in one.geometry.stones] == [0.003]
        assert "rises under the left sole" in "".join(event.text for event in one.events)
    assert after.twin.other.geometry.qpos.tolist() != after.geometry.qpos.tolist()
    back = played(coordinator, 0, cmd.Seek(after.time_s - 0.2))
    assert back.time_s == pytest.approx(after.time_s - 0.2)
    again = played(coordinator, 200, cmd.Play())
    assert again.time_s == pytest.approx(after.time_s)
    np.testing.assert_array_equal(again.geometry.qpos, after.geometry.qpos)


def test_a_run_is_kept_and_replayed(offset, tmp_path):
    offset.apply(cmd.PlaceStoneAtSole(place="outer edge", height_m=0.003, size_m=0.03))
    for _ in range(120):
        offset.tick()
    write_run(offset.saved_run(), tmp_path / "run.npz")
    run = read_run(tmp_path / "run.npz")
    assert run.manifest["robot"] == "offset"
    frames, geometry = ReplayFrames(run), offset.snapshot().geometry
    assert frames.robot.name == "offset"
    last = frames.geometry(len(frames) - 1)
    np.testing.assert_allclose(last.qpos, geometry.qpos, atol=0.01)
    np.testing.assert_allclose(last.soles, geometry.soles, atol=0.01)
    assert replay_html(run).startswith("<!")


def test_a_hand_pulls_a_light_robot_less_and_its_arrow_is_as_long_against_it(offset):
    bip = Playback("stand_left", "two-part")
    for playback in (bip, offset):
        here = playback.snapshot().geometry.com
        hold = cmd.HoldLink(client_id="me", link="trunk", point=(0.0, 0.0, 0.0), target=tuple((here + 3.0).tolist()))
        playback.apply(hold)
        playback.tick()
    forces = [np.linalg.norm(playback.snapshot().geometry.pulls[0, 6:]) for playback in (bip, offset)]
    robots = [playback.live.simulation.robot for playback in (bip, offset)]
    assert forces == pytest.approx([250.0, 250.0 * 34.8 / 104.81], rel=1e-3)
    shares = [force_scale(robot) / robot.sizes.com_height * force for robot, force in zip(robots, forces, strict=True)]
    assert shares[1] == pytest.approx(shares[0])


def test_the_tour_pushes_and_tilts_another_robot_as_much_as_it_can_bear(offset):
    words = {"robot": "Offset", "mm": tour.height_mm(offset.live.robot)}
    assert not any("Bip" in step.text.format(**words) or "Bip" in step.said for step in tour.STEPS)
    for step in (tour.STEPS[0], tour.STEPS[4]):
        then = now = offset.snapshot()
        for command in step.commands(now):
            offset.apply(command)
        for _ in range(80):
            for _ in range(50):
                offset.tick()
            now = offset.snapshot()
            if step.done(now, then):
                break
        assert step.done(now, then), step.title
    assert [view.stone.height_m for view in offset.snapshot().geometry.stones] == [0.006]
    assert offset.live.scenario.robot == "offset"


def test_the_menu_takes_a_scenario_in_proportion_and_back():
    playback = Playback("walk_flat", "two-part")
    playback.apply(cmd.ChooseRobot("offset"))
    assert playback.live.scenario == load_scenario("walk_flat", {"robot": "offset"})
    playback.apply(cmd.ChooseRobot("bip"))
    assert playback.live.scenario == load_scenario("walk_flat")


def test_another_scenario_keeps_the_robot_and_another_robot_the_scenario(offset):
    offset.apply(cmd.LoadScenario("push_left", {"robot": "/no/such/robot.xml"}))
    assert (offset.live.scenario.name, offset.live.scenario.robot) == ("push_left", "offset")
    offset.apply(cmd.ChooseRobot("bip"))
    assert (offset.live.scenario.name, offset.snapshot().robot.title) == ("push_left", "Bip")
    offset.apply(cmd.ChooseRobot("/no/such/robot.xml"))
    said = offset.snapshot().events[0].text
    assert offset.live.scenario.robot == "bip"
    assert all(name in said for name in ("no such robot", "bip", "offset"))


def test_a_robot_of_somebody_s_own_stays_on_the_menu(offset):
    with pytest.raises(InvalidInput, match="no such robot") as caught:
        load_scenario("stand_left", {"robot": "no_such_robot"}, robot_files=True)
    assert all(word in str(caught.value) for word in ("bip", "offset", "robot.toml"))
    playback = Playback(offset.live.scenario, "two-part", robot_file="/somewhere/mine.xml")
    playback.apply(cmd.ChooseRobot("/somewhere/another.xml"))
    assert "/somewhere/mine.xml" in playback.snapshot().events[0].text


def test_ratios_are_one_for_bip_and_smaller_for_a_smaller_robot():
    bip, small = (shown_robot(name, load_robot(name)) for name in ("bip", "offset"))
    assert (bip.weight, bip.sole, bip.push, view_scale(load_robot("bip"))) == (1.0, 1.0, 1.0, 1.0)
    assert small.weight == pytest.approx(34.8 / 104.81, rel=1e-3)
    assert small.sole == pytest.approx(200 / 290)
    assert 0.1 < small.push < small.weight < view_scale(load_robot("offset")) < 1.0


def test_the_menu_names_each_robot_once():
    bip = shown_robot("bip", load_robot("bip"))
    assert robot_choices(bip) == {"Bip": "bip", "Offset": "offset"}
    assert robot_choices(replace(bip, key="/a/bip.xml"))["Bip (file)"] == "/a/bip.xml"


def test_a_robot_of_a_file_is_called_as_its_mjcf_is(tmp_path):
    write_small_robot(tmp_path)
    (tmp_path / "small").rename(tmp_path / "my_robots")
    file = str(tmp_path / "my_robots" / "robot.toml")
    shown = shown_robot(file, robot_named(file))
    assert shown.title == "Small"
    assert robot_choices(shown)["Small"] == file


def test_the_page_draws_the_robot_that_was_chosen():
    dashboard = start_dashboard(port=0, robot="offset", processes=False)
    try:
        page, send = dashboard.page, dashboard.session.send
        wait_until(lambda: page.frames > 2)
        for robot in ("bip", "offset"):
            send(cmd.ChooseRobot(robot))
            wait_until(lambda robot=robot: page.shown.robot.key == robot)
            frames = page.frames
            wait_until(lambda frames=frames: page.frames > frames + 2)
        assert dashboard.session.statistics().errors == 0
    finally:
        dashboard.stop()


def wait_until(condition):
    while not condition():
        time.sleep(0.02)
