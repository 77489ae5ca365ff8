"""The report: one text that holds figures, tables and judgements together and can be read alone."""

from collections.abc import Sequence
from pathlib import Path

from surefoot.experiments.paper import tables
from surefoot.experiments.paper.captions import FIGURES
from surefoot.experiments.paper.claims import ClaimVerdict, Judgement
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.parameters import joint_table, parameters
from surefoot.experiments.paper.plan import PREDICTED, SWING
from surefoot.experiments.paper.steps import step_table, variant_table
from surefoot.experiments.paper.tables import sweep_tables
from surefoot.experiments.scenario.scenario import load_scenario, shipped_scenarios


def _text(name: str) -> str:
    return (Path(__file__).parent / "texts" / f"{name}.md").read_text(encoding="utf-8").strip()


def report_text(f: Findings, judged: Sequence[Judgement]) -> str:
    """The whole report, markdown; figures are linked by file name."""
    counts = {verdict: sum(j.verdict is verdict for j in judged) for verdict in ClaimVerdict}
    parts = [
        "# The paper, rerun and interrogated",
        _text("introduction"),
        _provenance(f),
        "## Claims",
        f"{len(judged)} claims: {', '.join(f'{count} {verdict}' for verdict, count in counts.items())}. "
        + _text("claims"),
        tables.claim_table(judged),
        "## Figures",
    ]
    parts += [_figure(f, name) for name in ("figure_1", "figure_5", "figure_6", "figure_7", "figure_8", "figure_9")]
    parts += [
        _figure(f, "second_swing"),
        "## A step onto a stone",
        _text("step_onto_stone"),
        _figure(f, "step_onto_stone", level=0),
        step_table(f),
        variant_table(f),
        _figure(f, "step_in_time"),
        "## Prediction of infeasibility",
        _text("prediction"),
        tables.prediction_table(f),
        _figure(f, "prediction", level=0),
        "## Gain sweep",
        _figure(f, "gain_sweep", level=0),
        *(table.markdown() for table in sweep_tables(f)),
        "## Results",
        "Limits that go first: see `surefoot run`. Margins are those of the measured ZMP to the edge of the true sole.",
        tables.results_table(f.run(c.scenario, c.controller, c.changes) for c in f.plan.cases),
        "## Readings of the paper",
        tables.deviation_table(),
        "## Numbers and their origin",
        tables.parameter_table(parameters(f)),
        joint_table(load_scenario(SWING).robot_description()),
        "## Scenarios and commands",
        _scenarios(f),
        _commands(f),
        "## Raw data",
        _text("raw"),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _provenance(f: Findings) -> str:
    summary = f.results[0].summary
    versions = ", ".join(f"{name} {version}" for name, version in summary["versions"].items())
    return f"Made by `surefoot figures`, commit {summary['git_commit'] or 'unknown'}; {versions}."


def _figure(f: Findings, name: str, level: int = 3) -> str:
    text = next(figure for figure in FIGURES if figure.name == name)
    caption = text.caption(f)
    heading = f"{'#' * level} {text.title}\n\n" if level else ""
    return f"{heading}![{text.title}]({name}.png)\n\n*{caption}*"


def _scenarios(f: Findings) -> str:
    names = dict.fromkeys((*(case.scenario for case in f.plan.all_cases), *PREDICTED))
    rows = ((f"`{name}`", _first_comment(name)) for name in names)
    return "All are shipped with the program.\n\n" + tables.markdown(("scenario", "what happens"), rows)


def _first_comment(name: str) -> str:
    line = shipped_scenarios()[name].read_text(encoding="utf-8").splitlines()[0]
    return line.removeprefix("#").strip()


def _commands(f: Findings) -> str:
    return "```\n" + "\n".join(case.command for case in f.plan.cases + f.plan.told) + "\n```"
