"""From the table to the ranking: what each controller holds in each family, and how sure that is."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from surefoot.experiments.bench.cell_runner import EXCEPTION, OTHER_PLANT
from surefoot.experiments.bench.impulse_budget import ledger_of
from surefoot.experiments.bench.statistics import Range, bootstrap_means, median_and_range, middle_95, share_interval
from surefoot.experiments.bench.words import unheld
from surefoot.simulation.falls import CONTROLLER_ERROR, ESTIMATOR_ERROR

_ROUNDING = 1e-9


@dataclass(frozen=True)
class Standing:
    """One controller in one family.

    Attributes:
        controller, family, unit: which.
        thresholds: case -> largest level survived, median and range over seeds.
        lowest: case -> lowest level played, where a seed survived none (``unheld``): its threshold of 0 is below that.
        at_top: how many cells ended at the top of their ladder, so that the threshold may be higher.
        refused: how many cells could not be started.
        reached, wanted: cells whose threshold is at or above their goal, of those that have one.
        goal_cases: the cases these cells are seeds of.
        parts: case -> median threshold / best median of all controllers; without the cases that nobody holds.
    """

    controller: str
    family: str
    unit: str
    thresholds: Mapping[str, Range]
    lowest: Mapping[str, float]
    at_top: int
    refused: int
    reached: int
    wanted: int
    goal_cases: int
    parts: Mapping[str, float]

    @property
    def score(self) -> float:
        """Mean over cases of the parts; NaN when nothing can be compared."""
        return sum(self.parts.values()) / len(self.parts) if self.parts else math.nan

    @property
    def mean(self) -> float:
        """Mean over cases of the median threshold."""
        known = [t.median for t in self.thresholds.values() if not math.isnan(t.median)]
        return sum(known) / len(known) if known else math.nan

    @property
    def worst(self) -> float:
        """Least threshold of any case and seed."""
        return min((t.low for t in self.thresholds.values() if not math.isnan(t.low)), default=math.nan)

    @property
    def lowest_level(self) -> float | None:
        """What a mean or least threshold of 0 is below; None where some level is survived in every cell."""
        return max(self.lowest.values(), default=None)

    @property
    def interval(self) -> tuple[float, float]:
        """95 % interval of the share of goals reached: seeds of one case count as one trial."""
        return share_interval(self.reached, self.wanted, self.goal_cases)


def standings(rows: Sequence[Mapping[str, Any]]) -> list[Standing]:
    """Every controller in every family, in the order of the table."""
    cells = {row["cell"]: row for row in rows}.values()  # all rows of a cell carry its threshold
    names = list(dict.fromkeys(row["controller"] for row in cells))
    played: dict[tuple[str, str], dict[str, list[Mapping[str, Any]]]] = {}
    for row in rows:
        played.setdefault((row["family"], row["controller"]), {}).setdefault(row["case"], []).append(row)
    found = []
    for family in dict.fromkeys(row["family"] for row in cells):
        of_family = [row for row in cells if row["family"] == family]
        medians = {name: _thresholds([row for row in of_family if row["controller"] == name]) for name in names}
        for name in names:
            mine = [row for row in of_family if row["controller"] == name]
            goals = [row for row in mine if not math.isnan(row["goal"]) and not math.isnan(row["threshold"])]
            found.append(
                Standing(
                    name,
                    family,
                    mine[0]["unit"],
                    medians[name],
                    _lowest(played[family, name]),
                    sum(row["at_top"] for row in mine),
                    sum(math.isnan(row["threshold"]) for row in mine),
                    sum(row["threshold"] >= row["goal"] - _ROUNDING for row in goals),
                    len(goals),
                    len({row["case"] for row in goals}),
                    _parts(name, medians),
                )
            )
    return found


@dataclass(frozen=True)
class Place:
    """A place in the ranking.

    Attributes:
        controller: whose.
        score: mean over families of the mean over cases.
        interval: 95 % of it, over the cases: which disturbances happen to be in the bench.
        behind: by how much the first one's score is higher.
        behind_interval: 95 % of that, case by case; an interval that holds 0 says that the order may be chance.
    """

    controller: str
    score: float
    interval: tuple[float, float]
    behind: float
    behind_interval: tuple[float, float]


def places(found: Sequence[Standing]) -> list[Place]:
    """The ranking with its intervals, from resamples of the cases (see ``bootstrap_means``)."""
    order = ranking(found)
    of = {(standing.controller, standing.family): standing.parts for standing in found}
    families = [f for f in dict.fromkeys(s.family for s in found) if any(of[name, f] for name, _ in order)]
    tables = [
        np.array([[of[name, family][case] for name, _ in order] for case in of[order[0][0], family]])
        for family in families
    ]
    if not tables:
        return []
    means = bootstrap_means(tables)
    return [
        Place(name, score, middle_95(means[:, i]), max(0.0, order[0][1] - score), middle_95(means[:, 0] - means[:, i]))
        for i, (name, score) in enumerate(order)
    ]


def ranking(found: Sequence[Standing]) -> list[tuple[str, float]]:
    """Controllers by their mean score over families, best first (equal ones by name)."""
    scores: dict[str, list[float]] = {}
    for standing in found:
        if not math.isnan(standing.score):
            scores.setdefault(standing.controller, []).append(standing.score)
    means = [(name, sum(values) / len(values)) for name, values in scores.items()]
    return sorted(means, key=lambda entry: (-round(entry[1], 9), entry[0]))


def not_adding_up(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Pushes survived beyond J_cap whose ledger does not add up: the simulation or the accounts are wrong."""
    return [row for row in beyond_bound(rows) if not ledger_of(row).adds_up]


