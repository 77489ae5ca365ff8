"""A run that was kept: every tick as a table, and a manifest that says what made it."""

import dataclasses
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.provenance import git_commit, versions
from surefoot.experiments.runs.saved_walk import FOOTSTEPS, footsteps_entry
from surefoot.experiments.runs.table_file import arrow_table
from surefoot.experiments.scenario.scenario import Scenario, scenario_from_table
from surefoot.gait.walk import Walk
from surefoot.simulation.loop import Simulation
from surefoot.simulation.model_error import MODEL_ERROR_PRESETS
from surefoot.simulation.motors import MOTOR_PRESETS
from surefoot.simulation.sensors.settings import SENSOR_PRESETS

KINDS = (".npz", ".parquet")
FORMAT = "surefoot-run-1"
SCRIPT = "script"  # of a page's run: what was done to it, see run_script
INTERRUPTED = "interrupted_s"  # only in the manifest of a run that was stopped before its end: its last time
ROBOT_SHA256 = "robot_sha256"  # of the files that decide the robot's physics: ``RobotDescription.sha256``
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

    @property
    def rows(self) -> int:
        """Ticks."""
        return len(self.table)

    @property
    def dtype(self) -> np.dtype:
        """Of the numbers."""
        return self.table.dtype

    def batches(self) -> Iterator[np.ndarray]:
        """The rows for whoever takes them some at a time: all of them are here."""
        yield self.table

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
    ground, walk = simulation.plant.ground, simulation.gait
    return {
        "format": FORMAT,
        "scenario_name": scenario.name,
        "scenario": scenario_table(scenario),
        "controller": controller,
        "settings": dataclasses.asdict(settings),
        "support": str(scenario.support),
        "robot": scenario.robot,
        ROBOT_SHA256: simulation.robot.sha256,
        "git_commit": git_commit(),
        "versions": versions(),
        "stones": [_finite(dataclasses.asdict(placed)) for placed in simulation.plant.stones.history],
        "ground": {
            "ground": dataclasses.asdict(ground.ground),
            "pivot_m": ground.pivot.tolist(),
            "tilts": [dataclasses.asdict(tilt) for tilt in ground.tilts],
        },
        "terrain": {
            "depth_m": simulation.plant.terrain.depth_m,
            "blocks": [dataclasses.astuple(block) for block in simulation.plant.terrain.blocks],
        },
        **({FOOTSTEPS: footsteps_entry(walk)} if isinstance(walk, Walk) else {}),
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
    return scenario_from_table(table, manifest["scenario_name"], robot_files=True)


def arrow(run: SavedRun) -> Any:
    """The run as a ``pyarrow.Table``: a column each, the manifest as JSON in its metadata."""
    columns = {name: run.table[:, i] for i, name in enumerate(run.columns)}
    return arrow_table(columns, {MANIFEST: manifest_text(run.manifest)})


def manifest_text(manifest: Mapping[str, Any]) -> str:
    """A manifest as its file has it."""
    return json.dumps(manifest, allow_nan=False)


def parse_manifest(text: str) -> dict[str, Any]:
    """The manifest that a file has. Raises ValueError."""
    manifest = json.loads(text, parse_constant=_no_number)
    if not isinstance(manifest, dict) or manifest.get("format") != FORMAT:
        raise ValueError(f"its manifest does not say format {FORMAT!r}")
    return manifest


def interruption(manifest: Mapping[str, Any]) -> str | None:
    """One line about a run that was stopped before its end; None for all others."""
    time_s = manifest.get(INTERRUPTED)
    return None if time_s is None else f"this run was interrupted at t = {time_s:.3f} s; its record ends there"


def imperfection_note(manifest: Mapping[str, Any]) -> str | None:
    """One line about sensors, estimator, motors and errors of the model; None for a run that had none of them."""
    scenario, usual = manifest["scenario"], {"preset": "perfect", "kind": "truth"}
    presets = {"sensors": SENSOR_PRESETS, "motors": MOTOR_PRESETS, "model_error": MODEL_ERROR_PRESETS}
    words, imperfect = [], False
    for table, key in (("sensors", "preset"), ("estimator", "kind"), ("motors", "preset"), ("model_error", "preset")):
        said = scenario.get(table) or {}  # older files say nothing of them
        chosen = said.get(key, usual[key])
        figures = presets.get(table, {}).get(chosen, {})
        changed = any(said.get(name, figure) != figure for name, figure in figures.items())
        words.append(f"{table.replace('_', ' ')} {chosen}{' (changed)' if changed else ''}")
        imperfect |= changed or chosen != usual[key]
    return ", ".join(words) if imperfect else None


def _no_number(name: str) -> None:
    raise ValueError(f"{name} in its manifest")


def _finite(table: dict[str, Any]) -> dict[str, Any]:
    """JSON has no infinity: a stone that is still there has no time of removal."""
    return {key: None if value == float("inf") else value for key, value in table.items()}
