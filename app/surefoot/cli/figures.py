"""What the command line prints of the paper's figures and the ablation: progress, verdicts, where the files are."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from surefoot.errors import InvalidInput
from surefoot.experiments.paper.claims import Verdict
from surefoot.experiments.paper.make_report import make_report
from surefoot.experiments.paper.plan import full_plan
from surefoot.experiments.studies.ablation import SCENARIOS, all_variants, run_ablation
from surefoot.experiments.studies.ablation_report import write_ablation

_COLOURS = {Verdict.REPRODUCED: "green", Verdict.CALIBRATED: "cyan", Verdict.PARTLY: "yellow", Verdict.NOT: "red"}


def figures_command(*, out: Path, workers: int) -> None:
    """``surefoot figures``. Raises InvalidInput."""
    with _folder(out, workers), _progress() as bar:
        task = bar.add_task("runs", total=1.0)
        judged = make_report(
            full_plan(), out, workers, lambda what, done: bar.update(task, description=what, completed=done)
        )
    console = Console()
    table = Table("claim of the paper", "verdict", box=None)
    for judgement in judged:
        table.add_row(judgement.claim.text, f"[{_COLOURS[judgement.verdict]}]{judgement.verdict}[/]")
    console.print(table)
    console.print(f"figures (png, svg), report.md, report.html, results.json and raw/ are in {out}", soft_wrap=True)


def ablate_command(*, out: Path, workers: int) -> None:
    """``surefoot ablate``. Raises InvalidInput."""
    variants, results = all_variants(), []
    with _folder(out, workers), _progress() as bar:
        for result in bar.track(
            run_ablation(variants, SCENARIOS, workers), total=len(variants) * len(SCENARIOS), description="ablation"
        ):
            results.append(result)
        text = write_ablation(results, out)
    print(text)
    Console().print(f"ablation.md, .png, .svg and .json are in {out}", soft_wrap=True)


@contextmanager
def _folder(out: Path, workers: int) -> Iterator[None]:
    """The folder to write into, made before anything is run; what the system refuses is the person's to know."""
    if workers < 1:
        raise InvalidInput("--workers", workers, "must be at least 1")
    try:
        out.mkdir(parents=True, exist_ok=True)
        yield
    except OSError as error:
        raise InvalidInput("--out", str(out), f"cannot be written: {error.strerror or error}") from None


def _progress() -> Progress:
    return Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty())
