"""What ``surefoot bench`` prints: progress with the time left, the ranking, what went beyond the capture bound."""

import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import BenchRequest, plan_bench, run_bench
from surefoot.experiments.bench.formatting import (
    INTERVALS,
    range_text,
    score_text,
    share_text,
    threshold_text,
    unit_text,
)
from surefoot.experiments.bench.impulse_budget import TOLERANCE, Ledger, ledger_of
from surefoot.experiments.bench.ranking import (
    Standing,
    beyond_bound,
    crashed,
    not_adding_up,
    places,
    ranking,
    standings,
)
from surefoot.experiments.bench.report import bench_page, read_bench
from surefoot.experiments.bench.store import read_table

_WIDTH = 150
_ENTRIES = {
    "angular_momentum_ns": "angular momentum about G", "sole_ns": "sole not used", "foot_moved_ns": "foot moved",
    "vertical_ns": "vertical motion", "ends_ns": "start and end",
}  # fmt: skip
_CAUSES = {**_ENTRIES, "foot_moved_ns": "its foot slid or rolled"}


def bench_command(request: BenchRequest, *, folder: Path, workers: int, cluster: str, each_case: bool = False) -> None:
    """``surefoot bench``. Exit code 1 when a ledger does not add up. Raises InvalidInput."""
    bench = plan_bench(request)
    console = Console(stderr=True)
    with _progress(console) as bar:
        task = bar.add_task("bench", total=len(bench.cells))
        lines = _ProgressLines(console)

        def on_cell(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total)
            if not sys.stderr.isatty():
                lines.update(done, total)

        try:
            run_bench(bench, folder, workers=workers, cluster=cluster, on_cell=on_cell)
        except KeyboardInterrupt:
            bar.stop()
            console.print(f"interrupted; what is finished is in {folder}: the same command goes on from there")
            raise
    rows = read_table(folder)
    print_ranking(rows)
    if each_case:
        print_cases(rows)
    print_ledger(rows)
    if crashes := crashed(rows):
        first = crashes[0]
        console.print(
            f"[bold red]{len(crashes)} episodes ended in an exception[/], the first {first['controller']}, "
            f"{first['family']} {first['case']}: {first['refusal']}"
        )
    if not_adding_up(rows):
        raise SystemExit(1)


def _progress(console: Console) -> Progress:
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TextColumn("cells"), TimeElapsedColumn(),
        TextColumn("left"), TimeRemainingColumn(),
    )  # fmt: skip
    return Progress(*columns, console=console, disable=not sys.stderr.isatty(), speed_estimate_period=600.0)


class _ProgressLines:
    """Where there is no terminal to draw a bar on: a line for every tenth, with the time left."""

    def __init__(self, console: Console):
        self._console, self._began = console, time.monotonic()
        self._first: int | None = None
        self._tenth = -1

    def update(self, done: int, total: int) -> None:
        """Print if another tenth is done."""
        if self._first is None:
            self._first = done
        tenth = 10 * done // max(total, 1)
        if tenth == self._tenth:
            return
        self._tenth = tenth
        left = ""
        if done > self._first:
            seconds = (time.monotonic() - self._began) * (total - done) / (done - self._first)
            left = f", about {seconds / 60.0:.0f} min left" if seconds >= 90.0 else f", about {seconds:.0f} s left"
        self._console.print(f"bench: {done}/{total} cells{left}", highlight=False)


def replay_command(folder: Path, row: int, out: Path | None) -> None:
    """``surefoot bench --replay ROW``: the scenario file of one row of the table. Raises InvalidInput."""
    rows = read_table(folder)
    if not 0 <= row < len(rows):
        raise InvalidInput("--replay", row, "no such row", [f"0 to {len(rows) - 1}"])
    _hand_out(rows[row]["scenario"], out)
    if out is not None:
        print(f"surefoot run {out} --controller {rows[row]['registry_name']}", file=sys.stderr)


def report_command(folder: Path, out: Path | None) -> None:
    """``surefoot bench --report``: the page about a finished bench. Raises InvalidInput."""
    _hand_out(bench_page(*read_bench(folder)), out)


def _hand_out(text: str, out: Path | None) -> None:
    if out is None:
        print(text, end="")
        return
    try:
        out.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InvalidInput("--to", str(out), f"cannot be written: {error.strerror}") from None


