"""Reports on their way between processes, without what the other side has already.

Log, settings and plot rows change more rarely than pictures are taken, and the plots' table mostly grows at its end.
"""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from surefoot.dashboard.engine.worker import Reply, RunSpec
from surefoot.dashboard.messages.snapshot import Snapshot

Packed = tuple[Reply, dict[str, Any] | None, RunSpec | None]


@dataclass(frozen=True, eq=False)
class TableDelta:
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
    """One end; replies are unpacked in the order in which they were packed."""

    def __init__(self) -> None:
        self._snapshot: dict[str, Any] = {}
        self._spec: RunSpec | None = None

    def pack(self, reply: Reply) -> Packed:
        """What has to be sent."""
        changed = None
        if reply.snapshot is not None:
            now = {item.name: getattr(reply.snapshot, item.name) for item in fields(Snapshot)}
            changed = {
                name: table_delta(self._snapshot.get(name), value) if name == "traces" else value
                for name, value in now.items()
                if value is not self._snapshot.get(name, self)
            }
            self._snapshot = now
        spec = reply.spec if reply.spec is not self._spec else None
        self._spec = reply.spec
        return replace(reply, snapshot=None, spec=None), changed, spec  # type: ignore[arg-type]


class Unpacker:
    """The other end."""

    def __init__(self) -> None:
        self._snapshot: dict[str, Any] = {}
        self._spec: RunSpec | None = None

    def unpack(self, packed: Packed) -> Reply:
        """The reply as it was."""
        reply, changed, spec = packed
        snapshot = None
        if changed is not None:
            traces = changed.get("traces")
            if isinstance(traces, TableDelta):
                changed["traces"] = traces.applied(self._snapshot["traces"])
            self._snapshot.update(changed)
            snapshot = Snapshot(**self._snapshot)
        self._spec = spec or self._spec
        assert self._spec is not None  # the first reply brings one
        return replace(reply, snapshot=snapshot, spec=self._spec)


def table_delta(before: np.ndarray | None, now: np.ndarray) -> TableDelta | np.ndarray:
    """How a table (n, columns), ascending in its first column, grew out of another one; itself where it did not."""
    if before is None or not len(before) or not len(now):
        return now
    dropped = int(np.searchsorted(before[:, 0], now[0, 0]))
    kept = before[dropped:]
    same = 0 < len(kept) <= len(now) and kept.tobytes() == now[: len(kept)].tobytes()  # bits: a NaN equals itself
    return TableDelta(dropped, now[len(kept) :]) if same else now
