"""Of those who step: which share of the seeds is survived at each level, and what ended every other run."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from surefoot.experiments.bench.ankle_stop import LONG_ENOUGH_S
from surefoot.experiments.bench.cell_runner import OTHER_PLANT
from surefoot.experiments.bench.statistics import share_interval
from surefoot.experiments.bench.walk_families import GROUND_BY_SEED, WALK_FAMILIES


@dataclass(frozen=True, kw_only=True)
class Share:
    """One controller in one case at one level.

    Attributes:
        family, case, controller, level, unit: which.
        completed, seeds: how many seeds came through, of how many that were played at this level.
        interval: 95 % of that share, Wilson's: each seed is a trial where it draws the ground, noise or errors of the
            model, else all are one.
        ended: what ended the others -> how many.
        ankle_stop: of how many of the others an ankle was at its stop in the last second before the first cause.
        bound_ns: J_cap1 where the level is a share of it, mean over seeds [N s]; else None.
        step: the step that J_cap1 is for; empty where there is none.
    """

    family: str
    case: str
    controller: str
    level: float
    unit: str
    completed: int
    seeds: int
    interval: tuple[float, float]
    ended: Mapping[str, int]
    ankle_stop: int
    bound_ns: float | None = None
    step: str = ""


def shares(rows: Sequence[Mapping[str, Any]]) -> list[Share]:
    """Of every level that was played with every seed, in the order of the table.

    Where levels were bisected, each seed has others; a share of those alone that came so far would mislead.
    """
    walks = [row for row in rows if row["family"] in WALK_FAMILIES]
    seeds: dict[tuple[Any, ...], set[int]] = {}
    groups: dict[tuple[Any, ...], list[Mapping[str, Any]]] = {}
    for row in walks:
        seeds.setdefault(_cells(row), set()).add(row["seed"])
        groups.setdefault((*_cells(row), row["level"]), []).append(row)
    return [_share(group) for key, group in groups.items() if len(group) == len(seeds[key[:-1]])]


def _cells(row: Mapping[str, Any]) -> tuple[Any, ...]:
    return row["family"], row["case"], row["controller"]


def _share(group: Sequence[Mapping[str, Any]]) -> Share:
    first, completed = group[0], sum(bool(row["survived"]) for row in group)
    trials = len(group) if first["family"] in GROUND_BY_SEED or any(map(_draws_errors, group)) else 1
    return Share(
        family=first["family"],
        case=first["case"],
        controller=first["controller"],
        level=first["level"],
        unit=first["unit"],
        completed=completed,
        seeds=len(group),
        interval=share_interval(completed, len(group), trials),
        **_failures(group),
        **_bound(group),
    )


def _draws_errors(row: Mapping[str, Any]) -> bool:
    """Whether its seed drew noise of the sensors, or errors of the model."""
    return not math.isnan(row.get("tilt_error_p99_deg", math.nan)) or row.get(OTHER_PLANT, 0.0) == 1.0


def _bound(group: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """What the one-step bound was and is for."""
    known = [row for row in group if not math.isnan(row.get("bound_1_ns", math.nan))]
    if not known:
        return {}
    first = known[0]
    in_walk = first["unit"] != "J/J_cap1"
    lands = "the next of a walk, at its time" if in_walk else f"standing after {first['step_landing_s']:g} s"
    reach = (
        f"{first['step_ahead_m']:g} m ahead, {first['step_back_m']:g} m back or {first['step_aside_m']:g} m aside of "
        f"the other foot, {lands}"
    )
    return {"bound_ns": sum(row["bound_1_ns"] for row in known) / len(known), "step": reach}


@dataclass(frozen=True, kw_only=True)
class Endings:
    """What ended the runs of one controller in one family, of all cases, levels and seeds that were played.

    Attributes:
        family, controller: which.
        runs: how many.
        ended: what ended those that failed -> how many, most first.
        ankle_stop: as of a share.
    """

    family: str
    controller: str
    runs: int
    ended: Mapping[str, int]
    ankle_stop: int


def endings(rows: Sequence[Mapping[str, Any]]) -> list[Endings]:
    """Of every family in which somebody steps, in the order of the table."""
    groups: dict[tuple[str, str], list[Mapping[str, Any]]] = {}
    for row in rows:
        if row["family"] in WALK_FAMILIES:
            groups.setdefault((row["family"], row["controller"]), []).append(row)
    return [
        Endings(family=family, controller=controller, runs=len(group), **_failures(group))
        for (family, controller), group in groups.items()
    ]


def _failures(group: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    failed = [row for row in group if not row["survived"]]
    return {
        "ended": dict(Counter(ended_by(row) for row in failed).most_common()),
        "ankle_stop": sum(row.get("ankle_stop_before_s", math.nan) >= LONG_ENOUGH_S for row in failed),
    }


def ended_by(row: Mapping[str, Any]) -> str:
    """What ended an episode that was not survived.

    The first cause of a walk's fall, else what the fall is called, else the outcome: ``unsettled`` where time ran out.
    """
    return row.get("first_cause") or row["fall_cause"] or row["outcome"]
