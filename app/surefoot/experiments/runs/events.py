"""What happened in a run, for its file: time, kind (as the page's log has it) and words, oldest first."""

from collections.abc import Iterator
from dataclasses import replace

from surefoot.experiments.scenario.references import level_stance_point
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.simulation.event_texts import fall_text, limit_text, push_text, stone_text, tilt_text
from surefoot.simulation.loop import Simulation

RunEvent = tuple[float, str, str]


def scenario_events(scenario: Scenario, until_s: float) -> tuple[RunEvent, ...]:
    """What the scenario itself did to the robot before a time [s]."""
    return tuple(sorted(event for event in _planned(scenario) if event[0] < until_s))


def outcome_events(simulation: Simulation) -> tuple[RunEvent, ...]:
    """The limits that were passed, and the fall."""
    passed = [
        (round(limit.time_s, 6), "infeasible" if limit.name == "qp_infeasible" else "limit", limit_text(limit.name))
        for limit in simulation.watch.events
    ]
    time_s = simulation.fall_time_s
    fell = [] if time_s is None else [(round(time_s, 6), "fall", fall_text(simulation))]
    return (*passed, *fell)


def interruption_event(time_s: float) -> RunEvent:
    """The end of a record that is not the end of its run."""
    return round(time_s, 6), "run", "interrupted: the record ends here"


def in_order(*events: tuple[RunEvent, ...]) -> tuple[RunEvent, ...]:
    """All of them, oldest first; those of one instant as they are given."""
    return tuple(sorted((event for some in events for event in some), key=lambda event: event[0]))


def _planned(scenario: Scenario) -> Iterator[RunEvent]:
    x, y = level_stance_point(scenario) if scenario.stones else (0.0, 0.0)
    for stone in scenario.stones:
        there = replace(stone, x_m=stone.x_m + x, y_m=stone.y_m + y)
        time_s, what = (0.0, "lies there") if stone.lying else (stone.rise_start_s, "rises")
        yield time_s, "stone", stone_text(there, what)
    ground = scenario.ground
    if ground.tilt_duration_s > 0.0:
        text = tilt_text(ground.slope_deg, ground.direction_deg, ground.tilt_duration_s)
        yield ground.tilt_start_s, "run", text
    elif ground.slope_deg > 0.0:
        yield (
            0.0,
            "run",
            f"ground slopes by {ground.slope_deg:g} deg, rising towards {ground.direction_deg:.0f} deg",
        )
    for push in scenario.pushes:
        yield push.start_s, "push", push_text(push)
