"""Steering a walk. Each returns its line for the log."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from surefoot.dashboard.live.live_run import LiveRun
from surefoot.dashboard.live.observation.event_log import LogLine
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.events import EventKind
from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.own_ranges import check_own_ranges
from surefoot.experiments.scenario.references import even_steps, pace_of
from surefoot.gait.walk import Walk


def steer_walk(live: LiveRun, command: cmd.SteerWalk) -> LogLine:
    """Other steps from the next lift-off on. Raises InvalidInput: it does not walk, a value is out of range."""
    walk, spec = _walk(live), even_steps(live.scenario)
    length_m, turn_deg = command.step_length_m, command.turn_deg_per_step
    steps = command.steps or spec.steps  # 0 is for as many as are to come, and checked by nobody
    wanted = replace(spec, step_length_m=length_m, turn_deg_per_step=turn_deg, steps=steps)
    check_own_ranges(wanted, "reference", live.scenario.robot)
    walk.steer(pace_of(wanted), command.steps or None)
    many = f", {command.steps} to come" if command.steps else ""
    return LogLine(EventKind.STEP, f"steered: steps of {length_m:g} m, turn {turn_deg:g}° each{many}", "steer")


def stop_walk(live: LiveRun, command: cmd.StopWalk) -> LogLine:
    """One closing step, and no other. Raises InvalidInput: it does not walk."""
    _walk(live).stop()
    return LogLine(EventKind.STEP, "steered: stop, with a step that sets the feet beside each other", "steer")


def _walk(live: LiveRun) -> Walk:
    gait = live.simulation.gait
    if not isinstance(gait, Walk):
        raise InvalidInput("walk", live.scenario.name, "this scenario does not walk", ['reference.kind = "walk"'])
    return gait


HANDLERS: dict[type, Callable[[LiveRun, Any], LogLine | None]] = {
    cmd.SteerWalk: steer_walk,
    cmd.StopWalk: stop_walk,
}
