"""The same cells on a Dask distributed cluster. Dask is imported here only, and only when it is asked for."""

import contextlib
from collections.abc import Sequence
from typing import Any

from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.bench.cell_runner import Row, run_cell
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.bench.engine import Finished, Task
from surefoot.experiments.bench.fingerprint import code_fingerprint

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
