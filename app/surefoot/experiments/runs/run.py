"""One headless run of a scenario, and the summary that others rely on."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from surefoot.control.interface import Status
from surefoot.control.registry import controller_named
from surefoot.experiments.runs.belief_tally import BeliefTally
from surefoot.experiments.runs.events import in_order, interruption_event, outcome_events, scenario_events
from surefoot.experiments.runs.provenance import git_commit, versions
from surefoot.experiments.runs.push_shares import push_shares
from surefoot.experiments.runs.recording import BATCH_ROWS, Recording
from surefoot.experiments.runs.running_extreme import RunningExtreme
from surefoot.experiments.runs.saved_run import INTERRUPTED, describe_run
from surefoot.experiments.runs.saved_walk import FOOTSTEPS
from surefoot.experiments.runs.tick_times import TickTimes
from surefoot.experiments.runs.walk_tally import WalkTally
from surefoot.experiments.scenario.build import build_simulation
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.experiments.scenario.timing import end_warnings
from surefoot.gait.recovering_walk import RecoveringWalk
from surefoot.gait.step_when_needed import StepWhenNeeded
from surefoot.gait.walk import Walk
from surefoot.simulation.loop import Simulation, TickResult
from surefoot.simulation.recorder import Recorder

MOST_ROWS = 120_000  # two minutes of ticks are kept in memory; summary and recording have all of them
_NOW_AND_THEN = 50  # ticks


@dataclass(frozen=True, eq=False)
class RunResult:
    """What a run showed.

    Attributes:
        summary: the JSON object of ``surefoot run --json``.
        recorder: every tick (the last two minutes); of a run that was recorded into a file the last few.
        manifest: what made it, for a file of the ticks.
    """

    summary: dict[str, Any]
    recorder: Recorder
    manifest: dict[str, Any]


def run(
    scenario: Scenario,
    controller: str,
    *,
    clock: Callable[[], int] | None = None,
    progress: Callable[[float], None] | None = None,
    recording: Recording | None = None,
    stop: Callable[[], bool] | None = None,
    most_rows: int = MOST_ROWS,
    in_proportion: Mapping[str, Any] | None = None,
) -> RunResult:
    """Simulate a scenario to its end or to the fall.

    Args:
        scenario: what to simulate.
        controller: name in the registry.
        clock: nanoseconds, for the timing figures; without it they are None.
        progress: called now and then with the part done, 0 to 1.
        recording: writes every tick as it comes; what is kept in memory is small then.
        stop: asked after every tick whether the run is to end there, as an interrupted one.
        most_rows: how many ticks are kept in memory.
        in_proportion: what of the scenario was scaled for its robot, to be told in the summary.

    Raises:
        InvalidInput, PostureError, ControllerError: see ``build_simulation``.
    """
    ticks = scenario.ticks
    rows = BATCH_ROWS if recording else min(ticks, most_rows)
    setup = build_simulation(scenario, controller, rows=rows, clock=clock)
    simulation, tally, times = setup.simulation, _Tally(), TickTimes()
    walk = WalkTally(simulation.gait) if isinstance(simulation.gait, Walk) else None
    settings = controller_named(controller).settings(scenario.controller)
    if recording:
        planned = scenario_events(scenario, scenario.duration_s)
        first = describe_run(simulation, scenario, controller, settings, planned)
        first.pop(FOOTSTEPS, None)  # of a run that is killed, nobody will know which have landed
        recording.begin(simulation.recorder, first, lambda: outcome_events(simulation))
    started = clock() if clock else 0
    interrupted = False
    for tick in range(1, ticks + 1):
        result = simulation.tick()
        tally.add(result)
        if walk:
            walk.add(result)
        if recording:
            recording.tick()
        if result.fall_cause is not None:
            break
        if tick % _NOW_AND_THEN == 0:
            times.take(simulation.tick_ns)
            if progress:
                progress(tick / ticks)
        if stop and tick < ticks and stop():
            interrupted = True
            break
    elapsed = (clock() - started) * 1e-9 if clock else 0.0
    times.take(simulation.tick_ns)
    if progress:
        progress(1.0)
    warnings = setup.warnings + end_warnings(scenario)
    ended = outcome_events(simulation)
    last_s = float(simulation.recorder.last(1)[0, 0]) if interrupted else None
    if last_s is not None:
        warnings += (f"interrupted at t = {last_s:.3f} s of {scenario.duration_s:g} s",)
        ended += (interruption_event(last_s),)
    summary = _summary(scenario, controller, simulation, tally, times, warnings, elapsed)
    if in_proportion:
        summary["in_proportion"] = dict(in_proportion)
    if shares := push_shares(scenario):
        summary["pushes"] = shares
    if walk:
        began = simulation.fall_first
        summary |= walk.summary(fell=summary["fell"]) | {
            "fall_first_cause": began.name if began else None,
            "fall_first_cause_time_s": _rounded(began.time_s) if began else None,
        }
    if summary["fell"]:
        began = simulation.fall_first if walk else simulation.watch.first
        summary |= tally.before(began.time_s if began else None)
    if simulation.senses is not None:
        summary |= {"estimator": simulation.senses.name} | tally.beliefs.summary()
    if isinstance(simulation.gait, StepWhenNeeded):
        summary["steps_taken_to_recover"] = simulation.gait.made
    if isinstance(simulation.gait, RecoveringWalk):
        summary["steps_taken_to_recover"] = simulation.gait.recovery_steps
    events = in_order(scenario_events(scenario, simulation.time_s), ended)
    manifest = describe_run(simulation, scenario, controller, settings, events, summary)
    if last_s is not None:
        manifest[INTERRUPTED] = last_s
    if recording:
        recording.finish(manifest)
    return RunResult(summary, simulation.recorder, manifest)


class _Tally:
    """Running figures of a run: of every tick that made a step, the one that found the robot fallen too."""

    def __init__(self) -> None:
        self.margin, self.error_max, self.error_last = math.inf, 0.0, 0.0
        self._less_margin, self._errors = RunningExtreme(), RunningExtreme()
        self.infeasible, self.fallback = 0, 0
        self.infeasible_first: float | None = None
        self.torque_peak = np.zeros(1)
        self.beliefs = BeliefTally()

    def add(self, result: TickResult) -> None:
        terms, output, com = result.terms, result.output, result.position_com
        if terms is None or output is None or com is None:
            return
        error = com - result.reference.position_com
        self.error_last = math.sqrt(float(error.dot(error)))
        self.error_max = max(self.error_max, self.error_last)
        self._errors.add(terms.state.time_s, self.error_last)
        self._less_margin.add(terms.state.time_s, -result.balance.zmp_margin)
        if result.balance.zmp_margin < self.margin:  # False for NaN
            self.margin = result.balance.zmp_margin
        if output.infeasible:
            self.infeasible += 1
            if self.infeasible_first is None:
                self.infeasible_first = terms.state.time_s
        self.fallback += output.status is Status.FALLBACK
        self.beliefs.add(result.belief)
        self.torque_peak = np.maximum(self.torque_peak, np.abs(result.applied))

    def before(self, time_s: float | None) -> dict[str, float | None]:
        """Least margin and greatest error of the ticks before a time [s]; None where there are none, or no time."""
        less, error = (None if time_s is None else of.before(time_s) for of in (self._less_margin, self._errors))
        return {
            "zmp_margin_min_before_limit_m": None if less is None else -less,
            "com_error_max_before_limit_m": error,
        }


def _summary(
    scenario: Scenario,
    controller: str,
    simulation: Simulation,
    tally: _Tally,
    times: TickTimes,
    warnings: tuple[str, ...],
    elapsed_s: float,
) -> dict[str, Any]:
    first = simulation.watch.first
    peaks = np.broadcast_to(tally.torque_peak, len(simulation.robot.joints))
    torque_peaks = zip(simulation.robot.joints, peaks.tolist(), strict=True)
    return {
        "scenario": scenario.name,
        "controller": controller,
        "fell": simulation.fallen is not None,
        "fall_time_s": _rounded(simulation.fall_time_s),
        "fall_cause": simulation.fallen,
        "error": simulation.error,
        "first_limit": first.name if first else None,
        "first_limit_time_s": _rounded(first.time_s) if first else None,
        "duration_s": _rounded(simulation.time_s),
        "zmp_margin_min_m": tally.margin if math.isfinite(tally.margin) else None,
        "com_error_max_m": tally.error_max,
        "com_error_final_m": tally.error_last,
        "qp_infeasible_ticks": tally.infeasible,
        "qp_infeasible_first_s": _rounded(tally.infeasible_first),
        "fallback_ticks": tally.fallback,
        "torque_peak_nm": {
            joint.key: peak for joint, peak in sorted(torque_peaks, key=lambda pair: pair[0].number or 0)
        },
        "warnings": list(warnings),
        "tick_us_median": times.percentile_us(50.0),
        "tick_us_p99": times.percentile_us(99.0),
        "real_time_factor": simulation.time_s / elapsed_s if elapsed_s > 0.0 else None,
        "git_commit": git_commit(),
        "versions": versions(),
    }


def _rounded(time_s: float | None) -> float | None:
    """Times are whole milliseconds: drop the rounding dust of adding them up."""
    return None if time_s is None else round(time_s, 6)
