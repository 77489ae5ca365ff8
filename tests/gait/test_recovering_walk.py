"""A walk that is pushed where it stands: it steps, stands, and walks on from there."""

from dataclasses import replace

import numpy as np
import pytest

from surefoot.experiments.runs.run import run
from surefoot.experiments.runs.walk_tally import WalkTally
from surefoot.experiments.scenario.bounds import push_bound, step_impulse
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.references import planned_footsteps
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.gait.progress import Phase
from surefoot.gait.recovering_walk import RecoveringWalk
from surefoot.simulation.external_forces import Push


def pushed(start_s: float, duration_s: float, changes: dict[str, object]) -> Scenario:
    """A short walk that is pushed forward, midway between what no step can survive and what one can."""
    short = {"reference.step_length_m": 0.1, "reference.step_period_s": 0.6, "duration_s": duration_s}
    scenario = load_scenario("walk_flat", {"reference.step_when_needed": True, **short, **changes})
    push = Push(direction_deg=0.0, impulse_ns=1.0, start_s=start_s, duration_s=0.1)
    scenario = replace(scenario, pushes=(push,))
    midway = 0.5 * (push_bound(scenario).impulse_ns + step_impulse(scenario))  # 92 of 58 and 126 N s
    return replace(scenario, pushes=(replace(push, impulse_ns=midway),))


def test_pushed_between_two_walks_it_steps_and_makes_the_second_and_without_the_switch_it_falls():
    scenario = pushed(2.2, 7.8, {"reference.steps": 1, "reference.walks": 2, "reference.rest_s": 0.6})
    summary = run(scenario, "two-part").summary
    assert not summary["fell"] and summary["walk_completed"]
    assert (summary["steps_planned"], summary["steps_made"]) == (2, 2)
    assert summary["steps_taken_to_recover"] == 2  # the other foot follows
    without = run(replace(scenario, reference=replace(scenario.reference, step_when_needed=False)), "two-part").summary
    assert without["fell"] and without["steps_made"] == 1 and not without["walk_completed"]


def test_pushed_before_its_start_it_walks_from_where_it_then_stands_and_pushed_at_its_end_it_steps_again():
    scenario = pushed(0.1, 6.0, {"reference.steps": 2, "reference.start_s": 0.3})
    simulation = build_simulation(scenario, "two-part", rows=1).simulation
    walk, planned = simulation.gait, planned_footsteps(scenario)
    assert isinstance(walk, RecoveringWalk)
    tally = WalkTally(walk)
    while walk.steps_kept == 0:
        tally.add(simulation.tick())
    assert simulation.time_s < scenario.reference.start_s and walk.stances == ()
    middles = [middle(simulation)]
    while walk.steps_kept:
        tally.add(simulation.tick())
        assert walk.made <= 2 and not tally.summary(fell=False)["walk_completed"]
    middles.append(middle(simulation))
    assert walk.recovery_steps == walk.made == 2
    assert simulation.time_s - walk.landed_s[-1] > scenario.reference.rest_s
    way = middles[1] - middles[0]
    assert way[0] > 0.3
    for step, was in zip(walk.footsteps[2:], planned, strict=True):
        np.testing.assert_allclose(step.point - was.point, way, atol=1e-3)
    while walk.phase is not Phase.STANDING or walk.made < 4:
        tally.add(simulation.tick())
        assert simulation.fallen is None
    came_to = tally.summary(fell=False)
    assert (came_to["steps_planned"], came_to["steps_made"], walk.recovery_steps) == (2, 2, 2)
    assert walk.progress.planned == walk.progress.made == 4

    simulation.pushes.append(replace(scenario.pushes[0], start_s=simulation.time_s + 0.3))
    while walk.phase is not Phase.STANDING or walk.made < 6:
        tally.add(simulation.tick())
        assert simulation.fallen is None
    assert walk.recovery_steps == 4
    came_to = tally.summary(fell=False)
    assert (came_to["steps_planned"], came_to["steps_made"], came_to["walk_completed"]) == (2, 2, False)


def test_it_goes_on_the_same_to_the_bit_from_the_middle_of_an_emergency_step_and_is_steered_there():
    scenario = pushed(0.1, 6.0, {"reference.steps": 2, "reference.start_s": 0.3, "reference.rest_s": 0.0})
    simulation = build_simulation(scenario, "two-part", rows=6_000).simulation
    walk = simulation.gait
    while walk.swinging is None:
        simulation.tick()
    for _ in range(100):
        simulation.tick()
    kept, ends = simulation.checkpoint(), []
    for _ in range(2):
        while walk.steps_kept:
            simulation.tick()
        for _ in range(300):
            simulation.tick()
        assert walk.phase is Phase.DOUBLE and walk.made == walk.recovery_steps == 2
        ends.append(simulation.plant.data.qpos.copy())
        simulation.restore(kept)
        assert walk.made == 0 and walk.steps_kept == 2
    np.testing.assert_array_equal(*ends)

    walk.steer(replace(walk.pace, length_m=-0.05), 3)
    assert walk.steps_kept == 3 and len(walk.steps_ahead) == 2
    while walk.steps_kept:
        simulation.tick()
    *_, last = walk.footsteps[:2]
    assert [step.foot for step in walk.footsteps[2:]] == [1 - last.foot, last.foot, 1 - last.foot]
    assert walk.footsteps[3].point[0] - last.point[0] == pytest.approx(-0.1)

    simulation.restore(kept)
    walk.stop()
    assert walk.steps_kept == 0
    while walk.phase is not Phase.STANDING:
        simulation.tick()
    assert walk.made == walk.progress.planned == 2


def middle(simulation) -> np.ndarray:
    """Between both ankles (2,) [m]."""
    left, right = (foot.position_ankle[:2] for foot in simulation.plant.feet())
    return 0.5 * (left + right)
