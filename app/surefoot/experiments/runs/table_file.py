"""Raw data as CSV, or as Parquet with a few lines of text about it. Only this file knows pyarrow."""

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from surefoot.errors import one_line


def write_parquet(path: Path | BinaryIO, columns: Mapping[str, Any], about: Mapping[str, str]) -> None:
    """Write a table to a path or an open file; ``about`` goes into the file's own metadata."""
    import pyarrow.parquet as pq

    pq.write_table(arrow_table(columns, about), path, compression="zstd")


def arrow_table(columns: Mapping[str, Any], about: Mapping[str, str]) -> Any:
    """A ``pyarrow.Table``; ``about`` is its metadata."""
    import pyarrow as pa

    return pa.table(dict(columns)).replace_schema_metadata(dict(about))


def read_parquet(path: Path) -> tuple[dict[str, list[Any]], dict[str, str]]:
    """Columns and metadata of a file that ``write_parquet`` wrote. Raises OSError, or ValueError: it is none."""
    import pyarrow.parquet as pq

    try:
        table = pq.read_table(path)
        about = {key.decode(): value.decode() for key, value in (table.schema.metadata or {}).items()}
        return table.to_pydict(), about
    except OSError:
        raise
    except Exception as error:  # of a foreign file: whatever its decoder raises
        raise ValueError(one_line(error)) from None


def csv_bytes(names: Sequence[str], table: np.ndarray) -> bytes:
    """A table (n, columns) as text, nine digits of each number, their names in the first line."""
    file = io.BytesIO()
    np.savetxt(file, table, delimiter=",", header=",".join(names), comments="", fmt="%.9g")
    return file.getvalue()
