"""Opens a saved run. The file may come from anywhere: what is opened here can be drawn, converted and run again."""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.errors import InvalidInput, one_line
from surefoot.experiments.runs.partial_file import PARTIAL, PartialRun
from surefoot.experiments.runs.saved_run import COLUMNS, INTERRUPTED, MANIFEST, TABLE, SavedRun, parse_manifest
from surefoot.experiments.runs.saved_world import SavedWorld
from surefoot.experiments.runs.table_file import read_parquet_numbers

_LONGEST_S = 1e6  # no run is longer; a time beyond would not fit into the formats that count nanoseconds
_ENTRIES: Mapping[str, type] = {
    **dict.fromkeys(("scenario_name", "controller", "support", "robot"), str),
    **dict.fromkeys(("scenario", "settings", "versions", "ground", "summary"), dict),
    **dict.fromkeys(("stones", "events"), list),
}


def read_run(path: Path) -> SavedRun:
    """Open a file that ``write_run`` or the page wrote, or that an interrupted run left. Raises InvalidInput."""
    if path.suffix not in _READERS:
        raise InvalidInput("file", str(path), "unknown kind of file", _READERS)
    try:
        run = _READERS[path.suffix](path)
        _check(run)
    except InvalidInput as error:
        raise InvalidInput("file", str(path), f"is no saved run: {error}") from None
    except OSError as error:
        reason = f"cannot be read: {error.strerror or one_line(error)}"
        raise InvalidInput("file", str(path), f"{reason}{_left_over(path)}") from None
    except Exception as error:  # a foreign file makes its decoder raise anything: cut, packed, nested, too large
        raise InvalidInput("file", str(path), f"is no saved run: {one_line(error)}") from None
    return run


def _read_npz(path: Path) -> SavedRun:
    with np.load(path, allow_pickle=False) as file:
        if not isinstance(file, np.lib.npyio.NpzFile) or MANIFEST not in file:
            raise ValueError("it has no manifest")
        columns = tuple(str(name) for name in file[COLUMNS])
        return SavedRun(columns, file[TABLE], parse_manifest(str(file[MANIFEST])))


def _read_parquet(path: Path) -> SavedRun:
    columns, table, about = read_parquet_numbers(path)
    if MANIFEST not in about:
        raise ValueError("it has no manifest")
    return SavedRun(columns, table, parse_manifest(about[MANIFEST]))


def _read_partial(path: Path) -> SavedRun:
    left = PartialRun(path)
    return SavedRun(left.columns, np.concatenate(list(left.batches())), left.manifest)


_READERS: Mapping[str, Callable[[Path], SavedRun]] = {
    ".npz": _read_npz,
    ".parquet": _read_parquet,
    PARTIAL: _read_partial,
}


def _left_over(path: Path) -> str:
    """Where to look for the ticks of a run that was killed before its file was made."""
    left = path.with_name(f"{path.name}{PARTIAL}")
    return f"; {left} is what an interrupted run left" if not path.exists() and left.exists() else ""


def _check(run: SavedRun) -> None:
    """Raises ValueError, or InvalidInput of what the manifest tells to build."""
    for name, kind in _ENTRIES.items():
        if not isinstance(run.manifest.get(name), kind):
            raise ValueError(f"manifest.{name} is missing, or not a {kind.__name__}")
    table = run.table
    if table.ndim != 2 or table.dtype.kind != "f" or table.shape[1] != len(run.columns) or len(table) == 0:
        raise ValueError(f"its table of shape {table.shape}, {table.dtype} has not a number for each of its columns")
    if len(set(run.columns)) != len(run.columns):
        raise ValueError("two columns have one name")
    time_s = run.column("time_s")
    if not (np.isfinite(time_s).all() and (np.diff(time_s) > 0.0).all() and abs(time_s[[0, -1]]).max() < _LONGEST_S):
        raise ValueError("time_s does not go on from row to row")
    posture = [i for i, name in enumerate(run.columns) if name.startswith(("pelvis_", "angle_"))]
    if not np.isfinite(table[:, posture]).all():
        raise ValueError("a posture in it is no number")
    turned = [i for i, name in enumerate(run.columns) if name.startswith("pelvis_q")]
    if turned and not np.allclose(np.linalg.norm(table[:, turned], axis=1), 1.0, atol=1e-3):
        raise ValueError("an orientation in it is none: its quaternion is not of length 1")
    interrupted_s = run.manifest.get(INTERRUPTED)
    if interrupted_s is not None and not _is_time(interrupted_s):
        raise ValueError(f"manifest.{INTERRUPTED} is no time")
    for event in run.manifest["events"]:
        if not _is_event(event):
            raise ValueError(f"{event!r:.60} is no event: time, kind, text")
    SavedWorld(run)


def _is_event(event: Any) -> bool:
    if not (isinstance(event, list) and len(event) == 3 and all(isinstance(text, str) for text in event[1:])):
        return False
    return _is_time(event[0])


def _is_time(time_s: Any) -> bool:
    return isinstance(time_s, int | float) and math.isfinite(time_s) and abs(time_s) < _LONGEST_S
