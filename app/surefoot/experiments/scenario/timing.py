"""What a scenario asks for at times that cannot be had: rounded to whole ticks, or after the end of the run."""

from collections.abc import Iterator
from itertools import product

from surefoot.experiments.scenario.scenario import Scenario
from surefoot.gait.scale import gait_scale
from surefoot.gait.walk import FIRST_SHIFT_S, LAST_SHIFT_S
from surefoot.simulation.physics import TIMESTEP_S

_WHOLE = 1e-6  # ticks: 0.003 s are three, not 3.0000000000000004

_SENSOR_TIMES = tuple(product(("imu", "encoder", "foot"), ("period_s", "latency_s")))


def rounding_warnings(scenario: Scenario) -> tuple[str, ...]:
    """A line for every time of the plant that is no whole number of ticks."""
    delay, sensors = scenario.physics.control_delay_s, scenario.sensors
    times = {f"sensors.{sensor}_{what}": getattr(sensors, f"{sensor}_{what}") for sensor, what in _SENSOR_TIMES}
    times["physics.control_delay_s"] = delay
    return tuple(line for name, time_s in times.items() for line in _rounded(name, time_s, round(time_s / TIMESTEP_S)))


def end_warnings(scenario: Scenario) -> tuple[str, ...]:
    """A line for everything that a run which ends after its duration will not see, or not see to its end."""
    end = scenario.duration_s
    lines = [*_rounded("duration_s", end, scenario.ticks)]
    for what, start, duration in _timed(scenario):
        if start >= end:
            lines.append(f"{what} starts at {start:g} s: the run is over at {end:g} s, it never happens")
        elif start + duration > end + _WHOLE * TIMESTEP_S:
            lines.append(f"{what} ends at {start + duration:g} s: the run is over at {end:g} s, before that")
    return tuple(lines)


def first_onset(scenario: Scenario) -> float | None:
    """When the first thing that happens begins [s]; None where nothing does."""
    return min((start for _, start, _ in _timed(scenario)), default=None)


def _rounded(name: str, value: float, ticks: int) -> tuple[str, ...]:
    if abs(value / TIMESTEP_S - ticks) <= _WHOLE:
        return ()
    taken = f"{ticks * TIMESTEP_S:g} s is what it is taken for"
    return (f"{name} = {value:g} s is no whole number of ticks of {1e3 * TIMESTEP_S:g} ms: {taken}",)


def _timed(scenario: Scenario) -> Iterator[tuple[str, float, float]]:
    """Name, start and duration [s] of everything that happens at a time."""
    for i, push in enumerate(scenario.pushes):
        yield f"pushes.{i}", push.start_s, push.duration_s
    for i, stone in enumerate(scenario.stones):
        if not stone.lying:
            yield f"stones.{i}", stone.rise_start_s, stone.rise_duration_s
    if scenario.reference.kind == "swing":
        yield "reference", scenario.reference.start_s, scenario.reference.duration_s
    if scenario.reference.kind == "walk":
        spec, steps = scenario.reference, len(scenario.footsteps) or scenario.reference.steps
        shifts_s = (FIRST_SHIFT_S + LAST_SHIFT_S) * gait_scale(scenario.robot_description()).time
        once_s = steps * spec.step_period_s + shifts_s
        yield "reference: its walk", spec.start_s, spec.walks * once_s + (spec.walks - 1) * spec.rest_s
    if scenario.ground.tilt_duration_s > 0.0:
        yield "ground: its tilt", scenario.ground.tilt_start_s, scenario.ground.tilt_duration_s
