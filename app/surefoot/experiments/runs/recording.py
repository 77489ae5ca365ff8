"""The ticks of a run on their way into a file: on disk at least twice a second, whatever ends the run."""

import errno
from collections.abc import Callable, Mapping, Sequence
from itertools import takewhile
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol

import numpy as np

from surefoot.errors import InvalidInput
from surefoot.experiments.runs.events import RunEvent
from surefoot.experiments.runs.partial_file import PARTIAL, PartialRun, PartialWriter
from surefoot.experiments.runs.run_writer import write_run
from surefoot.output_files import OUT, numbered_beside, writing

BATCH_ROWS = 500  # as many ticks are written at once
_EVERY_NS = 500_000_000  # or fewer, after this time of the clock: two of these, unwritten and unsynced, are a second


class Rows(Protocol):
    """What is recorded from: a ``Recorder`` that holds ``BATCH_ROWS`` rows."""

    columns: list[str]

    @property
    def written(self) -> int: ...  # noqa: D102
    def last(self, rows: int) -> np.ndarray: ...  # noqa: D102


class Recording:
    """Writes a run while it goes on into FILE.partial, and in the end from there into the file that was asked for.

    FILE.partial of an earlier run that was interrupted stays; this one's is FILE.2.partial then. Only what has become
    a whole file is deleted. In memory are ``BATCH_ROWS`` ticks, or a row group of Parquet, however long the run is.

    Args:
        out: the file that was asked for, of a kind of ``run_writer.WRITERS``.
        clock: nanoseconds.

    Attributes:
        partial: where the ticks are meanwhile; None before the first one, and after the last was moved.
        failure: why no more of them could be written; the run goes on without.
    """

    def __init__(self, out: Path, clock: Callable[[], int]):
        self.partial: Path | None = None
        self.failure: OSError | None = None
        self._out, self._clock = out, clock
        self._writer: PartialWriter | None = None
        self._rows: Rows | None = None
        self._events: Callable[[], Sequence[RunEvent]] = tuple
        self._written = 0
        self._appended_ns = self._synced_ns = clock()

    def earlier(self) -> list[Path]:
        """What other runs with the same file have left, or are writing."""
        return list(takewhile(Path.exists, numbered_beside(self._out, PARTIAL)))

    def begin(self, rows: Rows, manifest: Mapping[str, Any], events: Callable[[], Sequence[RunEvent]]) -> None:
        """Write what the run is made from, before its first tick.

        Args:
            rows: where its ticks will be.
            manifest: without the outcome.
            events: what the run has come to when it is asked.

        Raises:
            InvalidInput: the file cannot be made.
        """
        self._rows, self._events = rows, events
        with writing(self._out):
            for path in numbered_beside(self._out, PARTIAL):
                try:
                    self._writer = PartialWriter(path, rows.columns, manifest)
                except FileExistsError:
                    continue
                self.partial = path
                return

    def tick(self) -> None:
        """After every tick: write, if it is time to."""
        rows = self._rows
        if rows is None or self._writer is None or self.failure is not None:
            return
        if rows.written - self._written >= BATCH_ROWS or self._clock() - self._appended_ns >= _EVERY_NS:
            self._try(self._append)

    def finish(self, manifest: Mapping[str, Any]) -> None:
        """The run has ended: write the rest, and how it ended."""
        writer = self._writer
        if writer is not None and self.failure is None:
            self._try(self._append)
        if writer is not None and self.failure is None:
            self._try(lambda: writer.finish(manifest))

    def write_out(self) -> None:
        """Make the file that was asked for. Raises InvalidInput: it cannot be; the text says where the ticks are."""
        if self.partial is None or self._writer is None:
            return
        self._writer.close()
        try:
            if self.failure is not None:
                raise self.failure
            whole = PartialRun(self.partial)
            if whole.rows != self._written:
                raise OSError(errno.EIO, f"only {whole.rows} of them can be read again")
            write_run(whole, self._out)
        except OSError as error:
            where = f"its first {self._written} ticks are in {self.partial}, which opens as a run"
            raise InvalidInput(OUT, str(self._out), f"cannot be written: {error.strerror or error}; {where}") from None
        self.partial.unlink()
        self.partial = None

    def __enter__(self) -> "Recording":
        """Nothing is written yet."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Whatever ended the run: what it recorded stays. A KeyboardInterrupt may have come amid a batch."""
        if self._writer is not None and self.partial is not None:
            if isinstance(error, Exception) and self.failure is None and not self._writer.closed:
                self._try(self._append)
            self._writer.close()

    def _append(self) -> None:
        assert self._rows is not None and self._writer is not None
        new = self._rows.written - self._written
        if new > 0:
            self._writer.add(self._rows.last(new), self._events())
            self._written += new
        now = self._appended_ns = self._clock()
        if now - self._synced_ns >= _EVERY_NS:
            self._writer.sync()
            self._synced_ns = now

    def _try(self, write: Callable[[], None]) -> None:
        try:
            write()
        except OSError as error:
            self.failure = error
