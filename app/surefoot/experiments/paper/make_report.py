"""``surefoot figures``: run everything, draw it, judge it, write it down."""

import json
from collections.abc import Callable
from pathlib import Path

from surefoot.experiments.html_page import page
from surefoot.experiments.paper.captions import FIGURES
from surefoot.experiments.paper.claims import Judgement
from surefoot.experiments.paper.claims_on_balance import BALANCE_CLAIMS
from surefoot.experiments.paper.claims_on_steps import STEP_CLAIMS
from surefoot.experiments.paper.claims_on_the_law import LAW_CLAIMS
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import PREDICTED, STONE, Plan
from surefoot.experiments.paper.poses import watch_poses
from surefoot.experiments.paper.prediction import Prediction, predict
from surefoot.experiments.paper.report import report_text
from surefoot.experiments.paper.tables import sweep_tables
from surefoot.experiments.runs.cases import Case, CaseResult, run_cases
from surefoot.experiments.runs.table_file import write_parquet
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.output_files import write_file

CLAIMS = BALANCE_CLAIMS + LAW_CLAIMS + STEP_CLAIMS
_BEFORE_THE_STONE_S = 0.45

Progress = Callable[[str, float], None]


def write_report(findings: Findings, judged: tuple[Judgement, ...], out: Path, progress: Progress) -> None:
    """Write figures, raw data, report.md, report.html and results.json into a folder.

    Args:
        findings: what was run.
        judged: the claims, judged by it.
        out: folder; made if need be.
        progress: told what is being done, and how much of all is done (0 to 1).

    Raises:
        OSError: the folder cannot be written.
    """
    (out / "raw" / "runs").mkdir(parents=True, exist_ok=True)
    progress("figures", 0.96)
    draw_figures(findings, out)
    progress("raw data", 0.98)
    write_raw(findings, out / "raw")
    text = report_text(findings, judged)
    write_file(out / "report.md", text)
    write_file(out / "report.html", page(text, out))
    write_file(out / "results.json", json.dumps(_results(findings, judged), indent=1) + "\n")
    progress("done", 1.0)


def gather(plan: Plan, workers: int, progress: Progress) -> Findings:
    """Run everything that a plan asks for.

    Args:
        plan: what to run.
        workers: processes.
        progress: told what is being done, and how much of all is done (0 to 1).
    """
    results: list[CaseResult] = []
    total = len(plan.all_cases)
    for what, cases, keep_ticks in plan.groups:
        for result in run_cases(cases, workers, keep_ticks=keep_ticks):
            results.append(result)
            progress(what, 0.9 * len(results) / total)
    progress("predictions", 0.9)
    predictions = {scenario: predict(load_scenario(scenario)) for scenario in PREDICTED}
    progress("poses", 0.94)
    cut = next(case for case in plan.cases if case.scenario == STONE).changes
    shortened = tuple(change for change in cut if change[0] == "duration_s")
    ends = load_scenario(STONE, dict(shortened)).duration_s
    times = (_BEFORE_THE_STONE_S, ends - 1e-3)
    without, with_technique = (
        watch_poses(Case(STONE, name, shortened), times) for name in ("optimization", "two-part")
    )
    return Findings(plan, results, predictions, (without, with_technique))


def draw_figures(findings: Findings, out: Path) -> None:
    """Every figure as PNG and SVG."""
    from surefoot.experiments.plots import motion, outcomes, prediction, static_case, step_in_time, steps, torques

    static_case.draw_figure_1(findings, out)
    motion.draw_figure_5(findings, out)
    motion.draw_figure_6(findings, out)
    motion.draw_figure_7(findings, out)
    torques.draw_figure_8(findings, out)
    torques.draw_figure_9(findings, out)
    motion.draw_second_swing(findings, out)
    prediction.draw_prediction(findings, out)
    steps.draw_steps(findings, out)
    step_in_time.draw_step_in_time(findings, out)
    outcomes.draw_tables(sweep_tables(findings), out, "gain_sweep")
    missing = [figure.name for figure in FIGURES if not (out / f"{figure.name}.png").is_file()]
    if missing:
        raise ValueError(f"not drawn: {', '.join(missing)}")


def write_raw(findings: Findings, folder: Path) -> None:
    """Ticks of the runs that are drawn, predictions, and the summaries of the others, as Parquet."""
    for result in findings.results:
        if result.table is not None:
            columns = dict(zip(result.columns, result.table.T, strict=True))
            about = {"command": result.case.command, "summary": json.dumps(result.summary)}
            write_parquet(folder / "runs" / f"{result.case.slug}.parquet", columns, about)
    plans = [(name, plan, i) for name, plan in findings.predictions.items() for i in range(len(plan.time_s))]
    write_parquet(folder / "prediction.parquet", _prediction_columns(plans), {"about": "the references' own ZMP"})
    for name, cases, about in (
        ("gain_sweep", findings.plan.sweep, "summaries of the gain sweep"),
        ("step_onto_stone", findings.plan.told + findings.plan.steps, "summaries of the steps onto a stone"),
    ):
        summaries = [result for result in findings.results if result.case in cases]
        columns = {
            "command": [result.case.command for result in summaries],
            "summary_json": [json.dumps(result.summary) for result in summaries],
        }
        write_parquet(folder / f"{name}.parquet", columns, {"about": about})


def _prediction_columns(plans: list[tuple[str, Prediction, int]]) -> dict[str, list]:
    return {
        "scenario": [name for name, _, _ in plans],
        "time_s": [float(plan.time_s[i]) for _, plan, i in plans],
        "zmp_x_m": [float(plan.zmp_in_world[i, 0]) for _, plan, i in plans],
        "zmp_y_m": [float(plan.zmp_in_world[i, 1]) for _, plan, i in plans],
        "margin_m": [float(plan.margin[i]) for _, plan, i in plans],
        "point_mass_margin_m": [float(plan.point_mass_margin[i]) for _, plan, i in plans],
        "friction_used": [float(plan.friction_used[i]) for _, plan, i in plans],
        **{f"delta_{axis}_nm": [float(plan.delta[i, k]) for _, plan, i in plans] for k, axis in enumerate("xyz")},
    }


def _results(findings: Findings, judged: tuple[Judgement, ...]) -> dict:
    return {
        "runs": [{"command": r.case.command, "row": r.case.row, **r.summary} for r in findings.results],
        "claims": [
            {
                "claim": j.claim.text,
                "verdict": str(j.verdict),
                "checks": [{"holds": check.holds, "text": check.text} for check in j.checks],
            }
            for j in judged
        ],
    }