def as_data(found: Sequence[Standing]) -> dict[str, Any]:
    """The ranking as plain data, for a file that documents can be made from."""
    return {
        "ranking": [
            {
                "controller": p.controller,
                "score": p.score,
                "score_95": list(p.interval),
                "behind": p.behind,
                "behind_95": list(p.behind_interval),
            }
            for p in places(found)
        ],
        "families": [
            {
                "family": s.family,
                "controller": s.controller,
                "unit": s.unit,
                "mean": _known(s.mean),
                "worst": _known(s.worst),
                "lowest": s.lowest_level,
                "at_top": s.at_top,
                "refused": s.refused,
                "score": _known(s.score),
                "goals_reached": s.reached,
                "goals": s.wanted,
                "goal_cases": s.goal_cases,
                "goals_95": list(s.interval),
                "cases": {
                    name: {"median": _known(t.median), "low": _known(t.low), "high": _known(t.high)}
                    | ({"lowest": s.lowest[name]} if name in s.lowest else {})
                    for name, t in s.thresholds.items()
                },
            }
            for s in found
        ],
    }


def _known(value: float) -> float | None:
    return None if math.isnan(value) else value


def crashed(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Episodes that ended in an exception or because controller or estimator failed, which counts as a fall."""
    return [row for row in rows if row["fall_cause"] in (EXCEPTION, CONTROLLER_ERROR, ESTIMATOR_ERROR)]


def beyond_bound(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """The pushes survived beyond J_cap, with their ledger; not of plants whose bound is another."""
    return [row for row in rows if row["survived"] and row["eta"] > 1.0 + _ROUNDING and row.get(OTHER_PLANT) != 1.0]


def _thresholds(rows: Sequence[Mapping[str, Any]]) -> dict[str, Range]:
    names = dict.fromkeys(row["case"] for row in rows)
    return {name: median_and_range([row["threshold"] for row in rows if row["case"] == name]) for name in names}


def _lowest(by_case: Mapping[str, Sequence[Mapping[str, Any]]]) -> dict[str, float]:
    found = {case: unheld(rows) for case, rows in by_case.items()}
    return {case: level for case, level in found.items() if level is not None}


def _parts(name: str, medians: Mapping[str, Mapping[str, Range]]) -> dict[str, float]:
    parts = {}
    for case, threshold in medians[name].items():
        best = max((m[case].median for m in medians.values() if not math.isnan(m[case].median)), default=0.0)
        if best > 0.0:  # else nobody holds it, or nobody can start there
            parts[case] = 0.0 if math.isnan(threshold.median) else threshold.median / best
    return parts
