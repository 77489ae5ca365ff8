"""The tables of ``surefoot bench``: the ranking, every case, and what went beyond the capture bound."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from surefoot.cli.console import wide_console
from surefoot.experiments.bench.impulse_budget import TOLERANCE, Ledger, ledger_of
from surefoot.experiments.bench.ranking import Standing, beyond_bound, crashed, places, ranking, standings
from surefoot.experiments.bench.report import (
    INTERVALS,
    INTERVALS_OF_SHARES,
    range_text,
    score_text,
    share_text,
    threshold_text,
)
from surefoot.experiments.bench.share_table import (
    COLUMNS,
    ENDINGS,
    ENDINGS_COLUMNS,
    ENDINGS_TITLE,
    SHARES,
    TITLE,
    endings_cells,
    share_cells,
    steps_text,
)
from surefoot.experiments.bench.shares import endings, shares
from surefoot.experiments.bench.walk_pushes import (
    PUSHES_COLUMNS,
    PUSHES_TITLE,
    push_cells,
    pushes_text,
    walk_pushes,
)
from surefoot.experiments.bench.words import MARKS, threshold_number, unit_text

_ENTRIES = {
    "angular_momentum_ns": "angular momentum about G",
    "sole_ns": "sole not used",
    "foot_moved_ns": "foot moved",
    "vertical_ns": "vertical motion",
    "ends_ns": "start and end",
}
_CAUSES = {**_ENTRIES, "foot_moved_ns": "its foot slid or rolled"}


def print_ranking(rows: Sequence[Mapping[str, Any]]) -> None:
    """A line a family, a column a controller, best controller first."""
    found = standings(rows)
    order = places(found)
    if not order:
        wide_console().print(f"No level was survived by anybody: there is nothing to rank.{_nothing(found)}")
        return
    families = list(dict.fromkeys(standing.family for standing in found))
    of = {(standing.family, standing.controller): standing for standing in found}
    console = wide_console()

    table = Table("family", "unit", title="Largest survived: mean over cases (least of any case and seed)")
    goals = Table("family", title="Goals reached [95 % interval of the share]")
    compared = len(order) > 1
    for place, one in enumerate(order, 1):
        table.add_column(f"{place}. {one.controller}" if compared else one.controller, justify="right")
        goals.add_column(one.controller, justify="right")
    for family in families:
        standing = [of[family, place.controller] for place in order]
        table.add_row(family, unit_text(standing[0].unit), *map(_threshold, standing))
        if any(one.wanted for one in standing):
            goals.add_row(family, *map(_goals, standing))
    if compared:
        table.add_section()
        table.add_row("score", "", *(score_text(place.score, place.interval) for place in order))
        table.add_row("behind the first", "", "", *(score_text(p.behind, p.behind_interval) for p in order[1:]))
    console.print(table)
    if goals.row_count:
        console.print(goals)
    score = "score: threshold / best threshold of all, mean over cases, then over families. " if compared else ""
    console.print(
        f"{score}{MARKS.replace('`', '')}\ngoals: swing, every amplitude whose capture point stays inside the sole; "
        f"{_stone_goals(rows)}push, J = 0.95 J_cap.\n{INTERVALS if compared else INTERVALS_OF_SHARES}"
    )


def _nothing(found: Sequence[Standing]) -> str:
    """What the thresholds of families lie below in which nothing was survived."""
    below = {standing.family: standing for standing in found if standing.lowest_level is not None}.values()
    levels = (f"{s.family} {threshold_number(0.0, s.unit, s.lowest_level)} {unit_text(s.unit)}" for s in below)
    return "".join(f"\n{level}" for level in levels)


def _stone_goals(rows: Sequence[Mapping[str, Any]]) -> str:
    """The goals of stones that these rows have: in proportion to the robot's sole."""
    heights = {row["goal"] for row in rows if row["family"] in ("stone", "landing")}
    return "".join(f"stone and landing, {1e3 * height:g} mm; " for height in sorted(heights))


def print_cases(rows: Sequence[Mapping[str, Any]]) -> None:
    """A line a case: the median of the largest survived and its range over seeds."""
    found = standings(rows)
    order = [name for name, _ in ranking(found)] or list(dict.fromkeys(standing.controller for standing in found))
    table = Table("family", "case", "unit", *order, title="Largest survived: median (least to greatest over seeds)")
    of = {(standing.family, standing.controller): standing for standing in found}
    for family in dict.fromkeys(standing.family for standing in found):
        unit = of[family, order[0]].unit
        for case in of[family, order[0]].thresholds:
            cells = [_range(of[family, name], case) for name in order]
            table.add_row(family, case, unit_text(unit), *cells)
        table.add_section()
    wide_console().print(table)


