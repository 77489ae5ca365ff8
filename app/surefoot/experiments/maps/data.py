"""From a bench to what a map shows: which cells are needed, and one threshold for each from the rows of its table."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from typing import Any

from surefoot.experiments.bench.bench import Bench, BenchRequest, cell_of, code_of
from surefoot.experiments.bench.entries import bench_entries
from surefoot.experiments.bench.families import cases, coarse_levels
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.scenario.robots import check_robot

MAPPED = ("stone", "push", "push-double", "swing")
QUICK_CONTROLLERS = "two-part,soft-qp"
_QUICK_FAMILIES = ("stone", "push", "swing")
_QUICK_SWINGS = tuple(f"{word} {duration} s" for word in ("inward", "forward") for duration in ("0.3", "0.5", "1.0"))


def plan_maps(controllers: str = "", *, quick: bool = False, robot: str = BIP) -> Bench:
    """Every place, direction and duration under each controller, on the bench's coarse ladders.

    Quick: two controllers unless told, single support, and swings inward and forward at three durations.

    Args:
        controllers: comma-separated, as ``surefoot bench`` takes them; empty for all registered ones.
        quick: fewer cells.
        robot: its name, or the path of its file from the working folder.

    Raises:
        InvalidInput: unknown controller, setting or robot.
    """
    entries = bench_entries(controllers or (QUICK_CONTROLLERS if quick else ""), {})
    families = _QUICK_FAMILIES if quick else MAPPED
    every = cases(families, robot=check_robot(robot, files=True, folder=Path()))
    wanted = [replace(case, levels=coarse_levels(case)) for case in every]
    if quick:
        wanted = [case for case in wanted if case.family != "swing" or case.name in _QUICK_SWINGS]
    code = code_of(entries, robot)
    cells = [cell_of(case, one, 0, code[one.label]) for case in wanted for one in entries]
    request = BenchRequest(controllers=controllers, families=families, quick=True, robot=robot)
    return Bench(request=request, entries=entries, cells=tuple(cells))


@dataclass(frozen=True)
class Spot:
    """One case under one controller, all seeds together.

    Attributes:
        case: its name in the family.
        threshold: largest level survived, the median over seeds; NaN when nothing could be started.
        at_top: the threshold may well be higher (the ladder ends, or no posture reaches further).
        levels: every level that was played, with its outcome (the worst of all seeds).
        place: where it stands on its map: (x, y) of a stone [m], (direction [deg], J_cap [N s]) of a push,
            (duration [s], sign) of a swing.
        axis: of a swing.
        support: ``left``, ``right`` or ``double``.
    """

    case: str
    threshold: float
    at_top: bool
    levels: tuple[tuple[float, str], ...]
    place: tuple[float, float]
    axis: str
    support: str

    @property
    def lowest(self) -> float | None:
        """What a threshold of 0 lies below, the lowest level played; None where a level is survived."""
        played = (level for level, outcome in self.levels if outcome != "refused")
        return next(played, None) if self.threshold == 0.0 else None


def spots(rows: Sequence[Mapping[str, Any]], family: str) -> dict[str, list[Spot]]:
    """Controller -> its spots in a family, in the table's order; empty when the table has none."""
    grouped: dict[str, dict[str, list[Mapping[str, Any]]]] = {}
    for row in rows:
        if row["family"] == family:
            grouped.setdefault(row["controller"], {}).setdefault(row["case"], []).append(row)
    return {name: [_spot(case, found) for case, found in by_case.items()] for name, by_case in grouped.items()}


def word(spot: Spot) -> str:
    """The case's first word: the direction of a swing."""
    return spot.case.split()[0]


def _spot(case: str, rows: list[Mapping[str, Any]]) -> Spot:
    per_seed = {row["seed"]: row["threshold"] for row in rows}
    known = [value for value in per_seed.values() if not math.isnan(value)]
    outcomes: dict[float, str] = {}
    for row in rows:
        if outcomes.get(row["level"], "stands") == "stands":
            outcomes[row["level"]] = row["outcome"]
    return Spot(
        case=case,
        threshold=median(known) if known else math.nan,
        at_top=any(row["at_top"] for row in rows),
        levels=tuple(sorted(outcomes.items())),
        place=_place(rows),
        axis=next((row["axis"] for row in rows if row["axis"]), ""),
        support=next((row["support"] for row in rows if row["support"]), ""),
    )


def _place(rows: list[Mapping[str, Any]]) -> tuple[float, float]:
    family = rows[0]["family"]
    if family == "swing":
        return _middle(rows, "swing_duration_s"), math.copysign(1.0, _middle(rows, "amplitude_m"))
    if family in ("push", "push-double"):
        return _mean_angle(rows), _middle(rows, "bound_ns")
    return _middle(rows, "stone_x_m"), _middle(rows, "stone_y_m")


def _middle(rows: list[Mapping[str, Any]], key: str) -> float:
    known = [row[key] for row in rows if not math.isnan(row[key])]
    return median(known) if known else math.nan


def _mean_angle(rows: list[Mapping[str, Any]]) -> float:
    """Of the pushes' directions [deg], all seeds together: 359 and 1 are 0, not 180."""
    angles = [math.radians(row["push_direction_deg"]) for row in rows if not math.isnan(row["push_direction_deg"])]
    if not angles:
        return math.nan
    return math.degrees(math.atan2(sum(map(math.sin, angles)), sum(map(math.cos, angles))))
