"""How wrong the estimators of a bench were: of every level that was survived, over the seeds."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from surefoot.experiments.bench.statistics import Range, median_and_range


@dataclass(frozen=True, kw_only=True)
class BeliefErrors:
    """One controller in one case at one level, over the seeds that survived it.

    Attributes:
        family, case, controller, level, unit: which.
        survived, seeds: how many were, of how many that were played at this level.
        dcm_mm: 99th percentile of an episode's distance of the believed from the true DCM, see ``Episode``.
        tilt_deg: the same of the tilt.
        com_mm: distance of the true CoM from its reference before the disturbance, or at the end where there is none.
    """

    family: str
    case: str
    controller: str
    level: float
    unit: str
    survived: int
    seeds: int
    dcm_mm: Range
    tilt_deg: Range
    com_mm: Range


def beliefs(rows: Sequence[Mapping[str, Any]]) -> list[BeliefErrors]:
    """In the order of the table; empty where nobody believes anything."""
    groups: dict[tuple[Any, ...], list[Mapping[str, Any]]] = {}
    for row in rows:
        which = row["family"], row["case"], row["controller"], row["level"], row["unit"]
        groups.setdefault(which, []).append(row)
    found = []
    for (family, case, controller, level, unit), group in groups.items():
        told = [row for row in group if row["survived"] and not math.isnan(row.get("dcm_error_p99_mm", math.nan))]
        if told:
            found.append(
                BeliefErrors(
                    family=family,
                    case=case,
                    controller=controller,
                    level=level,
                    unit=unit,
                    survived=len(told),
                    seeds=len(group),
                    dcm_mm=median_and_range([row["dcm_error_p99_mm"] for row in told]),
                    tilt_deg=median_and_range([row["tilt_error_p99_deg"] for row in told]),
                    com_mm=median_and_range([1e3 * _stood_off(row) for row in told]),
                )
            )
    return found


def _stood_off(row: Mapping[str, Any]) -> float:
    before = row.get("stood_off_m", math.nan)
    return row["com_error_m"] if math.isnan(before) else before
