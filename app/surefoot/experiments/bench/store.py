"""Finished cells on disk: one small file each, written whole or not at all; merged into one table at the end.

A cell's file is named by its key, which covers everything that decides its outcome. So a bench that was interrupted, by
Ctrl-C, SIGKILL or a power cut, goes on where it stopped, and cells of older code are never mixed in. The table holds
its cells whole: where only that was kept, in a repository say, a bench with more seeds or controllers goes on from it.
"""

import io
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput, one_line
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.runs.table_file import read_parquet, write_parquet
from surefoot.output_files import check_folder, write_file, writing

TABLE = "bench.parquet"
MANIFEST = "manifest.json"
RANKING = "ranking.json"
_CELLS = "cells"
_NEEDED = {"cell", "controller", "family", "case", "seed", "level", "threshold", "survived", "outcome", "scenario"}


class BenchStore:
    """The folder of one bench.

    Args:
        folder: made if need be.

    Raises:
        InvalidInput: it cannot be made or written, or what is called like a bench's table there is none.
    """

    def __init__(self, folder: Path):
        self.folder = folder
        check_folder(folder / _CELLS)
        if (folder / TABLE).is_file():
            self._unpack_table()

    def missing(self, cells: Sequence[Cell]) -> list[Cell]:
        """Those not yet finished, in order."""
        done = self._finished()
        return [cell for cell in cells if cell.key not in done]

    def add(self, cell: Cell, rows: Sequence[Mapping[str, Any]]) -> None:
        """Keep a finished cell."""
        self._keep(cell.key, rows)

    def rows(self, cells: Sequence[Cell]) -> list[dict[str, Any]]:
        """All rows of these finished cells, in the order of the cells."""
        found = []
        for cell in cells:
            for row in self._read(cell.key):
                found.append({key: math.nan if value is None else value for key, value in row.items()})
        return found

    def write_ranking(self, ranking: Mapping[str, Any]) -> None:
        """What the table says, in short."""
        _write(self.folder / RANKING, json.dumps(ranking, indent=1, allow_nan=False) + "\n")

    def write_manifest(self, manifest: Mapping[str, Any]) -> None:
        """What made the table."""
        _write(self.folder / MANIFEST, json.dumps(manifest, indent=1, default=str) + "\n")

    def write_table(self, cells: Sequence[Cell], about: Mapping[str, str]) -> Path:
        """Merge the cells into one Parquet table, one row an episode."""
        rows = self.rows(cells)
        file = self.folder / TABLE
        content = io.BytesIO()
        columns = dict.fromkeys(key for row in rows for key in row)  # a walk has more of them, all of numbers
        write_parquet(content, {key: [row.get(key, math.nan) for row in rows] for key in columns}, about)
        with writing(file):
            write_file(file, content.getvalue())
        return file

    def _unpack_table(self) -> None:
        """Make files of the cells that are known from the table alone."""
        cells: dict[str, list[dict[str, Any]]] = {}
        for row in read_table(self.folder):
            cells.setdefault(str(row["cell"]), []).append(row)
        for key in cells.keys() - self._finished():
            self._keep(key, cells[key])

    def _finished(self) -> set[str]:
        return {file.stem for file in (self.folder / _CELLS).glob("*.json")}

    def _keep(self, key: str, rows: Sequence[Mapping[str, Any]]) -> None:
        _write(self._file(key), json.dumps([_without_nan(row) for row in rows], allow_nan=False))

    def _read(self, key: str) -> list[dict[str, Any]]:
        try:
            return json.loads(self._file(key).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise InvalidInput("--out", str(self._file(key)), f"cannot be read: {error}; remove it") from None

    def _file(self, key: str) -> Path:
        return self.folder / _CELLS / f"{key}.json"


def read_table(folder: Path) -> list[dict[str, Any]]:
    """The rows of a finished bench. Raises InvalidInput."""
    file = folder / TABLE
    if not file.is_file():
        raise InvalidInput("--out", str(folder), f"holds no finished bench: there is no {TABLE}")
    try:
        columns, _ = read_parquet(file)
    except (OSError, ValueError) as error:
        raise InvalidInput("--out", str(file), f"cannot be read: {error}; move it away") from None
    if not _NEEDED <= columns.keys():
        raise InvalidInput("--out", str(file), "is no table of a bench; move it away")
    return [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]


def read_json(folder: Path, name: str, flag: str = "--out") -> dict[str, Any]:
    """Ranking or manifest of a finished bench. Raises InvalidInput."""
    try:
        found = json.loads((folder / name).read_text(encoding="utf-8-sig"))
    except (OSError, ValueError, RecursionError) as error:
        raise InvalidInput(flag, str(folder), f"holds no finished bench: {name}: {one_line(error)}") from None
    if not isinstance(found, dict):
        raise InvalidInput(flag, str(folder), f"holds no finished bench: {name}: is no JSON object")
    return found


def read_manifest(folder: Path, flag: str = "--out") -> dict[str, Any]:
    """What made the table; empty where it was not kept. Raises InvalidInput."""
    return read_json(folder, MANIFEST, flag) if (folder / MANIFEST).is_file() else {}


def _without_nan(row: Mapping[str, Any]) -> dict[str, Any]:
    """JSON has no NaN."""
    return {key: None if isinstance(value, float) and not math.isfinite(value) else value for key, value in row.items()}


def _write(file: Path, text: str) -> None:
    """Raises InvalidInput: the disk is full, or the folder has gone."""
    with writing(file):
        write_file(file, text)