def print_ranking(rows: Sequence[Mapping[str, Any]]) -> None:
    """A line a family, a column a controller, best controller first."""
    found = standings(rows)
    order = places(found)
    families = list(dict.fromkeys(standing.family for standing in found))
    of = {(standing.family, standing.controller): standing for standing in found}
    console = _console()

    table = Table("family", "unit", title="Largest survived: mean over cases (least of any case and seed)")
    goals = Table("family", title="Goals reached [95 % interval of the share]")
    for place, one in enumerate(order, 1):
        table.add_column(f"{place}. {one.controller}", justify="right")
        goals.add_column(one.controller, justify="right")
    for family in families:
        standing = [of[family, place.controller] for place in order]
        table.add_row(family, unit_text(standing[0].unit), *map(_threshold, standing))
        if any(one.wanted for one in standing):
            goals.add_row(family, *map(_goals, standing))
    table.add_section()
    table.add_row("score", "", *(score_text(place.score, place.interval) for place in order))
    table.add_row("behind the first", "", "", *(score_text(p.behind, p.behind_interval) for p in order[1:]))
    console.print(table)
    if goals.row_count:
        console.print(goals)
    console.print(
        "score: threshold / best threshold of all, mean over cases, then over families. + marks families in which some "
        "thresholds lie at the top of the ladder or where no posture reaches further.\ngoals: swing, every amplitude "
        "whose capture point stays inside the sole; stone and landing, 10 mm; push, J = 0.95 J_cap.\n" + INTERVALS
    )


def print_cases(rows: Sequence[Mapping[str, Any]]) -> None:
    """A line a case: the median of the largest survived and its range over seeds."""
    found = standings(rows)
    order = [name for name, _ in ranking(found)]
    table = Table("family", "case", "unit", *order, title="Largest survived: median (least to greatest over seeds)")
    of = {(standing.family, standing.controller): standing for standing in found}
    for family in dict.fromkeys(standing.family for standing in found):
        unit = of[family, order[0]].unit
        for case in of[family, order[0]].thresholds:
            ranges = [of[family, name].thresholds[case] for name in order]
            cells = [range_text(found.median, found.low, found.high, unit) for found in ranges]
            table.add_row(family, case, unit_text(unit), *cells)
        table.add_section()
    _console().print(table)


def print_ledger(rows: Sequence[Mapping[str, Any]]) -> None:
    """Every push survived beyond the capture bound: why, every entry, and whether they add up."""
    beyond = beyond_bound(rows)
    if not beyond:
        return
    console = _console()
    console.print("[bold]Survived beyond the capture bound[/], and why [N s]")
    for row in beyond:
        ledger = ledger_of(row)
        causes = ", ".join(f"{_CAUSES[name]}: {value:+.1f} N s" for name, value in ledger.causes.items())
        entries = ", ".join(f"{words} {row[name]:+.2f}" for name, words in _ENTRIES.items())
        console.print(
            f"{row['controller']}, {row['family']} {row['case']}, seed {row['seed']}: eta {row['eta']:.3f}, "
            f"{causes or 'no cause found'}\n  J_cap {row['bound_ns']:.1f}, J_lin {row['linear_ns']:.1f}; excess "
            f"{row['excess_ns']:+.2f} = {entries}",
            highlight=False, soft_wrap=True,
        )  # fmt: skip
        if not ledger.adds_up:
            console.print(
                f"  [bold red]does not add up[/]: {_wrong(ledger)} (allowed: {100 * TOLERANCE:g} % of J_cap, "
                f"{TOLERANCE * ledger.bound_ns:.2f})", highlight=False, soft_wrap=True,
            )  # fmt: skip


def _wrong(ledger: Ledger) -> str:
    if ledger.sole_ns > TOLERANCE * ledger.bound_ns:
        return f"the ZMP lay beyond the sole for {ledger.sole_ns:.2f} N s of it"
    return f"{ledger.gap_ns:+.2f} N s of it are in no entry"


def _console() -> Console:
    """As wide as the terminal; wide enough for the tables where there is none."""
    return Console(width=None if sys.stdout.isatty() else _WIDTH)


def _threshold(standing: Standing) -> str:
    return threshold_text(standing.mean, standing.worst, at_top=bool(standing.at_top), unit=standing.unit)


def _goals(standing: Standing) -> str:
    return share_text(standing.reached, standing.wanted, standing.goal_cases)
