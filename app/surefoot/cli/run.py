"""What the command line prints: progress, summaries, tables. Talks to a terminal; computes nothing."""

import dataclasses
import json
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run import RunResult, run
from surefoot.experiments.runs.saved_run import SavedRun, write_run
from surefoot.experiments.scenario.references import plan_scenario
from surefoot.experiments.scenario.scenario import load_scenario, parse_change
from surefoot.experiments.studies.grid import grid_cells, markdown_tables, run_cells
from surefoot.simulation.falls import FALL_CAUSES, LIMITS

_OUT_KINDS = (".json", ".csv", ".npz", ".parquet")


def run_command(scenario: str, controller: str, *, as_json: bool, out: Path | None, changes: Sequence[str]) -> None:
    """``surefoot run``. Raises InvalidInput."""
    if out is not None and out.suffix not in _OUT_KINDS:
        raise InvalidInput("--out", str(out), "unknown kind of file", _OUT_KINDS)
    if out is not None and not out.parent.is_dir():
        raise InvalidInput("--out", str(out), "its folder does not exist")
    if out is not None and out.is_dir():
        raise InvalidInput("--out", str(out), "is a folder")
    loaded = load_scenario(scenario, dict(parse_change(text) for text in changes))
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task(f"{loaded.name} under {controller}", total=1.0)
        result = run(
            loaded, controller, clock=time.perf_counter_ns, progress=lambda done: bar.update(task, completed=done)
        )
    if out is not None:
        try:
            write_result(result, out)
        except OSError as error:
            raise InvalidInput("--out", str(out), f"cannot be written: {error.strerror}") from None
    if as_json:
        print(json.dumps(result.summary, allow_nan=False))
    else:
        print_summary(result.summary)


def plan_command(scenario: str, *, out: Path | None, changes: Sequence[str]) -> None:
    """``surefoot plan``. Raises InvalidInput, PostureError."""
    if out is not None and out.suffix != ".csv":
        raise InvalidInput("--out", str(out), "unknown kind of file", [".csv"])
    plan = plan_scenario(load_scenario(scenario, dict(parse_change(text) for text in changes)))
    table = Table("time s", "delta_P frontal N m", "delta_P sagittal N m", "ZMP x mm", "ZMP y mm", "margin mm")
    for i in range(0, len(plan.time_s), max(1, len(plan.time_s) // 24)):
        style = "red" if plan.margin_m[i] < 0.0 else None
        values = (plan.time_s[i], *plan.delta_p_in_world[i, :2], *(1e3 * plan.zmp_in_world[i]), 1e3 * plan.margin_m[i])
        table.add_row(f"{values[0]:.3f}", *(f"{value:.1f}" for value in values[1:]), style=style)
    console = Console()
    console.print(table)
    if plan.exit is None:
        console.print(f"feasible: the ZMP keeps {1e3 * plan.margin_m.min():.0f} mm from the sole's edge")
    else:
        console.print(
            f"[red]infeasible[/]: the ZMP leaves the sole over the {plan.exit.edge} edge at {plan.exit.time_s:.3f} s, "
            f"by {1e3 * plan.exit.worst_m:.0f} mm at the worst"
        )
    if out is not None:
        columns = np.column_stack((plan.time_s, plan.delta_p_in_world, plan.zmp_in_world, plan.margin_m))
        header = "time_s,delta_frontal_nm,delta_sagittal_nm,delta_vertical_nm,zmp_x_m,zmp_y_m,margin_m"
        np.savetxt(out, columns, delimiter=",", header=header, comments="", fmt="%.9g")


def grid_command(*, torque_limits: bool, workers: int, out: Path | None) -> None:
    """``surefoot grid``. Raises InvalidInput."""
    if workers < 1:
        raise InvalidInput("--workers", workers, "must be at least 1")
    if out is not None and not out.parent.is_dir():
        raise InvalidInput("--out", str(out), "its folder does not exist")
    cells = grid_cells(torque_limits=torque_limits)
    results = []
    with Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        for result in bar.track(run_cells(cells, workers), total=len(cells), description="grid"):
            results.append(result)
    if out is not None:
        rows = [{"row": cell.row, **summary} for cell, summary in results]
        out.write_text(json.dumps(rows, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    print(markdown_tables(results))


def write_result(result: RunResult, out: Path) -> None:
    """Write the summary (.json) or every tick (.csv, .npz, .parquet)."""
    if out.suffix == ".json":
        out.write_text(json.dumps(result.summary, indent=1, allow_nan=False) + "\n", encoding="utf-8")
        return
    table, columns = result.recorder.table(), result.recorder.columns
    if out.suffix == ".csv":
        np.savetxt(out, table, delimiter=",", header=",".join(columns), comments="", fmt="%.9g")
    else:
        write_run(SavedRun(tuple(columns), table, result.manifest), out)


def print_summary(summary: dict[str, Any]) -> None:
    """The same figures for a person."""
    console = Console()
    if summary["fell"]:
        verdict = f"[bold red]fell[/] at {summary['fall_time_s']:.3f} s: {FALL_CAUSES[summary['fall_cause']]}"
    else:
        verdict = f"[bold green]stands[/] after {summary['duration_s']:.3f} s"
    console.print(f"{summary['scenario']} under {summary['controller']}: {verdict}")
    table = Table(show_header=False, box=None)
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
    table.add_row(
        "speed", f"{summary['real_time_factor']:.1f} x real time, control tick {summary['tick_us_median']:.0f} us "
        f"(p99 {summary['tick_us_p99']:.0f})",
    )  # fmt: skip
    console.print(table)
    for warning in summary["warnings"]:
        console.print(f"[yellow]warning[/] {warning}")


def print_settings() -> None:
    """Every setting with its default, range and help."""
    table = Table("setting", "default", "valid", "equation", "help")
    for setting in dataclasses.fields(ControllerSettings):
        meta = setting.metadata
        if meta["kind"] == "number":
            valid = f"{meta['low']:g} to {meta['high']:g} {meta['unit']}".strip()
        else:
            valid = ", ".join(meta.get("valid", ("true", "false")))
        table.add_row(setting.name, str(setting.default), valid, meta["equation"], _help(meta))
    Console().print(table)


def _help(meta: Mapping[str, Any]) -> str:
    return f"{meta['help']}. Raised: {meta['raised']}" if meta.get("raised") else meta["help"]
