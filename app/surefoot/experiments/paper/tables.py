"""The tables of the report, markdown: results, predictions, claims, parameters, and our readings of the paper.

The readings, of what the paper leaves open or has wrong, have their text in ``deviations.toml``.
"""

import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from surefoot.experiments.paper.claims import Judgement
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.parameters import Parameter
from surefoot.experiments.paper.plan import CONTENDERS, PREDICTED
from surefoot.experiments.runs.cases import Case, CaseResult
from surefoot.experiments.studies.outcomes import OutcomeTable, outcome_of


@dataclass(frozen=True)
class Deviation:
    """One reading.

    Attributes:
        equations: the numbers it concerns; none for a gap between the equations.
        printed: what the paper says, or does not say.
        ours: what is implemented.
        switch: the setting that brings the paper's form back or changes the reading, if there is one.
    """

    equations: tuple[int, ...]
    printed: str
    ours: str
    switch: str = ""


@lru_cache(maxsize=1)
def deviations() -> tuple[Deviation, ...]:
    """All readings, in the order of the file."""
    text = Path(__file__).with_name("deviations.toml").read_text(encoding="utf-8")
    return tuple(
        Deviation(
            equations=tuple(entry["equations"]),
            printed=" ".join(entry["printed"].split()),
            ours=" ".join(entry["ours"].split()),
            switch=entry.get("switch", ""),
        )
        for entry in tomllib.loads(text)["deviation"]
    )


def markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; a bar inside a cell is escaped."""
    lines = [f"| {' | '.join(header)} |", "|---" * len(header) + "|"]
    lines += [f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |" for row in rows]
    return "\n".join(lines)


def results_table(results: Iterable[CaseResult]) -> str:
    """One line a run: the figures of its summary, as ``surefoot run`` gives them."""
    header = (
        "scenario",
        "controller",
        "end",
        "first limit",
        "least ZMP margin [mm]",
        "largest CoM error [mm]",
        "QP first infeasible [s]",
        "ticks infeasible",
        "fallback ticks",
        "peak Γ5 [N m]",
        "peak Γ6 [N m]",
    )
    return markdown(header, (result_cells(result.case.scenario, result.case.row, result.summary) for result in results))


def result_cells(scenario: str, row: str, summary: dict[str, Any]) -> list[str]:
    """The cells of one line of the results table."""
    end = f"falls at {summary['fall_time_s']:.3f} s ({summary['fall_cause']})" if summary["fell"] else "stands"
    first = f"{summary['first_limit']} at {summary['first_limit_time_s']:.3f} s" if summary["first_limit"] else "none"
    return [
        scenario,
        row,
        end,
        first,
        _scaled(summary["zmp_margin_min_m"], 1e3, "+.2f"),
        _scaled(summary["com_error_max_m"], 1e3, ".2f"),
        _scaled(summary["qp_infeasible_first_s"], 1.0, ".3f"),
        str(summary["qp_infeasible_ticks"]),
        str(summary["fallback_ticks"]),
        f"{summary['torque_peak_nm']['5']:.1f}",
        f"{summary['torque_peak_nm']['6']:.1f}",
    ]


def prediction_table(f: Findings) -> str:
    """Predicted against measured first infeasible tick."""
    header = (
        "swing",
        "what goes first",
        "predicted [s]",
        "measured [s]",
        "measured − predicted [ms]",
        "predicted for a point mass [s]",
    )
    rows = []
    for scenario in PREDICTED:
        plan, measured = f.predictions[scenario], f.run(scenario, "optimization").summary["qp_infeasible_first_s"]
        late = None if plan.infeasible_s is None or measured is None else 1e3 * (measured - plan.infeasible_s)
        rows.append(
            (
                scenario,
                plan.limit or "nothing",
                _scaled(plan.infeasible_s, 1.0, ".3f"),
                _scaled(measured, 1.0, ".3f"),
                _scaled(late, 1.0, "+.0f"),
                _scaled(plan.point_mass_infeasible_s, 1.0, ".3f"),
            )
        )
    return markdown(header, rows)


def claim_table(judged: Iterable[Judgement]) -> str:
    """Claim, evidence, verdict and why."""
    rows = []
    for judgement in judged:
        why = "<br>".join(f"{'✓' if check.holds else '✗'} {check.text}" for check in judgement.checks)
        claim = judgement.claim
        rows.append((claim.text, claim.source, claim.evidence, f"**{judgement.verdict}**", why))
    return markdown(("claim of the paper, in our words", "where", "our evidence", "verdict", "why"), rows)


def parameter_table(parameters: Iterable[Parameter]) -> str:
    """Every number with its origin."""
    rows = ((p.group, f"`{p.name}`", p.value, p.meaning, p.origin) for p in parameters)
    return markdown(("group", "name", "value", "what it is", "origin"), rows)


def deviation_table() -> str:
    """Our readings."""
    rows = ((_numbers(d), d.printed, d.ours, f"`{d.switch}`" if d.switch else "") for d in deviations())
    return markdown(("equation", "the paper", "here", "setting"), rows)


def _numbers(deviation: Deviation) -> str:
    return ", ".join(f"({number})" for number in deviation.equations) or "–"


def _scaled(value: float | None, factor: float, form: str) -> str:
    return "–" if value is None else format(factor * value, form)


def sweep_tables(f: Findings) -> tuple[OutcomeTable, ...]:
    """One table a scenario: contenders by gains of the centre of mass."""
    columns = [gain.label for gain in f.plan.gains]
    rows = [Case("", name, changes).row for name, changes in CONTENDERS]
    tables = []
    for scenario in f.plan.swept:
        cells = {
            (row, column): outcome_of(f.gain_run(scenario, contender, i).summary)
            for row, contender in zip(rows, CONTENDERS, strict=True)
            for i, column in enumerate(columns)
        }
        tables.append(OutcomeTable(scenario, rows, columns, cells))
    return tuple(tables)
