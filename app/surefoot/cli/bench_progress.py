"""How long benches tell of themselves: a bar, or lines where there is no terminal, and what an interruption leaves."""

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from surefoot.cli.console import cells_bar

if TYPE_CHECKING:
    from surefoot.experiments.bench.bench import Bench


def run_and_tell(bench: "Bench", name: str, folder: Path, *, workers: int, cluster: str) -> None:
    """Work through a bench under a bar on standard error. Raises as ``run_bench`` does, and KeyboardInterrupt.

    Args:
        bench: what to do.
        name: of the command.
        folder: of the store.
        workers: processes, or workers of a local cluster.
        cluster: address of a Dask scheduler, ``local``, or empty for processes of this machine.
    """
    from surefoot.experiments.bench.bench import run_bench

    with cells_bar(stays=True) as bar:
        task = bar.add_task(name, total=len(bench.cells))
        lines = _ProgressLines(bar.console, name)

        def on_cell(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total)
            if not sys.stderr.isatty():
                lines.update(done, total)

        try:
            run_bench(bench, folder, workers=workers, cluster=cluster, on_cell=on_cell)
        except KeyboardInterrupt:
            bar.stop()
            bar.console.print(f"interrupted; what is finished is in {folder}: the same command goes on from there")
            raise


class _ProgressLines:
    """Where there is no terminal to draw a bar on: a line for every tenth, with the time left."""

    def __init__(self, console: Console, name: str):
        self._console, self._name, self._began = console, name, time.monotonic()
        self._first: int | None = None
        self._tenth = -1

    def update(self, done: int, total: int) -> None:
        """Print if another tenth is done."""
        if self._first is None:
            self._first = done
        tenth = 10 * done // max(total, 1)
        if tenth == self._tenth:
            return
        self._tenth = tenth
        left = ""
        if done > self._first:
            seconds = (time.monotonic() - self._began) * (total - done) / (done - self._first)
            left = f", about {seconds / 60.0:.0f} min left" if seconds >= 90.0 else f", about {seconds:.0f} s left"
        self._console.print(f"{self._name}: {done}/{total} cells{left}", highlight=False)
