"""Fewer points for a chart that has not the pixels for all, without losing a peak."""

import numpy as np


def decimate(table: np.ndarray, most: int) -> np.ndarray:
    """At most ``most`` rows: of each stretch of rows, every column's least and greatest value, in order of time.

    Stretches start at multiples of their length in time, so that a peak looks the same while it moves through the
    window. NaN are skipped where a stretch has anything else.

    Args:
        table: (n, columns), time in the first column, evenly spaced.
        most: greatest number of rows, 4 or more.
    """
    rows = len(table)
    if rows <= most:
        return table
    length = -(-2 * rows // (most - 2))  # two rows for each stretch, and two stretches may be cut off
    step = float(np.median(np.diff(table[:, 0]))) or 1.0
    number = np.floor(np.round(table[:, 0] / step) / length).astype(int)
    starts = np.flatnonzero(np.diff(number, prepend=number[0] - 1))
    low = np.fmin.reduceat(table, starts)
    high = np.fmax.reduceat(table, starts)
    rising = _place(table, low, starts) <= _place(table, high, starts)
    thinned = np.empty((2 * len(starts), table.shape[1]))
    thinned[0::2], thinned[1::2] = np.where(rising, low, high), np.where(rising, high, low)
    thinned[0::2, 0], thinned[1::2, 0] = low[:, 0], high[:, 0]
    return thinned


def _place(table: np.ndarray, values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Row at which each stretch first has a value, column by column."""
    ends = np.append(starts[1:], len(table))
    spread = np.repeat(values, ends - starts, axis=0)
    numbers = np.where(table == spread, np.arange(len(table))[:, None], len(table))
    return np.minimum.reduceat(numbers, starts)
