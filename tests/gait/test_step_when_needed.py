"""The emergency step: pushes that nobody survives without one, and those that need none."""

import math
from dataclasses import replace

import numpy as np
import pytest

from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.bounds import push_bound
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import Scenario, load_scenario
from surefoot.gait.progress import Phase
from surefoot.simulation.external_forces import Push


def pushed(stand: str, direction_deg: float, share: float, *, steps: bool = True) -> Scenario:
    """A push of so many times J_cap, the most that can be survived without a step."""
    push = Push(direction_deg=direction_deg, impulse_ns=1.0, start_s=0.3, duration_s=0.1)
    scenario = load_scenario(stand, {"reference.step_when_needed": True, "duration_s": 2.4})
    impulse = share * push_bound(scenario, push).impulse_ns
    scenario = replace(scenario, pushes=(replace(push, impulse_ns=impulse),))
    return scenario if steps else replace(scenario, reference=replace(scenario.reference, step_when_needed=False))


# How many times J_cap the linear pendulum survives with a step (test_capture_region.py): 1.75, 2.25, 1.60
@pytest.mark.parametrize(
    ("stand", "direction_deg", "share"),
    [("stand_double", 0.0, 1.4), ("stand_left", 270.0, 1.8), ("stand_left", 180.0, 1.3)],
)
def test_a_step_catches_what_no_ankle_can(stand, direction_deg, share):
    summary = run(pushed(stand, direction_deg, share), "two-part").summary
    assert not summary["fell"]
    assert summary["steps_taken_to_recover"] >= 2  # the other foot follows
    assert run(pushed(stand, direction_deg, share, steps=False), "two-part").summary["fell"]


@pytest.mark.parametrize(("stand", "direction_deg"), [("stand_double", 0.0), ("stand_left", 90.0)])
def test_no_step_is_made_where_none_is_needed_and_nothing_else_changes(stand, direction_deg):
    with_steps, without = (pushed(stand, direction_deg, 0.6, steps=steps) for steps in (True, False))
    ends = []
    for scenario in (with_steps, without):
        simulation = build_simulation(scenario, "two-part", rows=1).simulation
        for _ in range(1_500):
            simulation.tick()
        ends.append(simulation.plant.data.qpos.copy())
    np.testing.assert_array_equal(*ends)


def test_no_step_is_made_where_none_would_help():
    """Pushed outward over the foot that stands: the other foot cannot be set down on that side."""
    assert run(pushed("stand_left", 90.0, 0.95), "two-part").summary["steps_taken_to_recover"] == 0


def test_it_goes_on_the_same_to_the_bit_from_the_middle_of_a_step():
    simulation = build_simulation(pushed("stand_left", 270.0, 1.5), "two-part", rows=3_000).simulation
    while simulation.gait.progress.phase is not Phase.SINGLE:
        simulation.tick()
    for _ in range(100):
        simulation.tick()
    kept, ends = simulation.checkpoint(), []
    for _ in range(2):
        for _ in range(600):
            simulation.tick()
        ends.append(simulation.plant.data.qpos.copy())
        assert simulation.gait.made > 0
        simulation.restore(kept)
        assert simulation.gait.made == 0
    np.testing.assert_array_equal(*ends)


def test_the_step_lands_where_the_capture_point_is():
    simulation = build_simulation(pushed("stand_left", 270.0, 1.5), "two-part", rows=1).simulation
    while simulation.gait.made == 0:
        result = simulation.tick()
    foot = result.terms.feet[1].position_ankle_in_world[:2]
    assert math.dist(foot, result.capture) < 0.06
    assert simulation.gait.progress.planned == 2
    assert [step.foot for step in simulation.gait.steps_ahead] == [0]
