"""Where cells are worked through: in this process, on processes of this machine (joblib), or on a cluster (Dask).

Every engine yields (cell, rows) as they are finished, in any order; the caller stores them. Dask is imported only when
it is asked for.
"""

import contextlib
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import joblib
from joblib.externals.loky.process_executor import TerminatedWorkerError

from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.bench.cell_runner import Row, run_cell
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.bench.fingerprint import code_fingerprint

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


LOCAL = "local"
_CONNECT_S = 10


class OtherCodeError(SurefootError):
    """A worker runs another Surefoot than the one that asks."""


def run_on_cluster(cells: Sequence[Cell], address: str, workers: int, task: Task = run_cell) -> Finished:
    """On a scheduler's workers; Dask itself starts the cells of a lost worker again.

    Args:
        cells: what to do.
        address: of a scheduler, e.g. ``tcp://10.0.0.1:8786``, or ``local`` to start a cluster on this machine.
        workers: how many the local cluster gets.
        task: what to do with a cell.

    Raises:
        InvalidInput: Dask is not installed, or the scheduler cannot be reached.
        OtherCodeError: a worker runs another version of Surefoot.
    """
    try:
        from distributed import Client, LocalCluster, as_completed
    except ImportError:
        reason = "needs Dask, which is not installed: pip install 'surefoot[cluster]'"
        raise InvalidInput("--cluster", address, reason) from None
    with contextlib.ExitStack() as stack:
        if address == LOCAL:
            local: Any = LocalCluster(**{"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None})
            address = stack.enter_context(local).scheduler_address
        try:
            client = stack.enter_context(Client(address, timeout=_CONNECT_S))
        except (OSError, ValueError, TimeoutError) as error:
            reason = f"no Dask scheduler answers there: {str(error).splitlines()[0] if str(error) else 'timeout'}"
            raise InvalidInput("--cluster", address, reason, ["tcp://HOST:8786", LOCAL]) from None
        names = [f"surefoot-{cell.key}" for cell in cells]
        futures = client.map(_checked, cells, key=names, task=task, code=code_fingerprint())
        cell_of = dict(zip((future.key for future in futures), cells, strict=True))
        finished = as_completed(futures)
        del futures  # a result that has been fetched need not stay on the cluster
        for future in finished:
            yield cell_of[future.key], future.result()


def _checked(cell: Cell, *, task: Task, code: str) -> list[Row]:
    """Run the task, but only with the code that the asker has."""
    if code_fingerprint() != code:
        reason = "a worker of the cluster runs another Surefoot, or other package versions: install the same there"
        raise OtherCodeError(reason)
    return task(cell)
