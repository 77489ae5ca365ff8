"""What ``surefoot map`` prints: progress of its runs, and where the maps are."""

import json
import sys
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import run_bench
from surefoot.experiments.bench.store import MANIFEST, read_table
from surefoot.experiments.maps.plan import plan_maps
from surefoot.experiments.maps.report import write_maps

_RUNS = "runs"


def map_command(*, bench: Path | None, out: Path, controllers: str, quick: bool, workers: int) -> None:
    """``surefoot map``. Raises InvalidInput."""
    if bench is not None and (controllers or quick):
        raise InvalidInput(
            "--bench", str(bench), "a finished table is drawn as it is: leave out --controllers, --quick"
        )
    if workers < 1:
        raise InvalidInput("--workers", workers, "must be at least 1")
    try:
        out.mkdir(parents=True, exist_ok=True)
        if bench is None:
            bench = out / _RUNS
            _run(bench, controllers, quick=quick, workers=workers)
        rows = read_table(bench)
        manifest = bench / MANIFEST
        told = json.loads(manifest.read_text(encoding="utf-8")) if manifest.is_file() else {}
        files = write_maps(rows, told, out)
    except OSError as error:
        raise InvalidInput("--out", str(out), f"cannot be written: {error.strerror or error}") from None
    for file in files:
        print(file)


def _run(folder: Path, controllers: str, *, quick: bool, workers: int) -> None:
    plan = plan_maps(controllers, quick=quick)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TextColumn("cells"),
               TextColumn("left"), TimeRemainingColumn())  # fmt: skip
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not sys.stderr.isatty(),
                  speed_estimate_period=600.0) as bar:  # fmt: skip
        task = bar.add_task("maps", total=len(plan.cells))
        run_bench(
            plan, folder, workers=workers, on_cell=lambda done, total: bar.update(task, completed=done, total=total)
        )
