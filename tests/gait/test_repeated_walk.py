"""A walk that stops, stands and starts again by itself."""

import numpy as np
import pytest

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.walk_tally import WalkTally
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.references import build_gait, planned_footsteps
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.experiments.scenario.timing import end_warnings
from surefoot.gait.progress import Phase
from surefoot.gait.repeated_walk import RepeatedWalk

REST_S = 2.2  # longer than a walk stands at its end before it counts as completed
TWICE = {
    "reference.steps": 2,
    "reference.step_length_m": 0.1,
    "reference.step_period_s": 0.6,
    "reference.walks": 2,
    "reference.rest_s": REST_S,
    "duration_s": 9.0,
}


def test_it_stands_in_between_and_is_completed_when_all_its_steps_are_made_where_they_were_planned():
    scenario = load_scenario("walk_flat", TWICE)
    simulation = build_simulation(scenario, "two-part", rows=scenario.ticks).simulation
    walk, phases = simulation.gait, []
    assert isinstance(walk, RepeatedWalk)
    tally, came_to = WalkTally(walk), []
    for _ in range(scenario.ticks):
        tally.add(simulation.tick())
        phases.append(walk.phase)
        came_to.append(tally.summary(fell=simulation.fallen is not None)["walk_completed"])
    assert simulation.fallen is None
    places = [(step.foot, *step.point) for step in walk.footsteps]
    np.testing.assert_allclose(places, [(step.foot, *step.point) for step in planned_footsteps(scenario)], atol=1e-12)
    assert places[-1][1] == pytest.approx(0.2)  # of either walk one of two steps goes ahead, the other closes
    standing = [phase is Phase.STANDING for phase in phases]
    first = standing.index(True)
    last = len(standing) - standing[::-1].index(False)
    assert standing[first:].index(False) == round(1e3 * REST_S)
    assert walk.made == 4 and walk.landed_s[1] < 1e-3 * first < walk.landed_s[2] < 1e-3 * last
    assert came_to.index(True) > last and came_to[-1]
    assert not end_warnings(scenario)
    assert end_warnings(load_scenario("walk_flat", {**TWICE, "duration_s": 5.0}))


def test_who_is_told_to_stop_stays():
    scenario = load_scenario("walk_flat", TWICE)
    walk = build_gait(scenario)
    assert isinstance(walk, RepeatedWalk)
    assert walk.steps_again == 2
    walk.stop()
    assert walk.steps_again == 0


def test_more_steps_than_any_walk_may_have_are_refused():
    with pytest.raises(InvalidInput, match="makes more than 2000 steps"):
        load_scenario("walk_flat", {"reference.steps": 1000, "reference.walks": 3})
