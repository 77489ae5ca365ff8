"""A walk that is steered: which steps it makes, and that the robot makes them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.references import build_gait
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.gait.footsteps import Footstep, Pace, plan_footsteps
from surefoot.gait.progress import Phase
from surefoot.gait.steering import footsteps_from

FEET = (Footstep(0, np.array((0.0, 0.11)), 0.0), Footstep(1, np.array((0.0, -0.11)), 0.0))
PACE = Pace(length_m=0.15, width_m=0.22, turn_rad=0.1)


def places(steps):
    """Foot, place and heading of each step (n, 4)."""
    return np.array([(step.foot, *step.point, step.yaw_rad) for step in steps])


@pytest.mark.parametrize("first_foot", [0, 1])
def test_even_steps_that_are_continued_are_the_same_steps(first_foot):
    planned = plan_footsteps(
        FEET, steps=7, length_m=PACE.length_m, width_m=PACE.width_m, turn_rad=PACE.turn_rad, first_foot=first_foot
    )
    for made in range(1, 7):
        again = footsteps_from(planned[made - 1], PACE, 7 - made)
        np.testing.assert_allclose(places(again), places(planned[made:]), atol=1e-12)


@pytest.mark.parametrize("yaw", [0.0, 1.0])
@pytest.mark.parametrize(("foot", "to_its_left"), [(0, -0.22), (1, 0.22)])
def test_a_single_step_sets_the_foot_beside_the_one_that_stands(foot, to_its_left, yaw):
    here = Footstep(foot, np.array((0.3, -0.2)), yaw)
    (step,) = footsteps_from(here, PACE, 1)
    assert (step.foot, step.yaw_rad) == (1 - foot, yaw)
    forward, left = np.array((math.cos(yaw), math.sin(yaw))), np.array((-math.sin(yaw), math.cos(yaw)))
    assert (step.point - here.point) @ forward == pytest.approx(0.0, abs=1e-12)
    assert (step.point - here.point) @ left == pytest.approx(to_its_left)


@pytest.mark.parametrize("changes", [{}, {"reference.step_width_m": 0.2, "reference.first_foot": "right"}])
def test_a_walk_that_waits_and_is_steered_as_it_was_to_walk_anyway_goes_the_same_way(changes):
    walk = build_gait(load_scenario("walk_flat", changes))
    before = places(walk.footsteps)
    walk.steer(walk.pace)
    np.testing.assert_allclose(places(walk.footsteps), before, atol=1e-12)
    walk.steer(replace(walk.pace, length_m=0.1))
    assert walk.footsteps[0].point[0] == pytest.approx(0.1)
    assert walk.progress.pace.length_m == 0.1


def test_steered_in_mid_step_the_foot_in_the_air_keeps_its_place_and_the_next_ones_turn_then_it_stops_and_goes_on():
    scenario = load_scenario("walk_flat", {"reference.step_period_s": 0.6, "reference.step_length_m": 0.1})
    simulation = build_simulation(scenario, "two-part", rows=9_000).simulation
    walk, landed = simulation.gait, {}

    def until(condition):
        while not condition():
            made = walk.made
            result = simulation.tick()
            assert simulation.fallen is None
            assert simulation.time_s < 9.0  # only keeps a broken walk from going on for ever
            if walk.made > made:
                step = walk.footsteps[made]
                landed[made] = result.terms.feet[step.foot].position_ankle_in_world[:2] - step.point

    until(lambda: walk.phase is Phase.SINGLE and walk.made == 1)
    fixed, count = places(walk.footsteps[:2]), len(walk.footsteps)
    walk.steer(replace(walk.pace, length_m=0.2, turn_rad=math.radians(10.0)))
    np.testing.assert_array_equal(places(walk.footsteps[:2]), fixed)
    assert len(walk.footsteps) == count
    assert walk.footsteps[2].yaw_rad == pytest.approx(math.radians(10.0))
    until(lambda: walk.phase is Phase.DOUBLE and walk.made == 3)
    walk.stop()
    assert len(walk.footsteps) == 4
    until(lambda: walk.phase is Phase.STANDING)
    left, right = walk.footsteps[3], walk.footsteps[2]
    left, right = (left, right) if left.foot == 0 else (right, left)
    assert (left.point - right.point) @ right.axes[:, 0] == pytest.approx(0.0, abs=1e-12)
    walk.stop()  # it has stopped
    assert len(walk.footsteps) == 4
    walk.steer(Pace(length_m=-0.1, width_m=0.22), 2)
    until(lambda: walk.phase is Phase.STANDING and walk.made == 6)
    back = (walk.footsteps[4].point - walk.footsteps[2].point) @ right.axes[:, 0]
    assert back == pytest.approx(-0.1, abs=1e-9)
    assert np.abs(list(landed.values())).max() < 0.02
