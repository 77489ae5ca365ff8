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
    differs = np.zeros(rows, dtype=bool)
    for name in names:
        differs |= _bits(kept.column(name)) != _bits(again.column(name)[-rows:])
    if not differs.any():
        return None
    row = int(np.argmax(differs))
    pairs = ((name, kept.column(name)[[row]], again.column(name)[-rows:][[row]]) for name in names)
    name, then, now = next(pair for pair in pairs if _bits(pair[1]) != _bits(pair[2]))
    counted = f"{int(differs.sum())} of {rows} ticks differ"
    time_s = float(kept.column("time_s")[row])
    return f"{counted}, first at {time_s:.3f} s: {name} {float(then[0])!r} -> {float(now[0])!r}"


def _bits(values: np.ndarray) -> np.ndarray:
    """What numbers are made of, NaN included; one column at a time: a long run fills the memory as it is."""
    return np.ascontiguousarray(values, dtype=float).view(np.uint64)
