"""From the rows of a finished price list to what each imperfection costs, with intervals over seeds."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.special import stdtrit

from surefoot.experiments.bench.words import unheld
from surefoot.experiments.price.figures import STEPS
from surefoot.experiments.price.plan import ABOUT
from surefoot.experiments.price.variants import NONE, TOGETHER

INTERPLAY = "interplay"


@dataclass(frozen=True, kw_only=True)
class Price:
    """One variant of one controller in one figure. NaN where nothing could be started.

    Attributes:
        controller, family, variant: which.
        unit: of the figure.
        base: the variant that lost is counted from; of ``interplay`` empty: it is what ``together`` loses beyond the
            sum of all others.
        value: mean over cases and seeds; of ``interplay`` NaN.
        lost: mean over seeds of base less this variant, seed by seed; negative where it gained.
        interval: 95 % of it over seeds (Student's t); None for a single seed.
        share: lost as a part of the perfect value.
        seeds, cells: how many of each.
        at_top: cells whose threshold lies at the top of the ladder, so that it may be higher.
        nothing: cells in which not even the weakest level was survived; of walks, that were not completed.
        lowest: the weakest level played in these, which a value of 0 is below; None where there are none, and of steps.
        unsettled: of these, how many without a fall: G stayed 10 mm off (``stood_off``) or did not come to rest.
    """

    controller: str
    family: str
    variant: str
    unit: str
    base: str
    value: float
    lost: float
    interval: tuple[float, float] | None
    share: float
    seeds: int
    cells: int = 0
    at_top: int = 0
    nothing: int = 0
    lowest: float | None = None
    unsettled: int = 0


def prices(rows: Sequence[Mapping[str, Any]], manifest: Mapping[str, Any]) -> list[Price]:
    """Of every figure and controller, in the order of the list: perfect first, then interplay and together.

    Cases that could not be started under some variant are left out of all.

    Args:
        rows: of the table.
        manifest: what made it.
    """
    about, cells = manifest[ABOUT], _cells(rows)
    controllers = dict.fromkeys(line["controller"] for line in about["lines"])
    found = []
    for figure in about["figures"]:
        for controller in controllers:
            lines = [line for line in about["lines"] if line["controller"] == controller]
            found += _of_figure(figure, lines, cells)
    return found


def mean_and_interval(values: Sequence[float]) -> tuple[float, tuple[float, float] | None]:
    """Mean of some values, and the 95 % interval of the mean by Student's t; None for one value. NaN for none."""
    if not len(values):
        return math.nan, None
    middle = float(np.mean(values))
    if len(values) == 1:
        return middle, None
    half = float(stdtrit(len(values) - 1, 0.975) * np.std(values, ddof=1) / math.sqrt(len(values)))
    return middle, (middle - half, middle + half)


def _cells(rows: Sequence[Mapping[str, Any]]) -> dict[tuple[str, str], dict[tuple[int, str], list[Mapping[str, Any]]]]:
    """(family, label) -> (seed, case) -> rows of the cell, weakest level first."""
    found: dict[tuple[str, str], dict[tuple[int, str], list[Mapping[str, Any]]]] = {}
    for row in rows:
        of = found.setdefault((row["family"], row["controller"]), {})
        of.setdefault((row["seed"], row["case"]), []).append(row)
    return found


def _of_figure(
    figure: Mapping[str, Any], lines: Sequence[Mapping[str, Any]], cells: Mapping[tuple[str, str], Any]
) -> list[Price]:
    family, unit = figure["family"], figure["unit"]
    mine = {line["variant"]: cells.get((family, line["label"]), {}) for line in lines}
    values = {name: {key: _value(of, unit) for key, of in found.items()} for name, found in mine.items()}
    everywhere = [
        key for key in values[NONE] if all(not math.isnan(found.get(key, math.nan)) for found in values.values())
    ]
    seeds = list(dict.fromkeys(seed for seed, _ in everywhere))
    by_seed = {
        name: np.array([np.mean([found[key] for key in everywhere if key[0] == seed]) for seed in seeds])
        for name, found in values.items()
    }
    perfect = float(np.mean(by_seed[NONE])) if seeds else math.nan
    lost = {line["variant"]: by_seed[line["base"] or NONE] - by_seed[line["variant"]] for line in lines}
    alone = [loss for name, loss in lost.items() if name not in (NONE, TOGETHER)]
    common = partial(Price, controller=lines[0]["controller"], family=family, unit=unit, seeds=len(seeds))
    found = []
    for line in lines:
        name = line["variant"]
        if name == TOGETHER and len(alone) > 1:
            more = lost[name] - sum(alone)
            found.append(common(variant=INTERPLAY, base="", value=math.nan, **_lost(more, perfect)))
        counts = _counts([mine[name][key] for key in everywhere], unit)
        value = float(np.mean(by_seed[name])) if seeds else math.nan
        found.append(common(variant=name, base=line["base"], value=value, **_lost(lost[name], perfect), **counts))
    return found


def _lost(by_seed: np.ndarray, perfect: float) -> dict[str, Any]:
    lost, interval = mean_and_interval(by_seed.tolist())
    return {"lost": lost, "interval": interval, "share": lost / perfect if perfect > 0.0 else math.nan}


def _value(cell: Sequence[Mapping[str, Any]], unit: str) -> float:
    """What one cell came to; NaN when it could not be started."""
    if unit != STEPS:
        return float(cell[0]["threshold"])
    made = [row.get("steps_made", math.nan) for row in cell if row["outcome"] != "refused"]
    return float(np.mean([0.0 if math.isnan(steps) else steps for steps in made])) if made else math.nan


def _counts(cells: Sequence[Sequence[Mapping[str, Any]]], unit: str) -> dict[str, Any]:
    failed = [cell[0] for cell in cells if not cell[0]["threshold"] > 0.0]
    return {
        "cells": len(cells),
        "at_top": sum(bool(cell[0]["at_top"]) for cell in cells),
        "nothing": len(failed),
        "lowest": None if unit == STEPS else unheld([row for cell in cells for row in cell]),
        "unsettled": sum(row["outcome"] == "unsettled" for row in failed),
    }
