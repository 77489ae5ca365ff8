"""Raw data as CSV, Parquet or Arrow, the last two with a few lines of text about it. Only this file knows pyarrow."""

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from surefoot.errors import one_line


def write_parquet(path: Path | BinaryIO, columns: Mapping[str, Any], about: Mapping[str, str]) -> None:
    """Write a table to a path or an open file; ``about`` goes into the file's own metadata."""
    import pyarrow.parquet as pq

    pq.write_table(arrow_table(columns, about), path, compression="zstd")


def write_parquet_groups(
    file: BinaryIO, names: Sequence[str], dtype: np.dtype, groups: Iterable[np.ndarray], about: Mapping[str, str]
) -> None:
    """Write the same file with one row group (rows, columns) after the other, each of which alone is in memory."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    kind = pa.from_numpy_dtype(dtype)
    schema = pa.schema([(name, kind) for name in names], metadata=dict(about))
    with pq.ParquetWriter(file, schema, compression="zstd") as writer:
        for rows in groups:
            columns = [pa.array(np.ascontiguousarray(rows[:, i])) for i in range(len(names))]
            writer.write_table(pa.Table.from_arrays(columns, schema=schema))


def arrow_table(columns: Mapping[str, Any], about: Mapping[str, str]) -> Any:
    """A ``pyarrow.Table``; ``about`` is its metadata."""
    import pyarrow as pa

    return pa.table(dict(columns)).replace_schema_metadata(dict(about))


def read_parquet(path: Path) -> tuple[dict[str, list[Any]], dict[str, str]]:
    """Columns and metadata of a file that ``write_parquet`` wrote. Raises OSError, or ValueError: it is none."""
    table, about = _read(path)
    return table.to_pydict(), about


def read_parquet_numbers(path: Path) -> tuple[tuple[str, ...], np.ndarray, dict[str, str]]:
    """Names, table (rows, columns) and metadata of one that holds numbers only. Raises OSError, ValueError."""
    table, about = _read(path)
    if any(column.null_count for column in table.columns):
        raise ValueError("a number in it is missing")
    return tuple(table.column_names), np.column_stack([column.to_numpy() for column in table.columns]), about


def _read(path: Path) -> tuple[Any, dict[str, str]]:
    import pyarrow.parquet as pq

    try:
        table = pq.read_table(path)
        return table, _texts(table.schema.metadata)
    except OSError:
        raise
    except Exception as error:  # of a foreign file: whatever its decoder raises
        raise ValueError(one_line(error)) from None


class ArrowStream:
    """A table that grows at its end, in Arrow's stream format, as the bytes to append to a file.

    What is whole of it can be read though its end is missing.

    Args:
        names: of the columns, all of them 64-bit numbers.
        about: goes into the first bytes.
    """

    def __init__(self, names: Sequence[str], about: Mapping[str, str]):
        import pyarrow as pa

        self._sink = io.BytesIO()
        self._schema = pa.schema([(name, pa.float64()) for name in names], metadata=dict(about))
        self._writer = pa.ipc.new_stream(self._sink, self._schema)

    def batch(self, columns: np.ndarray, about: Mapping[str, str]) -> bytes:
        """The bytes of some rows, given as (columns, rows), C-contiguous. The first ones hold the names too."""
        import pyarrow as pa

        batch = pa.RecordBatch.from_arrays([pa.array(column) for column in columns], schema=self._schema)
        self._writer.write_batch(batch, custom_metadata=dict(about))
        added = self._sink.getvalue()
        self._sink.seek(0)
        self._sink.truncate()
        return added


def read_arrow_stream(
    file: BinaryIO,
) -> tuple[tuple[str, ...], dict[str, str], Iterator[tuple[np.ndarray, dict[str, str]]]]:
    """Names, what is said about the table, and its batches (columns, rows) with what is said about each.

    The batches end where the file does, or where it is damaged. Raises ValueError: not even its start can be read.
    """
    import pyarrow as pa

    try:
        reader = pa.ipc.open_stream(file)
        names, about = tuple(reader.schema.names), _texts(reader.schema.metadata)
    except Exception as error:  # of a foreign file: whatever its decoder raises
        raise ValueError(one_line(error)) from None
    return names, about, _batches(reader)


def _batches(reader: Any) -> Iterator[tuple[np.ndarray, dict[str, str]]]:
    while True:
        try:
            batch, about = reader.read_next_batch_with_custom_metadata()
            columns = np.stack([column.to_numpy() for column in batch.columns])
            texts = _texts(about)
        except Exception:  # StopIteration at the end; at a cut or a damage, whatever its decoder raises
            return
        yield columns, texts


def _texts(about: Mapping[bytes, bytes] | None) -> dict[str, str]:
    return {key.decode(): value.decode() for key, value in (about or {}).items()}


def csv_bytes(names: Sequence[str], table: np.ndarray) -> bytes:
    """A table (n, columns) as text, nine digits of each number, their names in the first line."""
    file = io.BytesIO()
    write_csv(file, names, [table])
    return file.getvalue()


def write_csv(file: BinaryIO, names: Sequence[str], batches: Iterable[np.ndarray]) -> None:
    """The same into an open file, some rows (n, columns) after the other."""
    file.write(f"{','.join(names)}\n".encode("latin1"))
    for rows in batches:
        np.savetxt(file, rows, delimiter=",", fmt="%.9g")
