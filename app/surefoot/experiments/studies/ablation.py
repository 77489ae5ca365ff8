"""``surefoot ablate``: every switch of the equations, one at a time, over a fixed set of scenarios.

The scenarios were chosen before anything was run: the stones, swings and pushes of the questions the paper raises, the
pushes at 0.85 of the capture impulse of their direction.
"""

import json
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.cases import Case, run_case, toml_value
from surefoot.experiments.studies.outcomes import Outcome, OutcomeTable, outcome_of
from surefoot.output_files import write_file

DEFAULT = "two-part"
SCENARIOS = (
    "paper_figure1_stone",
    "ablation_stone_14",
    "paper_swing_35",
    "paper_swing_45",
    "ablation_swing_forward",
    "ablation_swing_slow",
    "ablation_push_forward",
    "ablation_push_left",
    "ablation_push_backward",
    "ablation_push_right",
    "stand_double",
    "ablation_double_push",
    "ablation_double_stone",
)


@dataclass(frozen=True)
class Variant:
    """One row of the table.

    Attributes:
        controller: name in the registry.
        settings: what differs from that controller's own settings: the switch, then what brings it to life.
        note: said beside the switch in place of those companions.
    """

    controller: str
    settings: tuple[tuple[str, Any], ...] = ()
    note: str = ""

    @property
    def row(self) -> str:
        """How tables call it."""
        if not self.settings:
            return self.controller
        name, value = self.settings[0]
        switch = f"{name} = {toml_value(value)}".replace('"', "") + (f" ({self.note})" if self.note else "")
        return switch if self.controller == DEFAULT else f"{self.controller}: {switch}"

    def case(self, scenario: str) -> Case:
        """The run of this variant on a scenario."""
        return Case(scenario, self.controller, tuple((f"controller.{name}", value) for name, value in self.settings))


# A switch that does nothing alone is tried together with what brings it to life
_COMPANIONS: dict[tuple[str, Any], tuple[str, tuple[tuple[str, Any], ...]]] = {
    ("tangential_term", False): ("P on the ground", (("p_point", "ground"),)),
    ("p_point", "offset"): (
        "5, 3, -8 cm from the ankle",
        (("p_offset_x_m", 0.05), ("p_offset_y_m", 0.03), ("p_offset_z_m", -0.083)),
    ),
}
_BASELINE_SWITCHES = {"latched": "optimization"}  # switches that two-part does not have
REFERENCES = (
    Variant("optimization"),  # the paper's baseline
    Variant("soft-qp"),  # a modern baseline
    Variant("soft-qp", (("guard", True),)),  # what the guard buys without the ankle law
    Variant("two-part-literal"),  # (28) as printed: all its switches at once
)


def switch_variants() -> tuple[Variant, ...]:
    """One variant for every value, other than the default, of every setting of the group ``equations``."""
    variants = []
    for field in fields(ControllerSettings):
        meta = field.metadata
        if meta.get("group") != "equations":
            continue
        values = meta["valid"] if meta["kind"] == "choice" else (not field.default,)
        for value in values:
            if value != field.default:
                note, companions = _COMPANIONS.get((field.name, value), ("", ()))
                controller = _BASELINE_SWITCHES.get(field.name, DEFAULT)
                variants.append(Variant(controller, ((field.name, value), *companions), note))
    return tuple(variants)


def all_variants() -> tuple[Variant, ...]:
    """The default, every switch, then the other controllers."""
    return (Variant(DEFAULT), *switch_variants(), *REFERENCES)


def run_variant(task: tuple[Variant, str]) -> tuple[Outcome, dict[str, Any]]:
    """One cell: how the run ended, and its summary. A run that the program refuses is an outcome too."""
    variant, scenario = task
    try:
        summary = run_case(variant.case(scenario), keep_ticks=False).summary
    except InvalidInput as error:
        return Outcome("refused", None), {"scenario": scenario, "controller": variant.controller, "refused": str(error)}
    return outcome_of(summary), summary


def run_ablation(
    variants: Sequence[Variant], scenarios: Sequence[str], workers: int
) -> Iterator[tuple[Variant, str, Outcome, dict[str, Any]]]:
    """Run every variant on every scenario; yields in order."""
    tasks = [(variant, scenario) for variant in variants for scenario in scenarios]
    if workers == 1:
        for variant, scenario in tasks:
            yield (variant, scenario, *run_variant((variant, scenario)))
        return
    with ProcessPoolExecutor(max_workers=workers) as pool:
        for (variant, scenario), found in zip(tasks, pool.map(run_variant, tasks), strict=True):
            yield (variant, scenario, *found)


def ablation_table(results: Sequence[tuple[Variant, str, Outcome, dict[str, Any]]]) -> OutcomeTable:
    """The table, columns named without their prefixes."""
    rows = list(dict.fromkeys(variant.row for variant, *_ in results))
    columns = list(dict.fromkeys(column_name(scenario) for _, scenario, *_ in results))
    cells = {(variant.row, column_name(scenario)): outcome for variant, scenario, outcome, _ in results}
    return OutcomeTable("changed setting", rows, columns, cells)


def column_name(scenario: str) -> str:
    """A scenario as a heading."""
    return scenario.removeprefix("paper_").removeprefix("ablation_").removeprefix("figure1_").replace("_", " ")


_HEAD = """\
# Ablation

Each row changes one setting of `two-part` (or of the controller named); each column is a shipped scenario. A cell says
how the run ended: the largest distance of the centre of mass from its reference for a run that stands, the time of a
fall, or that the program refused to start it. A star: in some ticks a QP had no solution.
"""


def write_ablation(results: Sequence[tuple[Variant, str, Outcome, dict[str, Any]]], out: Path) -> None:
    """Write ablation.md, .png, .svg and .json into a folder. Raises OSError."""
    from surefoot.experiments.plots.outcomes import draw_tables

    out.mkdir(parents=True, exist_ok=True)
    table = ablation_table(results)
    commands = dict.fromkeys(f"- `{variant.case(scenario).command}`" for variant, scenario, *_ in results)
    body = (_HEAD, table.markdown(), "![The same as a picture](ablation.png)", "## Commands", "\n".join(commands))
    write_file(out / "ablation.md", "\n\n".join(body) + "\n")
    rows = [{"row": variant.row, "scenario": scenario, **summary} for variant, scenario, _, summary in results]
    write_file(out / "ablation.json", json.dumps(rows, indent=1) + "\n")
    draw_tables((table,), out, "ablation", slanted=True)
