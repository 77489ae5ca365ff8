"""All that the runs of a report showed, and the few figures that several places read out of it."""

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np

from surefoot.experiments.paper.plan import Changes, Plan, step_case
from surefoot.experiments.paper.poses import PoseTrack
from surefoot.experiments.paper.prediction import Prediction
from surefoot.experiments.runs.cases import Case, CaseResult
from surefoot.geometry.polygon import ConvexPolygon
from surefoot.robot.description import load_robot
from surefoot.robot.feet import Support
from surefoot.task.posture import standing_reference

FRONTAL, SAGITTAL = "torque_left_ankle_frontal_nm", "torque_left_ankle_sagittal_nm"  # Gamma_5, Gamma_6


class Findings:
    """The results, found by what was asked.

    Args:
        plan: what was run.
        results: every result, cases and sweep.
        predictions: by scenario.
        static_case: Figure 1, without and with the technique.
    """

    def __init__(
        self,
        plan: Plan,
        results: Sequence[CaseResult],
        predictions: Mapping[str, Prediction],
        static_case: tuple[PoseTrack, PoseTrack],
    ):
        self.plan, self.predictions, self.static_case = plan, predictions, static_case
        self.results = tuple(results)
        self._found = {_what(result.case): result for result in results}

    def run(self, scenario: str, controller: str, changes: Changes = ()) -> CaseResult:
        """The result of one case. Raises KeyError when it was not run."""
        return self._found[_what(Case(scenario, controller, changes))]

    def step(self, place: str, height_m: float, contender: tuple[str, Changes]) -> CaseResult:
        """The result of a step onto a stone. Raises KeyError when it was not run, InvalidInput: no such place."""
        return self._found[_what(step_case(place, height_m, contender))]

    def gain_run(self, scenario: str, contender: tuple[str, Changes], column: int) -> CaseResult:
        """One cell of the gain sweep; the default gains are those of the case itself."""
        name, changes = contender
        case = Case(scenario, name, (*changes, *self.plan.gains[column].changes))
        return self._found.get(_what(case)) or self.run(scenario, name, changes)

    @cached_property
    def sole(self) -> ConvexPolygon:
        """Outline of the left sole about P."""
        return load_robot("bip").feet[0].sole

    @cached_property
    def place(self) -> np.ndarray:
        """P of the left foot at the start (2,) in world [m]."""
        return standing_reference(load_robot("bip"), Support.LEFT).position_ankles[0][:2]


def _what(case: Case) -> tuple[str, str, Changes]:
    """A case as it is asked for: a run that was cut short is found like the whole one."""
    return case.scenario, case.controller, tuple(change for change in case.changes if change[0] != "duration_s")


def com_margin(result: CaseResult, sole: ConvexPolygon, place: np.ndarray) -> float:
    """Least distance [m] of G's projection to the edge of the sole where it stood at the start; negative outside."""
    com = np.column_stack((result.column("com_x_m"), result.column("com_y_m"))) - place
    return float((sole.offsets - com @ sole.normals.T).min())


def torque_spread_after(result: CaseResult, time_s: float) -> float:
    """Largest change [N m] of Gamma_5 or Gamma_6 from a time on."""
    later = result.column("time_s") > time_s - 5e-7
    return max(float(np.ptp(result.column(name)[later])) for name in (FRONTAL, SAGITTAL))


def torque_travel(result: CaseResult, until_s: float) -> float:
    """How far [N m] Gamma_5 and Gamma_6 wander up and down in all until a time: the less, the smoother."""
    early = result.column("time_s") <= until_s
    return sum(float(np.abs(np.diff(result.column(name)[early])).sum()) for name in (FRONTAL, SAGITTAL))


def com_error(result: CaseResult, until_s: float) -> float:
    """Root mean square [m] of the CoM's horizontal distance from its reference until a time."""
    early = result.column("time_s") <= until_s
    x, y = (result.column(f"com_{a}_m")[early] - result.column(f"com_ref_{a}_m")[early] for a in "xy")
    return float(np.sqrt((x**2 + y**2).mean()))
