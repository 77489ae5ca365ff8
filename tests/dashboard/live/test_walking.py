"""A robot that walks on the page: going back, and another controller in the middle of a step."""

import numpy as np
import pytest

from surefoot.dashboard.live.playback import Playback
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.progress import Phase
from tests.support.playback import recorded_ticks, texts, ticks
from tests.support.rewinding import first_difference

INTO_THE_FIRST_SWING = 1_100  # ticks


@pytest.fixture
def walking() -> Playback:
    return Playback(load_scenario("walk_flat", {"reference.steps": 3}), "two-part")


def test_going_back_into_a_step_and_on_is_the_same_walk_to_the_bit(walking):
    ticks(walking, INTO_THE_FIRST_SWING)
    once = recorded_ticks(walking, 1_400)
    made = walking.live.simulation.gait.made
    assert made >= 2
    walking.apply(cmd.Seek(1e-3 * INTO_THE_FIRST_SWING))
    assert walking.live.simulation.gait.made == 0
    assert walking.live.simulation.gait.phase is Phase.SINGLE
    assert first_difference(once, recorded_ticks(walking, 1_400)) is None
    assert walking.live.simulation.gait.made == made
    assert [text[:6] for text in reversed(texts(walking, EventKind.STEP))] == [f"step {i + 1}" for i in range(made)]


def test_another_controller_takes_over_in_the_middle_of_a_step_and_walks_on(walking):
    ticks(walking, INTO_THE_FIRST_SWING)
    walking.apply(cmd.SetController("soft-qp"))
    walking.apply(cmd.ChangeSettings({"com_weight": 12.0}))
    ticks(walking, 3_000)
    assert walking.live.controller == "soft-qp"
    gait = walking.live.simulation.gait
    assert (gait.made, gait.phase, walking.live.simulation.fallen) == (3, Phase.STANDING, None)


def test_the_page_sees_which_feet_are_to_stand(walking):
    left = walking.snapshot().geometry.support_polygon[:, 1].max()
    ticks(walking, INTO_THE_FIRST_SWING)
    assert left > 0.1
    assert walking.snapshot().geometry.support_polygon[:, 1].max() < 0.0  # the right sole alone


def test_the_page_sees_the_soles_of_the_next_steps_where_they_land_and_that_they_have_landed(walking):
    first = walking.snapshot().geometry.footprints
    assert [footprint.foot for footprint in first] == [0, 1, 0]  # all that are left
    while walking.live.simulation.gait.made == 0:
        walking.tick()
    (landed,) = (event for event in walking.live.log.events if event.kind is EventKind.STEP)
    assert landed.text == "step 1 of 3: the left foot has landed"
    assert landed.time_s == pytest.approx(walking.live.simulation.time_s)
    assert landed in walking.snapshot().timeline.marks
    geometry = walking.snapshot().geometry
    np.testing.assert_allclose(first[0].outline, geometry.soles[0], atol=0.015)  # corner by corner, the height too
    assert [footprint.foot for footprint in geometry.footprints] == [1, 0]


def test_footprints_are_turned_by_the_heading():
    turning = Playback(load_scenario("walk_flat", {"reference.turn_deg_per_step": 20.0}), "two-part")
    ahead = turning.snapshot().geometry.footprints
    assert len(ahead) == 4
    for number, footprint in enumerate(ahead, start=1):
        sole = turning.live.simulation.robot.feet[footprint.foot].sole.vertices
        before, after = sole[1] - sole[0], footprint.outline[1, :2] - footprint.outline[0, :2]
        turned = np.arctan2(before[0] * after[1] - before[1] * after[0], before.dot(after))
        assert np.rad2deg(turned) == pytest.approx(20.0 * number)


def test_a_robot_that_only_stands_or_has_fallen_has_no_steps_to_come(playback, walking):
    assert playback.snapshot().geometry.footprints == ()
    walking.live.simulation.fallen = "test"
    assert walking.snapshot().geometry.footprints == ()


def test_the_page_sees_the_plan_that_the_walk_follows_from_now_on_and_which_feet_are_to_stand(walking):
    geometry = walking.snapshot().geometry
    assert (len(geometry.plan_ahead), geometry.standing) == (0, (0, 1))
    ticks(walking, INTO_THE_FIRST_SWING)
    geometry = walking.snapshot().geometry
    assert geometry.standing == (1,)
    zmp, capture = geometry.plan_ahead[0, :2], geometry.plan_ahead[0, 2:]
    right = geometry.soles[1, :, :2]
    assert (right.min(axis=0) < zmp).all() and (zmp < right.max(axis=0)).all()
    assert capture == pytest.approx(geometry.capture, abs=0.03)
    last = geometry.footprints[-2:]
    middle = np.mean([footprint.outline[:, :2].mean(axis=0) for footprint in last], axis=0)
    assert geometry.plan_ahead[-1] == pytest.approx(np.tile(middle, 2), abs=0.03)  # it rests between the last two
    once = geometry.plan_ahead
    ticks(walking, 100)
    assert len(walking.snapshot().geometry.plan_ahead) > 0
    walking.apply(cmd.Seek(1e-3 * INTO_THE_FIRST_SWING))
    np.testing.assert_array_equal(walking.snapshot().geometry.plan_ahead, once)
    walking.live.simulation.fallen = "test"
    assert len(walking.snapshot().geometry.plan_ahead) == 0
