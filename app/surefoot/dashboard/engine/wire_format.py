"""Reports on their way between processes, without what the other side has already.

Log, settings and plot rows change more rarely than pictures are taken, and the plots' table mostly grows at its end.
"""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from surefoot.dashboard.engine.worker import Recipe, Report
from surefoot.dashboard.messages.snapshot import Snapshot

Packed = tuple[Report, dict[str, Any] | None, Recipe | None]


@dataclass(frozen=True, eq=False)
class Growth:
    """A table that lost rows at its beginning and gained some at its end.

    Attributes:
        dropped: rows lost.
        added: rows gained (n, columns).
    """

    dropped: int
    added: np.ndarray

    def applied(self, table: np.ndarray) -> np.ndarray:
        """The table as it is now."""
        return np.concatenate((table[self.dropped :], self.added))


class Packer:
    """One end; reports are unpacked in the order in which they were packed."""

    def __init__(self) -> None:
        self._picture: dict[str, Any] = {}
        self._recipe: Recipe | None = None

    def pack(self, report: Report) -> Packed:
        """What has to be sent."""
        changed = None
        if report.picture is not None:
            now = {item.name: getattr(report.picture, item.name) for item in fields(Snapshot)}
            changed = {
                name: growth(self._picture.get(name), value) if name == "traces" else value
                for name, value in now.items() if value is not self._picture.get(name, self)
            }  # fmt: skip
            self._picture = now
        recipe = report.recipe if report.recipe is not self._recipe else None
        self._recipe = report.recipe
        return replace(report, picture=None, recipe=None), changed, recipe  # type: ignore[arg-type]


class Unpacker:
    """The other end."""

    def __init__(self) -> None:
        self._picture: dict[str, Any] = {}
        self._recipe: Recipe | None = None

    def unpack(self, packed: Packed) -> Report:
        """The report as it was."""
        report, changed, recipe = packed
        picture = None
        if changed is not None:
            traces = changed.get("traces")
            if isinstance(traces, Growth):
                changed["traces"] = traces.applied(self._picture["traces"])
            self._picture.update(changed)
            picture = Snapshot(**self._picture)
        self._recipe = recipe or self._recipe
        assert self._recipe is not None  # the first report brings one
        return replace(report, picture=picture, recipe=self._recipe)


def growth(before: np.ndarray | None, now: np.ndarray) -> Growth | np.ndarray:
    """How a table (n, columns), ascending in its first column, grew out of another one; itself where it did not."""
    if before is None or not len(before) or not len(now):
        return now
    dropped = int(np.searchsorted(before[:, 0], now[0, 0]))
    kept = before[dropped:]
    same = 0 < len(kept) <= len(now) and kept.tobytes() == now[: len(kept)].tobytes()  # bits: a NaN equals itself
    return Growth(dropped, now[len(kept) :]) if same else now
