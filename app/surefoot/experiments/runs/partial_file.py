"""A run as it lies on disk while it goes on, and after it was killed: in Arrow's stream format, readable up to its end.

The manifest comes first; then batches of ticks, each with its checksum and with what has happened so far; then, if the
run came to its end, the manifest once more, as it was then.
"""

import errno
import json
import os
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.experiments.runs.events import RunEvent, in_order, interruption_event
from surefoot.experiments.runs.saved_run import INTERRUPTED, MANIFEST, manifest_text, parse_manifest
from surefoot.experiments.runs.table_file import ArrowStream, read_arrow_stream

PARTIAL = ".partial"
_CHECKSUM, _EVENTS = "crc32", "events"


class PartialWriter:
    """Makes such a file. A write that fails is taken back: what was written before can be read.

    Args:
        path: a file that is not there yet.
        columns: names of the table's columns.
        manifest: as it is before the first tick.

    Raises:
        FileExistsError: it is there.
        OSError: it cannot be written.
    """

    def __init__(self, path: Path, columns: Sequence[str], manifest: Mapping[str, Any]):
        self.path = path
        self._file = path.open("xb", buffering=0)
        self._whole = 0  # bytes
        self._stream = ArrowStream(columns, {MANIFEST: manifest_text(manifest)})
        self._nothing = np.empty((len(columns), 0))
        try:
            self._append(self._nothing, {})  # its bytes hold the manifest
            self.sync()
        except BaseException:
            self.close()
            path.unlink()
            raise

    def add(self, table: np.ndarray, events: Sequence[RunEvent]) -> None:
        """Append rows (n, columns), and what the run has come to so far. Raises OSError."""
        self._append(np.ascontiguousarray(table.T), {_EVENTS: json.dumps(events)})

    def finish(self, manifest: Mapping[str, Any]) -> None:
        """Append how it ended. Raises OSError."""
        self._append(self._nothing, {MANIFEST: manifest_text(manifest)})
        self.sync()

    def sync(self) -> None:
        """Have it outlive the machine's power too. Raises OSError."""
        os.fsync(self._file.fileno())

    @property
    def closed(self) -> bool:
        """Whether nothing more can be added."""
        return self._file.closed

    def close(self) -> None:
        """Leave it as it is."""
        self._file.close()

    def _append(self, columns: np.ndarray, about: dict[str, str]) -> None:
        rest = memoryview(self._stream.batch(columns, {**about, _CHECKSUM: _checksum(columns, about)}))
        try:
            size = self._whole + len(rest)
            while rest:
                rest = rest[self._file.write(rest) :]
            self._whole = size
        except BaseException:  # the disk is full; or a second Ctrl-C in the middle
            with suppress(OSError):
                self._file.seek(self._whole)
                self._file.truncate()
            raise


class PartialRun:
    """Opens such a file, without taking all of it into memory.

    Args:
        path: of the file.

    Attributes:
        columns: names of the table's columns.
        manifest: what made the run; where it did not come to its end, marked with when it was interrupted.
        rows: ticks that are there.
        dtype: of their numbers.

    Raises:
        OSError: it cannot be read.
        ValueError: it is none, or holds no tick of an interrupted run.
    """

    dtype = np.dtype(float)

    def __init__(self, path: Path):
        self._path, self.rows = path, 0
        last, events, end = None, "[]", None
        with path.open("rb") as file:
            self.columns, about, batches = read_arrow_stream(file)
            if MANIFEST not in about:
                raise ValueError("it has no manifest")
            for columns, said in _sound(batches):
                self.rows += columns.shape[1]
                last = columns[:, -1] if columns.size else last
                events, end = said.get(_EVENTS, events), said.get(MANIFEST)
        if end is not None:
            self.manifest = parse_manifest(end)
        elif last is None:
            raise ValueError("the run was interrupted before its first ticks were written")
        else:
            time_s = float(last[self.columns.index("time_s")])
            self.manifest = _interrupted(parse_manifest(about[MANIFEST]), time_s, json.loads(events))

    def batches(self) -> Iterator[np.ndarray]:
        """Its rows (n, columns), oldest first, some at a time. Raises OSError: not all of them can be read again."""
        rows = 0
        with self._path.open("rb") as file:
            for columns, _ in _sound(read_arrow_stream(file)[2]):
                rows += columns.shape[1]
                yield columns.T
        if rows < self.rows:
            raise OSError(errno.EIO, f"{self._path} is damaged")


def _interrupted(manifest: dict[str, Any], time_s: float, events: Sequence[RunEvent]) -> dict[str, Any]:
    """The first manifest, with what had happened by then in place of what was going to happen."""
    planned = tuple(event for event in manifest["events"] if event[0] < time_s)
    happened = in_order(planned, tuple(events), (interruption_event(time_s),))
    return {**manifest, "events": [list(event) for event in happened], INTERRUPTED: time_s}


def _sound(batches: Iterator[tuple[np.ndarray, dict[str, str]]]) -> Iterator[tuple[np.ndarray, dict[str, str]]]:
    """Those before the first one that is not as it was written: a machine that lost its power may leave such."""
    for columns, about in batches:
        if about.pop(_CHECKSUM, None) != _checksum(columns, about):
            return
        yield columns, about


def _checksum(columns: np.ndarray, about: Mapping[str, str]) -> str:
    return str(zlib.crc32(columns.data, zlib.crc32("".join(about.values()).encode())))
