"""Whether a run came out the same again: column by column, to the bit."""

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.saved_run import SavedRun


def difference(kept: SavedRun, again: SavedRun) -> str | None:
    """Where the same run made again differs; None where it does not.

    Args:
        kept: may be the last part of a run only, and may lack columns that were not recorded yet.
        again: at least as long.

    Raises:
        InvalidInput: there is nothing that could be compared.
    """
    names = [name for name in kept.columns if name in again.columns]
    if missing := [name for name in kept.columns if name not in again.columns]:
        raise InvalidInput("column", missing[0], "is not recorded any more", again.columns)
    rows = len(kept.table)
    if len(again.table) < rows:
        return f"{len(again.table)} ticks instead of {rows}"
    then = np.column_stack([kept.column(name) for name in names]).astype(float)
    now = np.column_stack([again.column(name) for name in names])[-rows:]
    differs = then.view(np.uint64) != np.ascontiguousarray(now).view(np.uint64)
    if not differs.any():
        return None
    row = int(np.argmax(differs.any(axis=1)))
    column = int(np.argmax(differs[row]))
    counted = f"{int(differs.any(axis=1).sum())} of {rows} ticks differ"
    time_s = float(kept.column("time_s")[row])
    return f"{counted}, first at {time_s:.3f} s: {names[column]} {then[row, column]!r} -> {now[row, column]!r}"
