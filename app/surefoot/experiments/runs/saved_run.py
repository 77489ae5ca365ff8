"""A run that was kept: every tick as a table, and a manifest that says what made it. As NPZ or as Parquet."""

import dataclasses
import io
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.provenance import git_commit, versions
from surefoot.experiments.runs.table_file import arrow_table, write_parquet
from surefoot.experiments.scenario.scenario import Scenario, scenario_from_table
from surefoot.output_files import write_file
from surefoot.simulation.loop import Simulation

KINDS = (".npz", ".parquet")
FORMAT = "surefoot-run-1"
SCRIPT = "script"  # of a page's run: what was done to it, see run_script
MANIFEST, TABLE, COLUMNS = "manifest", "table", "columns"


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


def scenario_of(manifest: Mapping[str, Any]) -> Scenario:
    """The scenario that a manifest tells of. Raises InvalidInput."""
    table = {key: value for key, value in manifest["scenario"].items() if key != "name" and value is not None}
    stones = table.get("stones", [])
    if isinstance(stones, list) and all(isinstance(stone, dict) for stone in stones):
        table["stones"] = [{key: value for key, value in stone.items() if key != "drops"} for stone in stones]
    return scenario_from_table(table, manifest["scenario_name"])


def npz_bytes(run: SavedRun) -> bytes:
    """The NPZ file: arrays ``table`` and ``columns``, and ``manifest`` and ``summary``, both JSON."""
    file = io.BytesIO()
    summary = json.dumps(run.manifest.get("summary", {}))
    np.savez_compressed(file, table=run.table, columns=list(run.columns), manifest=_text(run), summary=summary)
    return file.getvalue()


def parquet_bytes(run: SavedRun) -> bytes:
    """The Parquet file: a column each, the manifest as JSON in the file's own metadata."""
    file = io.BytesIO()
    write_parquet(file, _columns(run), {MANIFEST: _text(run)})
    return file.getvalue()


def arrow(run: SavedRun) -> Any:
    """The same as a ``pyarrow.Table``."""
    return arrow_table(_columns(run), {MANIFEST: _text(run)})


def run_bytes(run: SavedRun, kind: str) -> bytes:
    """The file of one of ``KINDS``."""
    return npz_bytes(run) if kind == ".npz" else parquet_bytes(run)


def write_run(run: SavedRun, path: Path) -> None:
    """Write a file of one of ``KINDS``, whole or not at all. Raises OSError."""
    write_file(path, run_bytes(run, path.suffix))


def _columns(run: SavedRun) -> dict[str, np.ndarray]:
    return {name: run.table[:, i] for i, name in enumerate(run.columns)}


def _text(run: SavedRun) -> str:
    return json.dumps(run.manifest, allow_nan=False)


def _finite(table: dict[str, Any]) -> dict[str, Any]:
    """JSON has no infinity: a stone that is still there has no time of removal."""
    return {key: None if value == float("inf") else value for key, value in table.items()}
