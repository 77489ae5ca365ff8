"""Writes a run as NPZ, Parquet or CSV, some rows at a time: a run that is longer than the memory can be written too."""

import io
import json
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO, Protocol

import numpy as np

from surefoot.experiments.runs.saved_run import COLUMNS, MANIFEST, TABLE, SavedRun, manifest_text
from surefoot.experiments.runs.table_file import write_csv, write_parquet_groups
from surefoot.output_files import whole_file

_GROUP_ROWS = 32_768  # of Parquet: what is in memory at once, 20 MB


class Ticks(Protocol):
    """What can be written: a run in memory (``SavedRun``) or on disk (``PartialRun``), see there."""

    @property
    def columns(self) -> tuple[str, ...]: ...  # noqa: D102
    @property
    def manifest(self) -> Mapping[str, Any]: ...  # noqa: D102
    @property
    def rows(self) -> int: ...  # noqa: D102
    @property
    def dtype(self) -> np.dtype: ...  # noqa: D102
    def batches(self) -> Iterator[np.ndarray]: ...  # noqa: D102


def write_npz(file: BinaryIO, run: Ticks) -> None:
    """As ``np.savez_compressed``: arrays ``table`` and ``columns``, and ``manifest`` and ``summary``, both JSON."""
    summary = json.dumps(run.manifest.get("summary", {}))
    texts = {COLUMNS: list(run.columns), MANIFEST: manifest_text(run.manifest), "summary": summary}
    shape = (run.rows, len(run.columns))
    header = {"descr": np.lib.format.dtype_to_descr(run.dtype), "fortran_order": False, "shape": shape}
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        with archive.open(f"{TABLE}.npy", "w", force_zip64=True) as member:
            np.lib.format.write_array_header_1_0(member, header)
            for rows in run.batches():
                member.write(np.ascontiguousarray(rows).data)
        for name, value in texts.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(value), allow_pickle=False)


def write_parquet_run(file: BinaryIO, run: Ticks) -> None:
    """A column each, the manifest as JSON in the file's own metadata."""
    about = {MANIFEST: manifest_text(run.manifest)}
    write_parquet_groups(file, run.columns, run.dtype, _regrouped(run.batches(), _GROUP_ROWS), about)


def write_csv_run(file: BinaryIO, run: Ticks) -> None:
    """The table as text."""
    write_csv(file, run.columns, run.batches())


WRITERS: Mapping[str, Callable[[BinaryIO, Ticks], None]] = {
    ".csv": write_csv_run,
    ".npz": write_npz,
    ".parquet": write_parquet_run,
}


def npz_bytes(run: SavedRun) -> bytes:
    """The NPZ file."""
    return _content(write_npz, run)


def parquet_bytes(run: SavedRun) -> bytes:
    """The Parquet file."""
    return _content(write_parquet_run, run)


def write_run(run: Ticks, path: Path) -> None:
    """Write a file of one of the kinds of ``WRITERS``, whole or not at all. Raises OSError."""
    with whole_file(path) as file:
        WRITERS[path.suffix](file, run)


def _content(write: Callable[[BinaryIO, Ticks], None], run: SavedRun) -> bytes:
    file = io.BytesIO()
    write(file, run)
    return file.getvalue()


def _regrouped(batches: Iterable[np.ndarray], rows: int) -> Iterator[np.ndarray]:
    """The same rows, so many at a time; one group without rows where there are none."""
    kept: list[np.ndarray] = []
    count, groups = 0, 0
    for batch in batches:
        while count + len(batch) >= rows:
            taken = rows - count
            yield np.concatenate((*kept, batch[:taken]))
            kept, count, groups, batch = [], 0, groups + 1, batch[taken:]
        kept.append(batch)
        count += len(batch)
    if count or groups == 0:
        yield np.concatenate(kept)
