"""``surefoot plan``: whether a swing is feasible, before anything is simulated."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import tyro

if TYPE_CHECKING:
    from surefoot.control.balance_plan import BalancePlan

_ROWS = 24  # about as many as fit on a screen


@dataclass(frozen=True)
class Plan:
    """Plan a scenario's swing: delta_P and ZMP over time, and where that ZMP leaves the sole. Nothing is simulated."""

    scenario: tyro.conf.Positional[str]
    """A TOML scenario file, or the name of a shipped scenario."""
    out: Path | None = None
    """Also write the plan as .csv."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change the scenario, e.g. --set reference.amplitude_m=-0.02."""

    def main(self) -> None:
        """Plan it. Raises InvalidInput, PostureError."""
        from surefoot.experiments.scenario.references import plan_scenario
        from surefoot.experiments.scenario.scenario import load_scenario, parse_change
        from surefoot.output_files import check_kind, check_writable, write_file, writing

        if self.out is not None:
            check_kind(self.out, [".csv"])
            check_writable(self.out)
        plan = plan_scenario(
            load_scenario(self.scenario, dict(parse_change(text) for text in self.set), robot_files=True)
        )
        try:
            if self.out is not None:
                with writing(self.out):
                    write_file(self.out, _csv(plan))
        finally:
            _print_plan(plan)


def _print_plan(plan: "BalancePlan") -> None:
    """The plan as a table, and whether it is feasible."""
    from rich.console import Console
    from rich.table import Table

    table = Table("time s", "delta_P frontal N m", "delta_P sagittal N m", "ZMP x mm", "ZMP y mm", "margin mm")
    for i in range(0, len(plan.time_s), max(1, len(plan.time_s) // _ROWS)):
        style = "red" if plan.margin_m[i] < 0.0 else None
        values = (*plan.delta_p_in_world[i, :2], *(1e3 * plan.zmp_in_world[i]), 1e3 * plan.margin_m[i])
        table.add_row(f"{plan.time_s[i]:.3f}", *(f"{value:.1f}" for value in values), style=style)
    console = Console()
    console.print(table)
    if plan.exit is None:
        console.print(f"feasible: the ZMP keeps {1e3 * plan.margin_m.min():.0f} mm from the sole's edge")
    else:
        console.print(
            f"[red]infeasible[/]: the ZMP leaves the sole over the {plan.exit.edge} edge at {plan.exit.time_s:.3f} s, "
            f"by {1e3 * plan.exit.worst_m:.0f} mm at the worst"
        )


def _csv(plan: "BalancePlan") -> bytes:
    import numpy as np

    from surefoot.experiments.runs.table_file import csv_bytes

    columns = np.column_stack((plan.time_s, plan.delta_p_in_world, plan.zmp_in_world, plan.margin_m))
    delta = ("delta_frontal_nm", "delta_sagittal_nm", "delta_vertical_nm")
    return csv_bytes(("time_s", *delta, "zmp_x_m", "zmp_y_m", "margin_m"), columns)
