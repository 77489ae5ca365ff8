"""A robot that does not know everything stands for a while before it is disturbed.

In its first moments an estimator knows what it was told of the start, and a robot whose links are not as it believes
moves to where it will stand: a push then would meet a robot that nobody has, one that was switched on a moment ago.
With the true state and the nominal model nothing has to settle, and a bench plays each case as it was designed.
"""

import copy
from dataclasses import replace
from typing import Any

from surefoot.experiments.bench.cells import Case
from surefoot.experiments.bench.criteria import WARM_UP_S

_ONSETS = ("start_s", "rise_start_s", "tilt_start_s")


def warmed_up(case: Case) -> Case:
    """The case with all that happens in it ``WARM_UP_S`` later.

    A case in which nothing begins at a time of its own (a fall onto a stone, a slope that is there from the start)
    stays as it is.
    """
    table: dict[str, Any] = copy.deepcopy(dict(case.table))
    if not _delay(table):
        return case
    table["duration_s"] = round(table["duration_s"] + WARM_UP_S, 4)
    return replace(case, table=table)


def _delay(table: Any) -> bool:
    """Make all that begins in a table, and in those in it, begin later; whether there was anything."""
    if isinstance(table, list):
        return any([_delay(item) for item in table])
    if not isinstance(table, dict):
        return False
    begins = [key for key in _ONSETS if key in table]
    for key in begins:
        table[key] = round(table[key] + WARM_UP_S, 4)
    return any([_delay(value) for value in table.values()]) or bool(begins)
