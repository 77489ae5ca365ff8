"""The gain sweep beside every comparison, so that nothing is cherry-picked."""

from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import CONTENDERS
from surefoot.experiments.runs.cases import Case
from surefoot.experiments.studies.outcomes import OutcomeTable, outcome_of


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