def print_shares(rows: Sequence[Mapping[str, Any]]) -> None:
    """Of those who step: which share of the seeds is survived at each level, and what ended the others."""
    found = shares(rows)
    if not found:
        return
    entries = [asdict(share) for share in found]
    table = Table(*COLUMNS, title=escape(TITLE))
    for entry in entries:
        table.add_row(*map(escape, share_cells(entry)))
    console = wide_console()
    console.print(table)
    console.print(" ".join([SHARES, *steps_text(entries)]))


def print_walk_pushes(rows: Sequence[Mapping[str, Any]]) -> None:
    """Impulses survived while walking, by direction and controller, against J_cap1."""
    found = [asdict(entry) for entry in walk_pushes(rows)]
    if not found:
        return
    table = Table(*map(escape, PUSHES_COLUMNS), title=PUSHES_TITLE)
    for entry in found:
        table.add_row(*map(escape, push_cells(entry)))
    console = wide_console()
    console.print(table)
    console.print(escape(pushes_text(found)))


def print_endings(rows: Sequence[Mapping[str, Any]]) -> None:
    """What ended the walks and steps that failed, by family and controller."""
    found = endings(rows)
    if not found:
        return
    table = Table(*ENDINGS_COLUMNS, title=ENDINGS_TITLE)
    for entry in found:
        table.add_row(*map(escape, endings_cells(asdict(entry))))
    console = wide_console()
    console.print(table)
    console.print(ENDINGS)


def print_ledger(rows: Sequence[Mapping[str, Any]]) -> None:
    """Every push survived beyond the capture bound: why, every entry, and whether they add up."""
    beyond = beyond_bound(rows)
    if not beyond:
        return
    console = wide_console()
    console.print("[bold]Survived beyond the capture bound[/], and why [N s]")
    for row in beyond:
        ledger = ledger_of(row)
        causes = ", ".join(f"{_CAUSES[name]}: {value:+.1f} N s" for name, value in ledger.causes.items())
        entries = ", ".join(f"{words} {round(row[name], 2) + 0.0:+.2f}" for name, words in _ENTRIES.items())
        console.print(
            f"{row['controller']}, {row['family']} {row['case']}, seed {row['seed']}: eta {row['eta']:.3f}, "
            f"{causes or 'no cause found'}\n  J_cap {row['bound_ns']:.1f}, J_lin {row['linear_ns']:.1f}; excess "
            f"{row['excess_ns']:+.2f} = {entries}",
            highlight=False,
            soft_wrap=True,
        )
        if not ledger.adds_up:
            console.print(
                f"  [bold red]does not add up[/]: {_wrong(ledger)} (allowed: {100 * TOLERANCE:g} % of J_cap, "
                f"{TOLERANCE * ledger.bound_ns:.2f})",
                highlight=False,
                soft_wrap=True,
            )


def print_crashes(rows: Sequence[Mapping[str, Any]]) -> None:
    """How many episodes ended in an exception or with a controller that failed, and the first of them."""
    if crashes := crashed(rows):
        first = crashes[0]
        Console(stderr=True).print(
            f"[bold red]{len(crashes)} episodes ended in an exception[/], the first {first['controller']}, "
            f"{first['family']} {first['case']}: {escape(first['refusal'])}"
        )


def _wrong(ledger: Ledger) -> str:
    if ledger.sole_ns > TOLERANCE * ledger.bound_ns:
        return f"the ZMP lay beyond the sole for {ledger.sole_ns:.2f} N s of it"
    return f"{ledger.gap_ns:+.2f} N s of it are in no entry"


def _threshold(standing: Standing) -> str:
    at_top, lowest = bool(standing.at_top), standing.lowest_level
    return threshold_text(standing.mean, standing.worst, at_top=at_top, unit=standing.unit, lowest=lowest)


def _range(standing: Standing, case: str) -> str:
    found = standing.thresholds[case]
    return range_text(found.median, found.low, found.high, standing.unit, standing.lowest.get(case))


def _goals(standing: Standing) -> str:
    return share_text(standing.reached, standing.wanted, standing.goal_cases)
