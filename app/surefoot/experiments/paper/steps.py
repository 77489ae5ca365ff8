"""How the steps onto a stone ended: one run, all runs of a controller, and their table."""

from collections.abc import Iterable

import numpy as np

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import STEP_VARIANTS, STEPPERS, VARIED_PLACE, Changes
from surefoot.experiments.paper.tables import markdown
from surefoot.experiments.runs.cases import Case, CaseResult
from surefoot.gait.touchdown import TOUCH_N
from surefoot.robot.description import load_robot
from surefoot.simulation.physics import TIMESTEP_S

COMPLETED, UNFINISHED = (
    "completed",
    "unfinished",
)  # else the first cause of the fall, see surefoot.simulation.walk_causes
ROLL = "left_ankle_frontal"  # of the foot that lands on the stone: positive with its outer edge up
_FREE_N = 1.0  # a foot that carries less is in the air

Contender = tuple[str, Changes]


def ending(result: CaseResult) -> str:
    """``completed``, the first cause of the fall, or ``unfinished`` where time ran out."""
    if result.fell:
        return str(result.summary["fall_first_cause"])
    return COMPLETED if result.summary["walk_completed"] else UNFINISHED


def time_at_stop_s(result: CaseResult) -> float:
    """How long [s] the ankle that lands on the stone is rolled as far outward-up as it goes, or further."""
    stop = load_robot("bip").joint_named(ROLL).upper_rad
    return float(np.count_nonzero(result.column(f"angle_{ROLL}_rad") >= stop)) * TIMESTEP_S


def alone_on_stone(result: CaseResult) -> np.ndarray:
    """The ticks (n,), bool, in which the foot that has landed first carries the robot alone."""
    right = result.column("force_right_n")
    return _was_lifted(result) & (result.column("force_left_n") > TOUCH_N) & (right < _FREE_N)


def lifts_after_s(result: CaseResult) -> float | None:
    """Time [s] from the first touch of the foot that lands to when it first stands alone; None if it never does."""
    time_s, alone = result.column("time_s"), alone_on_stone(result)
    touched = _was_lifted(result) & (result.column("force_left_n") > TOUCH_N)
    return float(time_s[alone.argmax()] - time_s[touched.argmax()]) if alone.any() else None


def _was_lifted(result: CaseResult) -> np.ndarray:
    """The ticks (n,), bool, after the left foot was lifted; those in the air among them."""
    return np.logical_or.accumulate(result.column("force_left_n") < _FREE_N)


def completed(f: Findings, contender: Contender, places: Iterable[str]) -> frozenset[tuple[str, float]]:
    """The stones (place, height [m]) at some places with which a controller completes the walk."""
    return frozenset(
        (place, height_m)
        for place in places
        for height_m in f.plan.heights_m
        if ending(f.step(place, height_m, contender)) == COMPLETED
    )


def stones(f: Findings) -> int:
    """How many stones each of them has stepped onto."""
    return len(f.plan.places) * len(f.plan.heights_m)


def step_table(f: Findings) -> str:
    """Markdown: a row for each place and controller, a column for each height."""
    rows = [_row(f, place, contender) for place in f.plan.places for contender in STEPPERS]
    return markdown(_header(f), rows)


def variant_table(f: Findings) -> str:
    """The same of the variants, at the one place where they step, with a line that says so; empty if they do not."""
    if not all(_was_run(f, contender) for contender in STEP_VARIANTS):
        return ""
    table = markdown(_header(f), [_row(f, VARIED_PLACE, contender) for contender in STEP_VARIANTS])
    return f"Variants, with the stone below the {VARIED_PLACE} edge only:\n\n{table}"


def _was_run(f: Findings, contender: Contender) -> bool:
    name, changes = contender
    row = Case("", name, changes).row
    return any(case.row == row for case in f.plan.steps)


def _header(f: Findings) -> list[str]:
    return ["stone below", "controller", *(f"{1e3 * height_m:g} mm" for height_m in f.plan.heights_m), "completed"]


def _row(f: Findings, place: str, contender: Contender) -> list[str]:
    name, changes = contender
    results = [f.step(place, height_m, contender) for height_m in f.plan.heights_m]
    held = len(completed(f, contender, (place,)))
    return [place, f"`{Case('', name, changes).row}`", *map(_cell, results), f"{held}/{len(results)}"]


def _cell(result: CaseResult) -> str:
    end = ending(result)
    return f"**{end.replace('_', ' ')}** {result.summary['fall_time_s']:.2f} s" if result.fell else end
