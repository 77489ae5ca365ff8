"""Pushes during a walk: which impulse is survived, against J_cap1 at the instant of the push, by direction."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from surefoot.experiments.bench.statistics import median_and_range
from surefoot.experiments.bench.words import spread_text, table_header, table_line, unheld

FAMILY = "walk-push"
PUSHES_TITLE = "Pushes survived while walking, against J_cap1 at the instant of the push"
PUSHES_COLUMNS = ("push", "controller", "survived [N s]", "J_cap1 [N s]", "eta_1", "next step lands after [s]")
Spread = tuple[float, float, float]
_SEEDS = "Median over seeds (least to greatest)"


@dataclass(frozen=True, kw_only=True)
class WalkPush:
    """One controller pushed in one direction: median, least and greatest over seeds; None where nothing is known.

    Attributes:
        case, controller: which.
        survived_ns: largest impulse survived, 0 where none was [N s].
        lowest_ns: the smallest impulse played where some seed survived none: its 0 is below that [N s]; else None.
        lowest_eta_1: likewise of ``eta_1``.
        bound_ns: J_cap1 as the push begins [N s].
        eta_1: the first over the second.
        landing_s: time until the next step lands as planned [s].
        step: how far that step may go, as J_cap1 counts it; empty where nothing is known.
        at_top: of how many seeds the largest impulse played was survived.
    """

    case: str
    controller: str
    survived_ns: Spread | None
    lowest_ns: float | None
    lowest_eta_1: float | None
    bound_ns: Spread | None
    eta_1: Spread | None
    landing_s: Spread | None
    step: str
    at_top: int


def walk_pushes(rows: Sequence[Mapping[str, Any]]) -> list[WalkPush]:
    """Every direction under every controller, in the order of the table."""
    groups: dict[tuple[str, str], dict[str, list[Mapping[str, Any]]]] = {}
    for row in rows:
        if row["family"] == FAMILY:
            groups.setdefault((row["case"], row["controller"]), {}).setdefault(row["cell"], []).append(row)
    return [_walk_push(*key, list(cells.values())) for key, cells in groups.items()]


def _walk_push(case: str, controller: str, cells: Sequence[Sequence[Mapping[str, Any]]]) -> WalkPush:
    """A cell's rows share threshold and bound: until the push begins all its levels are the same run."""
    firsts = [next((row for row in rows if _is_bounded(row)), rows[0]) for rows in cells]
    bounded = [row for row in firsts if _is_bounded(row)]
    below = [(unheld(rows), row["bound_1_ns"]) for rows, row in zip(cells, firsts, strict=True)]
    reaches = [(row["step_ahead_m"], row["step_back_m"], row["step_aside_m"]) for row in bounded[:1]]
    return WalkPush(
        case=case,
        controller=controller,
        survived_ns=_spread([row["threshold"] for row in firsts]),
        lowest_ns=max((level for level, _ in below if level is not None), default=None),
        lowest_eta_1=max((level / bound for level, bound in below if level is not None and bound > 0.0), default=None),
        bound_ns=_spread([row["bound_1_ns"] for row in bounded]),
        eta_1=_spread([row["threshold"] / row["bound_1_ns"] for row in bounded if row["bound_1_ns"] > 0.0]),
        landing_s=_spread([row["step_landing_s"] for row in bounded]),
        step="".join(f"{ahead:g} m ahead, {back:g} m back or {aside:g} m aside" for ahead, back, aside in reaches),
        at_top=sum(bool(row["at_top"]) for row in firsts),
    )


def _is_bounded(row: Mapping[str, Any]) -> bool:
    return not math.isnan(row.get("bound_1_ns", math.nan))


def pushes_survived(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """The table in a bench's page; nothing to say where nobody was pushed while walking."""
    if not found:
        return []
    return [f"## {PUSHES_TITLE}", "", pushes_text(found), "", *push_lines(found), ""]


def push_lines(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """The table alone."""
    return [*table_header(*PUSHES_COLUMNS), *(table_line(*push_cells(entry)) for entry in found)]


def pushes_text(found: Sequence[Mapping[str, Any]]) -> str:
    """What the columns are."""
    reach = " or ".join(dict.fromkeys(entry["step"] for entry in found if entry["step"]))
    places = f", up to {reach} of the other foot" if reach else ""
    return (
        f"{_SEEDS}. Survived: the largest impulse of those played; `+`: the largest of all; `<`: not even the "
        "smallest. J_cap1: what the next step can catch, at its time and anywhere that a step may be planned to"
        f"{places}; an upper bound, for a foot in the air gets only so far in the time left. "
        "eta_1: the impulse survived as a share of it."
    )


def push_cells(found: Mapping[str, Any]) -> tuple[str, ...]:
    """A line: direction, controller, impulse survived, J_cap1, eta_1, landing time."""
    survived = _text(found["survived_ns"], 1, found.get("lowest_ns")) + ("+" if found["at_top"] else "")
    return (
        found["case"],
        found["controller"],
        survived,
        _text(found["bound_ns"], 1),
        _text(found["eta_1"], 2, found.get("lowest_eta_1")),
        _text(found["landing_s"], 3),
    )


def _text(spread: Sequence[float] | None, digits: int, lowest: float | None = None) -> str:
    """Median, and range where there is one; a dash where nothing is known; of 0 what it lies below, if that is said."""
    if spread is None:
        return "-"
    return spread_text(
        *(f"{value:.{digits}f}" if value or lowest is None else f"< {lowest:.{digits}f}" for value in spread)
    )


def _spread(values: Sequence[float]) -> Spread | None:
    found = median_and_range(values)
    return None if math.isnan(found.median) else (found.median, found.low, found.high)
