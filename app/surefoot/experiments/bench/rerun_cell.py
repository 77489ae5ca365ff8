"""Make one cell of a finished bench again, from its manifest and table."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import BenchRequest, plan_bench
from surefoot.experiments.bench.cell_runner import run_cell
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.price.plan import ABOUT, plan_again
from surefoot.experiments.scenario.robots import is_robot_file
from surefoot.experiments.scenario.scenario_text import scenario_text
from surefoot.field_metadata import from_mapping
from surefoot.text_files import toml_of

_NOT_COMPARED = ("cell",)  # the key covers the code: another commit may well give the same result
_WHICH = ("family", "case", "controller", "seed")


def rerun_cell(key: str, rows: Sequence[Mapping[str, Any]], manifest: Mapping[str, Any]) -> str | None:
    """Where the rows of a cell come out different; None where they do not.

    Args:
        key: of the cell.
        rows: of the table.
        manifest: of the bench.

    Raises:
        InvalidInput: the manifest does not tell how the cell was made.
    """
    kept = [row for row in rows if row["cell"] == key]
    again = run_cell(_cell_of(kept[0], manifest))
    if len(again) != len(kept):
        return f"{len(again)} episodes instead of {len(kept)}"
    for then, now in zip(kept, again, strict=True):
        for name in then:
            if name in now and name not in _NOT_COMPARED and not _same(then[name], now[name]):
                return f"{name} {then[name]!r:.80} -> {now[name]!r:.80} at level {then['level']:g} {then['unit']}"
    return None


def scenario_of_row(row: Mapping[str, Any], manifest: Mapping[str, Any]) -> str:
    """The scenario file of a row; a robot's file is named by its whole path, where the bench was told that it lies.

    Raises:
        InvalidInput: it is no scenario file.
    """
    table = toml_of(row["scenario"], "scenario", "of this row")
    robot = str(manifest.get("arguments", {}).get("robot", ""))
    if not is_robot_file(table.get("robot")) or not is_robot_file(robot):
        return row["scenario"]
    comment = "\n".join(line[2:] for line in row["scenario"].splitlines() if line.startswith("# "))
    return scenario_text({**table, "robot": str(Path(robot).resolve())}, comment)


def _cell_of(row: Mapping[str, Any], manifest: Mapping[str, Any]) -> Cell:
    """Raises InvalidInput."""
    wanted = tuple(row[name] for name in _WHICH)
    try:
        cells = plan_again(row, manifest) if ABOUT in manifest else _cells_asked_for(row, manifest)
    except (TypeError, ValueError, KeyError, AttributeError) as error:
        raise InvalidInput("manifest.json", f"{error}", "does not say what the bench was asked for") from None
    for cell in cells:
        if (cell.case.family, cell.case.name, cell.label, cell.seed) == wanted:
            return cell
    raise InvalidInput("row", ", ".join(map(str, wanted)), "is no cell of what the manifest says was asked for")


def _cells_asked_for(row: Mapping[str, Any], manifest: Mapping[str, Any]) -> Sequence[Cell]:
    """Of this controller only: the others need not be installed."""
    arguments = manifest.get("arguments")
    if not isinstance(arguments, dict):
        raise InvalidInput("manifest.json", arguments, "does not say what the bench was asked for")
    plain = {key: tuple(value) if isinstance(value, list) else value for key, value in arguments.items()}
    request = from_mapping(BenchRequest, {**plain, "controllers": row["controller"]}, "manifest.arguments")
    return plan_bench(request).cells


def _same(then: Any, now: Any) -> bool:
    both_nan = isinstance(then, float) and isinstance(now, float) and math.isnan(then) and math.isnan(now)
    return both_nan or then == now
