"""Findings without a simulation, and a report of runs cut short."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from surefoot.experiments.paper.claims import Judgement, judge
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.make_report import CLAIMS, gather, write_report
from surefoot.experiments.paper.plan import PREDICTED, STONE, Plan, full_plan, shortened
from surefoot.experiments.paper.poses import PoseTrack
from surefoot.experiments.paper.prediction import Prediction
from surefoot.experiments.runs.cases import Case, CaseResult
from surefoot.robot.description import load_robot
from surefoot.simulation.recorder import column_names

CUT_S = 1.0  # just beyond the first infeasible tick


@dataclass(frozen=True)
class QuickReport:
    """A report of runs that were cut short: the pictures and tables are whole, the verdicts mean little."""

    folder: Path
    plan: Plan
    judged: tuple[Judgement, ...]
    steps: list[tuple[str, float]]


@pytest.fixture(scope="session")
def quick_report(tmp_path_factory) -> QuickReport:
    folder, plan, steps = tmp_path_factory.mktemp("paper") / "figures", shortened(full_plan(), CUT_S), []

    def note(what: str, done: float) -> None:
        steps.append((what, done))

    findings = gather(plan, 2, note)
    judged = judge(CLAIMS, findings)
    write_report(findings, judged, folder, note)
    return QuickReport(folder, plan, judged, steps)


@pytest.fixture(scope="session")
def invented_findings() -> Callable[..., Findings]:
    """Who falls -> findings in which everybody else stands still; nothing is simulated."""
    columns = tuple(column_names([joint.name for joint in load_robot("bip").joints]))
    table = np.zeros((50, len(columns)))
    table[:, columns.index("time_s")] = np.linspace(0.0, 5.0, 50)
    for name, value in (("com_x_m", 0.02), ("com_y_m", 0.11), ("com_ref_x_m", 0.02), ("com_ref_y_m", 0.11)):
        table[:, columns.index(name)] = value

    def result(case: Case, fell: bool, margin: float) -> CaseResult:
        summary = {
            "scenario": case.scenario, "controller": case.controller, "fell": fell,
            "fall_time_s": 2.0 if fell else None, "fall_cause": "support_lost" if fell else None, "first_limit": None,
            "first_limit_time_s": None, "zmp_margin_min_m": margin, "com_error_max_m": 0.01,
            "com_error_final_m": 0.0, "qp_infeasible_ticks": 0, "qp_infeasible_first_s": 0.92, "fallback_ticks": 0,
            "torque_peak_nm": {str(number): 10.0 for number in range(1, 16)}, "walk_completed": not fell,
            "fall_first_cause": "late_landing" if fell else None,
        }  # fmt: skip
        return CaseResult(case, summary, columns, table)

    times = np.array([0.0, 0.92, 1.0])
    inside_then_out = Prediction(
        times, np.zeros((3, 2)), np.array([0.07, -0.01, -0.02]), np.zeros((3, 3)), np.zeros(3), np.zeros(3), 0.92,
        "outer", None,
    )  # fmt: skip

    def build(falls: Callable[[Case], bool], *, margin: float = 0.003) -> Findings:
        plan = full_plan()
        results = [result(case, falls(case), margin) for case in plan.all_cases]
        nobody = PoseTrack(Case(STONE, "two-part"), (), None)
        return Findings(plan, results, dict.fromkeys(PREDICTED, inside_then_out), (nobody, nobody))

    return build
