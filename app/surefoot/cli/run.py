"""``surefoot run``: a scenario under a controller, its summary in words, as JSON or as a file."""

import json
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tyro

if TYPE_CHECKING:
    from surefoot.experiments.runs.run import RunResult

_OUT_KINDS = (".json", ".csv", ".npz", ".parquet")


@dataclass(frozen=True)
class Run:
    """Run a scenario file headless, faster than real time, and print a summary."""

    scenario: tyro.conf.Positional[str]
    """A TOML scenario file, or the name of a shipped scenario (stand_left, stone_outer_edge, ...)."""
    controller: str = "two-part"
    """optimization, soft-qp, two-part, two-part-literal, or one that an installed package brings."""
    json: bool = False
    """Print one JSON object instead of a summary."""
    out: Path | None = None
    """Also write a file: .json the summary; .csv, .npz or .parquet every tick."""
    set: tyro.conf.UseAppendAction[tuple[str, ...]] = field(default=())
    """Change the scenario: dotted path = value, e.g. --set controller.guard=false --set stones.0.height_m=0.012."""

    def main(self) -> None:
        """Run it. Raises InvalidInput, PostureError, ControllerError."""
        from surefoot.cli.console import progress_bar
        from surefoot.experiments.runs.run import run
        from surefoot.experiments.scenario.scenario import load_scenario, parse_change
        from surefoot.output_files import check_kind, check_writable, writing

        if self.out is not None:
            check_kind(self.out, _OUT_KINDS)
            check_writable(self.out)
        scenario = load_scenario(self.scenario, dict(parse_change(text) for text in self.set))
        with progress_bar() as bar:
            task = bar.add_task(f"{scenario.name} under {self.controller}", total=1.0)
            result = run(
                scenario,
                self.controller,
                clock=time.perf_counter_ns,
                progress=lambda done: bar.update(task, completed=done),
            )
        try:
            if self.out is not None:
                with writing(self.out):
                    _write(result, self.out)
        finally:  # a full disk does not keep back what was computed
            if self.json:
                print(json.dumps(result.summary, allow_nan=False))
                for warning in result.summary["warnings"]:
                    print(f"surefoot: warning: {warning}", file=sys.stderr)
            else:
                _print_summary(result.summary)


def _write(result: "RunResult", out: Path) -> None:
    """The summary (.json) or every tick (.csv, .npz, .parquet). Raises OSError."""
    from surefoot.experiments.runs.run_writer import write_run
    from surefoot.experiments.runs.saved_run import SavedRun
    from surefoot.output_files import write_file

    if out.suffix == ".json":
        write_file(out, json.dumps(result.summary, indent=1, allow_nan=False) + "\n")
    else:
        write_run(SavedRun(tuple(result.recorder.columns), result.recorder.table(), result.manifest), out)


def _print_summary(summary: dict[str, Any]) -> None:
    """The same figures for a person."""
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from surefoot.simulation.falls import FALL_CAUSES, LIMITS

    console = Console()
    if summary["fell"]:
        outcome = f"[bold red]fell[/] at {summary['fall_time_s']:.3f} s: {FALL_CAUSES[summary['fall_cause']]}"
    else:
        outcome = f"[bold green]stands[/] after {summary['duration_s']:.3f} s"
    console.print(f"{summary['scenario']} under {summary['controller']}: {outcome}")
    table = Table(show_header=False, box=None)
    if summary["error"]:
        table.add_row("error", escape(summary["error"]))
    if summary["first_limit"]:
        table.add_row("first limit", f"{LIMITS[summary['first_limit']]}, at {summary['first_limit_time_s']:.3f} s")
    margin = summary["zmp_margin_min_m"]
    table.add_row("least ZMP margin", "-" if margin is None else f"{1e3 * margin:.1f} mm")
    error = f"{1e3 * summary['com_error_max_m']:.1f} mm at most, {1e3 * summary['com_error_final_m']:.2f} mm at the end"
    table.add_row("CoM error", error)
    infeasible = f"{summary['qp_infeasible_ticks']} ticks"
    if summary["qp_infeasible_first_s"] is not None:
        infeasible += f", first at {summary['qp_infeasible_first_s']:.3f} s"
    table.add_row("QP infeasible", f"{infeasible}; fallback {summary['fallback_ticks']} ticks")
    table.add_row("peak torques", ", ".join(f"{n}: {t:.0f}" for n, t in summary["torque_peak_nm"].items()) + " N m")
    if summary["tick_us_median"] is not None:  # there is none where the first tick failed
        tick = f"control tick {summary['tick_us_median']:.0f} us (p99 {summary['tick_us_p99']:.0f})"
        table.add_row("speed", f"{summary['real_time_factor']:.1f} x real time, {tick}")
    console.print(table)
    for warning in summary["warnings"]:
        console.print(f"[yellow]warning[/] {warning}")
