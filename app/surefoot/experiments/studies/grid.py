"""The grid: outer-edge stones and inward swings of growing size, for every controller. Where does each fall?"""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from typing import Any

from surefoot.control.registry import controllers
from surefoot.errors import SurefootError
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.simulation.physics import PhysicsSettings
from surefoot.simulation.stones import Stone

STONE_HEIGHTS_M = (0.006, 0.008, 0.010, 0.012, 0.014, 0.016)
SWING_AMPLITUDES_M = (0.02, 0.03, 0.04, 0.05)  # inward
SWING_DURATIONS_S = (0.35, 0.40, 0.50, 0.60)
LATCHED = "optimization (latched)"
_DURATION_S = 5.0


@dataclass(frozen=True)
class Cell:
    """One run of the grid.

    Attributes:
        family: ``stone`` or ``swing``.
        label: the column it stands in.
        scenario: what is simulated.
        row: the controller as the table calls it.
        controller: name in the registry.
    """

    family: str
    label: str
    scenario: Scenario
    row: str
    controller: str


def grid_scenarios(*, torque_limits: bool) -> list[tuple[str, str, Scenario]]:
    """Family, label and scenario of every column."""
    physics = PhysicsSettings(torque_limits=torque_limits)
    columns = []
    for height in STONE_HEIGHTS_M:
        stone = Stone(x_m=0.05, y_m=0.07, height_m=height, size_m=(0.06, 0.06), rise_start_s=0.5, rise_duration_s=0.3)
        name = f"stone {1e3 * height:.0f} mm"
        columns.append(("stone", name, Scenario(name=name, duration_s=_DURATION_S, stones=(stone,), physics=physics)))
    for amplitude in SWING_AMPLITUDES_M:
        for duration in SWING_DURATIONS_S:
            swing = ReferenceSpec(
                kind="swing", axis="lateral", amplitude_m=-amplitude, duration_s=duration, start_s=0.2
            )
            name = f"{1e3 * amplitude:.0f} mm {duration:.2f} s"
            columns.append(
                ("swing", name, Scenario(name=name, duration_s=_DURATION_S, reference=swing, physics=physics))
            )
    return columns


def grid_cells(*, torque_limits: bool) -> list[Cell]:
    """Every run: each controller on each scenario, the baseline latched too."""
    cells = []
    for family, label, scenario in grid_scenarios(torque_limits=torque_limits):
        for name in controllers():
            cells.append(Cell(family, label, scenario, name, name))
            if name == "optimization":
                latched = Scenario(**{**_fields(scenario), "controller": {"latched": True}})
                cells.append(Cell(family, label, latched, LATCHED, name))
    return cells


def run_cells(cells: Sequence[Cell], workers: int) -> Iterator[tuple[Cell, dict[str, Any]]]:
    """Run all cells on some processes; yields in order."""
    with ProcessPoolExecutor(max_workers=workers) as pool:
        yield from zip(cells, pool.map(run_cell, cells, chunksize=2), strict=True)


def run_cell(cell: Cell) -> dict[str, Any]:
    """The summary of one cell; ``refused`` and why where it cannot be started, which must not end the others."""
    try:
        return run(cell.scenario, cell.controller).summary
    except SurefootError as error:
        return {"controller": cell.controller, "refused": str(error)}


def outcome_text(summary: dict[str, Any]) -> str:
    """A cell of the table: ``stands``, or when it fell and what went first, or ``refused``."""
    if "refused" in summary:
        return "refused"
    if not summary["fell"]:
        return "stands"
    return f"falls {summary['fall_time_s']:.2f} s ({summary['first_limit'] or summary['fall_cause']})"


def markdown_tables(results: Sequence[tuple[Cell, dict[str, Any]]]) -> str:
    """One table a family, a line a controller."""
    text = []
    for family, title in (("stone", "Stone under the outer edge, height"), ("swing", "Inward swing")):
        labels = list(dict.fromkeys(cell.label for cell, _ in results if cell.family == family))
        rows = list(dict.fromkeys(cell.row for cell, _ in results))
        found = {(cell.row, cell.label): outcome_text(summary) for cell, summary in results}
        text.append(f"| {title} | {' | '.join(label.removeprefix('stone ') for label in labels)} | stands |")
        text.append("|---" * (len(labels) + 2) + "|")
        for row in rows:
            outcomes = [found[row, label] for label in labels]
            text.append(f"| {row} | {' | '.join(outcomes)} | {outcomes.count('stands')}/{len(labels)} |")
        text.append("")
    text += [f"refused: {reason}" for reason in dict.fromkeys(s["refused"] for _, s in results if "refused" in s)]
    return "\n".join(text)


def _fields(scenario: Scenario) -> dict[str, Any]:
    return {name: getattr(scenario, name) for name in scenario.__dataclass_fields__}
