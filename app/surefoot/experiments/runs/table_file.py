"""Raw data as Parquet: columns of numbers with a few lines of text about them. Only this file knows pyarrow."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO


def write_parquet(path: Path | BinaryIO, columns: Mapping[str, Any], about: Mapping[str, str]) -> None:
    """Write a table to a path or an open file; ``about`` goes into the file's own metadata."""
    import pyarrow.parquet as pq

    pq.write_table(arrow_table(columns, about), path, compression="zstd")


def arrow_table(columns: Mapping[str, Any], about: Mapping[str, str]) -> Any:
    """A ``pyarrow.Table``; ``about`` is its metadata."""
    import pyarrow as pa

    return pa.table(dict(columns)).replace_schema_metadata(dict(about))


def read_parquet(path: Path) -> tuple[dict[str, list[Any]], dict[str, str]]:
    """Columns and metadata of a file that ``write_parquet`` wrote."""
    import pyarrow.parquet as pq

    table = pq.read_table(path)
    about = {key.decode(): value.decode() for key, value in (table.schema.metadata or {}).items()}
    return table.to_pydict(), about
