"""Where cells are worked through: in this process, on processes of this machine (joblib), or on a cluster (Dask).

Every engine yields (cell, rows) as they are finished, in any order; the caller stores them.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import joblib
from joblib.externals.loky.process_executor import TerminatedWorkerError

from surefoot.errors import SurefootError
from surefoot.experiments.bench.cell_runner import Row, run_cell
from surefoot.experiments.bench.cells import Cell

Task = Callable[[Cell], list[Row]]
Finished = Iterator[tuple[Cell, list[Row]]]
_RETRIES = 3
_IDLE_S = 30  # workers whose program was killed do not linger
_ONE_BY_ONE: dict[str, Any] = {"batch_size": 1, "pre_dispatch": "2*n_jobs", "return_as": "generator_unordered"}


class WorkersLostError(SurefootError):
    """Worker processes die again and again."""


def run_here(cells: Sequence[Cell], task: Task = run_cell) -> Finished:
    """One after the other in this process."""
    for cell in cells:
        yield cell, task(cell)


def run_on_processes(cells: Sequence[Cell], workers: int, task: Task = run_cell) -> Finished:
    """On some processes of this machine, one BLAS thread each.

    A worker that is killed takes the cells in flight with it; they are started again, three times at most.

    Raises:
        WorkersLostError: workers keep dying.
    """
    if workers == 1:
        yield from run_here(cells, task)
        return
    left = {cell.key: cell for cell in cells}
    for attempt in range(_RETRIES + 1):
        try:
            with joblib.parallel_config(backend="loky", inner_max_num_threads=1, idle_worker_timeout=_IDLE_S):
                parallel: Any = joblib.Parallel(n_jobs=workers, **_ONE_BY_ONE)
                for key, rows in parallel(joblib.delayed(_keyed)(task, cell) for cell in list(left.values())):
                    yield left.pop(key), rows
            return
        except TerminatedWorkerError:
            if attempt == _RETRIES:
                raise WorkersLostError(
                    f"worker processes died {attempt + 1} times (out of memory?); {len(left)} cells are left: run the "
                    "same command again to go on"
                ) from None


def _keyed(task: Task, cell: Cell) -> tuple[str, list[Row]]:
    return cell.key, task(cell)
