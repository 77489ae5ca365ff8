"""Opens a saved run. The file may come from anywhere: what is opened here can be drawn, converted and run again."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.errors import InvalidInput, one_line
from surefoot.experiments.runs.saved_run import COLUMNS, FORMAT, KINDS, MANIFEST, TABLE, SavedRun
from surefoot.experiments.runs.saved_world import SavedWorld
from surefoot.experiments.runs.table_file import read_parquet

_LONGEST_S = 1e6  # no run is longer; a time beyond would not fit into the formats that count nanoseconds
_ENTRIES: Mapping[str, type] = {
    **dict.fromkeys(("scenario_name", "controller", "support", "robot"), str),
    **dict.fromkeys(("scenario", "settings", "versions", "ground", "summary"), dict),
    **dict.fromkeys(("stones", "events"), list),
}


def read_run(path: Path) -> SavedRun:
    """Open a file that ``write_run`` or the page wrote. Raises InvalidInput."""
    if path.suffix not in KINDS:
        raise InvalidInput("file", str(path), "unknown kind of file", KINDS)
    try:
        run = _read_npz(path) if path.suffix == ".npz" else _read_parquet(path)
        _check(run)
    except InvalidInput as error:
        raise InvalidInput("file", str(path), f"is no saved run: {error}") from None
    except OSError as error:
        raise InvalidInput("file", str(path), f"cannot be read: {error.strerror or one_line(error)}") from None
    except Exception as error:  # a foreign file makes its decoder raise anything: cut, packed, nested, too large
        raise InvalidInput("file", str(path), f"is no saved run: {one_line(error)}") from None
    return run


def _read_npz(path: Path) -> SavedRun:
    with np.load(path, allow_pickle=False) as file:
        if not isinstance(file, np.lib.npyio.NpzFile) or MANIFEST not in file:
            raise ValueError("it has no manifest")
        columns = tuple(str(name) for name in file[COLUMNS])
        return SavedRun(columns, file[TABLE], _manifest(str(file[MANIFEST])))


def _read_parquet(path: Path) -> SavedRun:
    columns, about = read_parquet(path)
    if MANIFEST not in about:
        raise ValueError("it has no manifest")
    return SavedRun(tuple(columns), np.column_stack(list(columns.values())), _manifest(about[MANIFEST]))


def _manifest(text: str) -> dict[str, Any]:
    manifest = json.loads(text, parse_constant=_no_number)
    if not isinstance(manifest, dict) or manifest.get("format") != FORMAT:
        raise ValueError(f"its manifest does not say format {FORMAT!r}")
    return manifest


def _no_number(name: str) -> None:
    raise ValueError(f"{name} in its manifest")


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
    for event in run.manifest["events"]:
        if not _is_event(event):
            raise ValueError(f"{event!r:.60} is no event: time, kind, text")
    SavedWorld(run)


def _is_event(event: Any) -> bool:
    if not (isinstance(event, list) and len(event) == 3 and all(isinstance(text, str) for text in event[1:])):
        return False
    return isinstance(event[0], int | float) and math.isfinite(event[0]) and abs(event[0]) < _LONGEST_S
