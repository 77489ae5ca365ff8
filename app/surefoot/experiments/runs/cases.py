"""A case: one run of a shipped scenario, named so that ``surefoot run`` can repeat it; and many of them at once."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.scenario import load_scenario


@dataclass(frozen=True)
class Case:
    """One run.

    Attributes:
        scenario: name of a shipped scenario, or a file.
        controller: name in the registry.
        changes: dotted path and value, as ``--set`` takes them.
    """

    scenario: str
    controller: str
    changes: tuple[tuple[str, Any], ...] = ()

    @property
    def row(self) -> str:
        """Controller and which of its settings were changed, as tables call it."""
        changed = [_short(path, value) for path, value in self.changes if path.startswith("controller.")]
        return f"{self.controller} ({', '.join(changed)})" if changed else self.controller

    @property
    def slug(self) -> str:
        """A file name."""
        changed = [f"{path.split('.')[-1]}={toml_value(value)}".replace('"', "") for path, value in self.changes]
        return "--".join([self.scenario, self.controller, *changed])

    @property
    def command(self) -> str:
        """What to type to repeat it."""
        sets = "".join(f" --set {path}={toml_value(value).replace(chr(34), '')}" for path, value in self.changes)
        return f"surefoot run {self.scenario} --controller {self.controller}{sets}"

    def with_changes(self, *changes: tuple[str, Any]) -> "Case":
        """The same case with more changes."""
        return Case(self.scenario, self.controller, self.changes + changes)


@dataclass(frozen=True, eq=False)
class CaseResult:
    """What a case showed.

    Attributes:
        case: what was run.
        summary: the JSON object of ``surefoot run --json``.
        columns: names of the columns of ``table``.
        table: every tick (n, columns), or None where only the summary was wanted.
    """

    case: Case
    summary: dict[str, Any]
    columns: tuple[str, ...]
    table: np.ndarray | None

    def column(self, name: str) -> np.ndarray:
        """One column (n,). Raises ValueError when the ticks were not kept."""
        if self.table is None:
            raise ValueError(f"the ticks of {self.case.slug} were not kept")
        return self.table[:, self.columns.index(name)]

    @property
    def fell(self) -> bool:
        """Whether the robot fell."""
        return bool(self.summary["fell"])


def run_case(case: Case, *, keep_ticks: bool) -> CaseResult:
    """Run one case. Raises InvalidInput, PostureError."""
    result = run(load_scenario(case.scenario, dict(case.changes)), case.controller)
    table = result.recorder.table() if keep_ticks else None
    return CaseResult(case, result.summary, tuple(result.recorder.columns), table)


def run_cases(cases: Sequence[Case], workers: int, *, keep_ticks: bool) -> Iterator[CaseResult]:
    """Run all cases on some processes (in this one if there is only one worker); yields in order."""
    task = partial(run_case, keep_ticks=keep_ticks)
    if workers == 1:
        yield from map(task, cases)
        return
    with ProcessPoolExecutor(max_workers=workers) as pool:
        yield from pool.map(task, cases)


def toml_value(value: Any) -> str:
    """A plain value as TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return f'"{value}"' if isinstance(value, str) else f"{value:.6g}"


def _short(path: str, value: Any) -> str:
    name = path.split(".")[-1]
    if value is True:
        return name.replace("_", " ")
    return f"{name} = {toml_value(value)}".replace('"', "")
