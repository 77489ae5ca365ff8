"""A price list as a bench: which cells it has, and what its manifest says of it."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bench import Bench, BenchRequest, cell_of, code_of
from surefoot.experiments.bench.cells import Cell
from surefoot.experiments.bench.entries import OF_SCENARIO, BenchEntry, bench_entries
from surefoot.experiments.bench.variations import varied
from surefoot.experiments.bench.warm_up import warmed_up
from surefoot.experiments.price.figures import figures_named
from surefoot.experiments.price.variants import Variant, variants
from surefoot.experiments.scenario.scenario import parse_change
from surefoot.field_metadata import from_mapping

ABOUT = "price"  # its key in the manifest


@dataclass(frozen=True, kw_only=True)
class PriceRequest:
    """What is asked for.

    Attributes:
        families: names; none for those that stand.
        preset: whose imperfections.
        estimator: what reads the sensors.
        imperfections: only these of the preset, or ``NAME+key=value`` of one's own; none: all.
        controllers: comma-separated, as ``surefoot bench`` takes them.
        quick: coarse levels and fewer cases.
        seeds, first_seed: how many seeds, from which on.
        changes: ``key=value`` for all variants, perfect too.
    """

    families: tuple[str, ...] = ()
    preset: str = "robot"
    estimator: str = "anchor"
    imperfections: tuple[str, ...] = ()
    controllers: str = "two-part"
    quick: bool = False
    seeds: int = 3
    first_seed: int = 0
    changes: tuple[str, ...] = ()


def plan_price(request: PriceRequest) -> Bench:
    """Work out the cells, seed by seed, so that all variants have as many where it is ended. Raises InvalidInput.

    Every variant stands for a while before it is disturbed, perfect too: nothing differs but the imperfection.
    """
    if request.seeds < 1:
        raise InvalidInput("--seeds", request.seeds, "must be at least 1")
    if request.first_seed < 0:
        raise InvalidInput("--first-seed", request.first_seed, "must not be negative")
    if not request.controllers.strip():
        raise InvalidInput("--controllers", request.controllers, "needs a controller at least", ["two-part"])
    figures = figures_named(request.families)
    found = variants(request.preset, request.estimator, request.imperfections)
    common = _common(request)
    asked = bench_entries(request.controllers, common["controller"], common["scenario"])
    lines = [(one, variant, _under(one, variant)) for one in asked for variant in found]
    entries = tuple(entry for _, _, entry in lines)
    code = code_of(entries)
    cells = [
        cell_of(varied(warmed_up(case), seed), entry, seed, code[entry.label], every_level=len(case.levels) == 1)
        for seed in range(request.first_seed, request.first_seed + request.seeds)
        for figure in figures
        for case in figure.cases(quick=request.quick)
        for entry in entries
    ]
    for cell in {cell.label: cell for cell in reversed(cells)}.values():
        cell.scenario_at(cell.case.levels[0])  # a mistake in a change shows before anything runs
    about = {
        "request": dataclasses.asdict(request),
        "figures": [{"family": f.family, "what": f.what, "unit": f.unit} for f in figures],
        "lines": [
            {
                "controller": one.label,
                "label": entry.label,
                "variant": variant.name,
                "changes": dict(variant.changes),
                "base": variant.base,
            }
            for one, variant, entry in lines
        ],
    }
    same = {name: getattr(request, name) for name in ("controllers", "quick", "seeds", "first_seed", "changes")}
    bench = BenchRequest(families=tuple(f.family for f in figures), **same)
    return Bench(request=bench, entries=entries, cells=tuple(cells), about={ABOUT: about})


def plan_again(row: Mapping[str, Any], manifest: Mapping[str, Any]) -> tuple[Cell, ...]:
    """The cells of a finished price list that have the seed of one of its rows. Raises InvalidInput."""
    asked = manifest[ABOUT]["request"]
    plain = {key: tuple(value) if isinstance(value, list) else value for key, value in asked.items()}
    request = from_mapping(PriceRequest, plain, f"manifest.{ABOUT}.request")
    return plan_price(replace(request, seeds=1, first_seed=int(row["seed"]))).cells


def _common(request: PriceRequest) -> dict[str, dict[str, Any]]:
    """Changes of all variants: of the settings, and of the scenario. Raises InvalidInput."""
    found: dict[str, dict[str, Any]] = {"controller": {}, "scenario": {}}
    for path, value in (parse_change(text) for text in request.changes):
        if path.startswith("controller."):
            found["controller"][path.removeprefix("controller.")] = value
        elif path.startswith(OF_SCENARIO):
            found["scenario"][path] = value
        else:
            raise InvalidInput("--set", path, "a price list changes settings and the plant only", OF_SCENARIO)
    return found


def _under(entry: BenchEntry, variant: Variant) -> BenchEntry:
    """A controller under one variant; what is said of it itself comes first, so that a variant is what it says."""
    label = f"{entry.label}: {variant.name}"
    return replace(entry, label=label, scenario={**entry.scenario, **variant.changes})
