"""A run that was kept: every tick as a table, and a manifest that says what made it. As NPZ or as Parquet."""

import dataclasses
import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.provenance import git_commit, versions
from surefoot.experiments.runs.table_file import arrow_table, read_parquet, write_parquet
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.simulation.loop import Simulation

KINDS = (".npz", ".parquet")
FORMAT = "surefoot-run-1"
_MANIFEST, _TABLE, _COLUMNS = "manifest", "table", "columns"


@dataclass(frozen=True, eq=False)
class SavedRun:
    """A run as data: nothing in it refers to the simulation it came from.

    Attributes:
        columns: names of the table's columns.
        table: (ticks, columns), oldest first.
        manifest: what made it: scenario, controller, settings, stones, ground, events, commit, versions.
    """

    columns: tuple[str, ...]
    table: np.ndarray
    manifest: Mapping[str, Any]

    def column(self, name: str) -> np.ndarray:
        """One column (ticks,). Raises InvalidInput."""
        if name not in self.columns:
            raise InvalidInput("column", name, "is not in the file", self.columns)
        return self.table[:, self.columns.index(name)]


def describe_run(
    simulation: Simulation,
    scenario: Scenario,
    controller: str,
    settings: ControllerSettings,
    events: tuple[tuple[float, str, str], ...] = (),
    summary: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The manifest: what made a run, in plain values.

    Args:
        simulation: what ran.
        scenario: what it was told to do.
        controller: name of the active one.
        settings: of that.
        events: time [s], kind and text, oldest first.
        summary: of a headless run.
    """
    ground = simulation.plant.ground
    return {
        "format": FORMAT,
        "scenario_name": scenario.name,
        "scenario": scenario_table(scenario),
        "controller": controller,
        "settings": dataclasses.asdict(settings),
        "support": str(scenario.support),
        "robot": scenario.robot,
        "git_commit": git_commit(),
        "versions": versions(),
        "stones": [_finite(dataclasses.asdict(placed)) for placed in simulation.plant.stones.history],
        "ground": {
            "ground": dataclasses.asdict(ground.ground),
            "pivot_m": ground.pivot.tolist(),
            "tilts": [dataclasses.asdict(tilt) for tilt in ground.tilts],
        },
        "events": [list(event) for event in events],
        "summary": dict(summary or {}),
    }


def scenario_table(scenario: Scenario) -> dict[str, Any]:
    """A scenario as the table of its file."""
    table = dataclasses.asdict(scenario)
    table["support"] = str(scenario.support)
    return table


def npz_bytes(run: SavedRun) -> bytes:
    """The NPZ file: arrays ``table`` and ``columns``, and ``manifest`` and ``summary``, both JSON."""
    file = io.BytesIO()
    summary = json.dumps(run.manifest.get("summary", {}))
    np.savez_compressed(file, table=run.table, columns=list(run.columns), manifest=_text(run), summary=summary)
    return file.getvalue()


def parquet_bytes(run: SavedRun) -> bytes:
    """The Parquet file: a column each, the manifest as JSON in the file's own metadata."""
    file = io.BytesIO()
    write_parquet(file, _columns(run), {_MANIFEST: _text(run)})
    return file.getvalue()


def arrow(run: SavedRun) -> Any:
    """The same as a ``pyarrow.Table``."""
    return arrow_table(_columns(run), {_MANIFEST: _text(run)})


def write_run(run: SavedRun, path: Path) -> None:
    """Write a file of one of ``KINDS``. Raises OSError."""
    path.write_bytes(npz_bytes(run) if path.suffix == ".npz" else parquet_bytes(run))


def read_run(path: Path) -> SavedRun:
    """Open a file that ``write_run`` or the page wrote. Raises InvalidInput."""
    if path.suffix not in KINDS:
        raise InvalidInput("file", str(path), "unknown kind of file", KINDS)
    try:
        run = _read_npz(path) if path.suffix == ".npz" else _read_parquet(path)
    except OSError as error:
        raise InvalidInput("file", str(path), f"cannot be read: {error.strerror or error}") from None
    except (KeyError, ValueError, zipfile.BadZipFile) as error:
        raise InvalidInput("file", str(path), f"is no saved run: {error}") from None
    if run.manifest.get("format") != FORMAT or run.table.ndim != 2 or len(run.table) == 0:
        raise InvalidInput("file", str(path), "holds no run that can be replayed", [f"manifest.format = {FORMAT!r}"])
    return run


def _read_npz(path: Path) -> SavedRun:
    with np.load(path, allow_pickle=False) as file:
        if _MANIFEST not in file:
            raise KeyError("it has no manifest: written before runs could be replayed")
        columns = tuple(str(name) for name in file[_COLUMNS])
        return SavedRun(columns, file[_TABLE], json.loads(str(file[_MANIFEST])))


def _read_parquet(path: Path) -> SavedRun:
    columns, about = read_parquet(path)
    if _MANIFEST not in about:
        raise KeyError("it has no manifest")
    return SavedRun(tuple(columns), np.column_stack(list(columns.values())), json.loads(about[_MANIFEST]))


def _columns(run: SavedRun) -> dict[str, np.ndarray]:
    return {name: run.table[:, i] for i, name in enumerate(run.columns)}


def _text(run: SavedRun) -> str:
    return json.dumps(run.manifest, allow_nan=False)


def _finite(table: dict[str, Any]) -> dict[str, Any]:
    """JSON has no infinity: a stone that is still there has no time of removal."""
    return {key: None if value == float("inf") else value for key, value in table.items()}
