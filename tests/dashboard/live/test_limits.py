"""How far away each limit is: against what other parts of the program say of the same."""

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.panels.balance.limits import headroom_html, push_text
from surefoot.experiments.scenario.bounds import push_bound, step_impulse
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.footsteps import Footstep
from surefoot.gait.step_bound import one_step_impulse
from surefoot.simulation.external_forces import Push
from tests.support.playback import ticks


@pytest.mark.parametrize("scenario", ["stand_left", "stand_double"])
@pytest.mark.parametrize("direction", [0.0, 90.0, -90.0])
def test_eta_is_the_push_over_the_laboratory_s_bound(scenario, direction):
    playback = Playback(scenario, "two-part")
    ticks(playback, 400)
    assert playback.live.observer.headroom().push is None
    playback.apply(cmd.PushNow(direction_deg=direction, impulse_ns=12.0, duration_s=0.1))
    ticks(playback, 2)
    push = playback.live.observer.headroom().push
    push_then = Push(direction_deg=direction, impulse_ns=12.0, duration_s=0.1)
    bound = push_bound(load_scenario(scenario), push_then)
    assert push.bound_ns == pytest.approx(bound.impulse_ns, rel=0.01)  # it stands where it was put, to a millimetre
    assert push.eta == pytest.approx(12.0 / push.bound_ns)
    assert push.linear_ns(14.0) == pytest.approx(push.bound_ns * push.omega / 14.0)
    assert push.omega == pytest.approx(bound.omega, rel=1e-3)


@pytest.mark.parametrize("support", ["double", "left"])
@pytest.mark.parametrize("direction", [0.0, -90.0])
def test_where_the_robot_may_step_eta_1_is_the_push_over_the_laboratory_s_bound(support, direction):
    changes = {"support": support, "pushes.0.direction_deg": direction, "pushes.0.start_s": 0.3}
    scenario = load_scenario("push_and_step", changes)
    playback = Playback(scenario, "two-part")
    ticks(playback, 305)
    headroom = playback.live.observer.headroom()
    push = headroom.push
    assert push.step.bound_ns == pytest.approx(step_impulse(scenario), rel=0.01)  # it stands where it was put
    assert push.eta_1 == pytest.approx(80.0 / push.step.bound_ns)
    assert push.eta_1 <= push.eta
    text = headroom_html(headroom, 14.0)
    assert f"{push.eta_1:.2f}" in text
    assert f"J_cap1 {push.step.bound_ns:.0f} N·s: with one step, up to 45 cm ahead" in text
    assert "landing 300 ms" in text


def test_a_turned_robot_has_its_step_bound_in_its_own_axes(playback):
    robot, capture = playback.live.simulation.robot, np.array((0.01, 0.02))
    here = [Footstep(i, np.array((0.0, y)), 0.0) for i, y in enumerate((0.11, -0.11))]
    turn = Footstep(0, np.zeros(2), 2.0).axes
    there = [Footstep(foot.foot, turn @ foot.point, 2.0) for foot in here]
    push = {"mass_kg": 105.0, "omega": 3.2, "duration_s": 0.1}
    bounds = [
        one_step_impulse(robot, stances, place, direction, **push)
        for stances, place, direction in (
            (here, capture, np.array((1.0, 0.0))),
            (there, turn @ capture, turn[:, 0]),
        )
    ]
    assert bounds[0] == pytest.approx(bounds[1]) != 0.0


@pytest.mark.parametrize("changes", [{"pushes.0.duration_s": 0.4}, {"reference.step_when_needed": False}])
def test_nothing_is_said_of_a_step_that_nobody_makes_or_the_bound_is_not_for(changes):
    playback = Playback(load_scenario("push_and_step", {"pushes.0.start_s": 0.05, **changes}), "two-part")
    ticks(playback, 55)
    headroom = playback.live.observer.headroom()
    assert headroom.push.eta > 0.0
    assert headroom.push.step is None is headroom.push.eta_1
    assert "J_cap1" not in headroom_html(headroom, 14.0)


def test_only_a_new_push_takes_the_place_of_the_last(playback):
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=5.0))
    ticks(playback, 50)
    first = playback.live.observer.headroom().push
    ticks(playback, 100)
    assert playback.live.observer.headroom().push is first
    playback.apply(cmd.PushNow(direction_deg=0.0, impulse_ns=8.0))
    ticks(playback, 2)
    assert playback.live.observer.headroom().push.impulse_ns == 8.0


def test_the_gauges_say_what_is_measured_elsewhere(playback):
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=15.0))
    result = ticks(playback, 160)
    headroom, robot = playback.live.observer.headroom(), playback.live.simulation.robot
    assert headroom.gauge("zmp").value == pytest.approx(1e3 * result.balance.zmp_margin)
    used = np.abs(result.applied) / robot.torque_limits
    assert headroom.gauge("torque").used == pytest.approx(used.max())
    assert headroom.gauge("torque").label == robot.joints[int(used.argmax())].name.replace("_", " ")
    angles = result.terms.state.q[7:]
    left = np.minimum(angles - robot.joint_lower, robot.joint_upper - angles)
    worst = robot.joint_named(headroom.gauge("joint").label.replace(" ", "_"))
    assert headroom.gauge("joint").value == pytest.approx(1e3 * left[worst.dof - 6])
    force = playback.live.simulation.plant.feet()[0].force
    assert headroom.gauge("friction").used == pytest.approx(np.hypot(force[0], force[1]) / (0.9 * force[2]))
    assert headroom.nearest.used == max(gauge.used for gauge in headroom.gauges)


def test_the_margin_of_the_capture_point_turns_negative_over_the_edge(playback):
    ticks(playback, 50)
    assert playback.live.observer.headroom().gauge("dcm").value > 50.0
    playback.apply(cmd.PushNow(direction_deg=90.0, impulse_ns=80.0))
    ticks(playback, 160)
    headroom = playback.live.observer.headroom()
    assert headroom.gauge("dcm").value < 0.0
    assert headroom.gauge("dcm").label == "left edge"
    assert headroom.gauge("dcm").used > 1.0
    assert headroom.push.eta > 1.5


def test_a_nan_is_said_to_be_unknown(playback):
    ticks(playback, 5)
    playback.live.simulation.plant.data.qvel[3] = np.nan
    playback.tick()
    headroom = playback.live.observer.headroom()
    assert headroom.nearest is None
    assert "nan" not in headroom_html(headroom, 14.0)


def test_the_panel_names_limit_push_and_bound(playback):
    playback.apply(cmd.PushNow(direction_deg=-90.0, impulse_ns=10.0, duration_s=0.2))
    ticks(playback, 3)
    headroom = playback.live.observer.headroom()
    text = headroom_html(headroom, 14.0)
    assert f"{headroom.push.eta:.2f}" in text
    assert headroom.nearest.label in text
    assert "10 N·s right in 200 ms" in push_text(headroom.push, 14.0)
