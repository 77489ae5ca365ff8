#!/usr/bin/env python3
"""Measures one tick of every controller on one core: the control alone (state in, torques out) and the whole loop.

Usage: .venv/bin/python scripts/benchmark_tick.py [--ticks 4000] [--scenarios stand_left,...] [--baseline CHECKOUT]

All runs advance in turn, 50 ticks each, so that what else the machine does meets all of them alike: compare ratios, and
repeat. ``--baseline`` is a checkout of another commit (``git worktree add ../then COMMIT``), run in the same process.
TSID takes part where it is installed (scripts/setup_tsid.sh). Nothing here is asserted anywhere.
"""

import argparse
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import gc
import importlib
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from rich.console import Console
from rich.table import Table

HERE = Path(__file__).resolve().parents[1]
CHUNK = 50
SCENARIOS = "stand_left,stand_double,stone_outer_edge"
VARIANTS: dict[str, tuple[str, dict[str, Any]]] = {
    "two-part": ("two-part", {}),
    # By the setting's first name, which every commit reads: today's is other_joints.
    "two-part, other joints by inverse dynamics": ("two-part", {"controller.rest": "inverse-dynamics"}),
    "two-part-literal": ("two-part-literal", {}),
    "soft-qp": ("soft-qp", {}),
    "optimization": ("optimization", {}),
    "tsid": ("tsid", {}),
}


class Checkout:
    """The package of one working tree, and the controllers from outside that use it.

    Two of them can live in one process, one at a time; only one can have the controllers from outside, which were
    written for its package.
    """

    def __init__(self, folder: Path, *, outside: bool) -> None:
        self._outside = outside
        renamed = (folder / "app" / "surefoot").is_dir()  # before that the package was called app
        self._package, self._source = ("surefoot", str(folder / "app")) if renamed else ("app", str(folder))
        self._modules: dict[str, Any] = {}

    @contextmanager
    def active(self) -> Iterator[None]:
        """Have ``import surefoot`` mean this one."""
        others = _taken()
        sys.modules.update(self._modules)
        sys.path.insert(0, self._source)
        try:
            with nullcontext() if self._outside else patch("importlib.metadata.entry_points", return_value=()):
                yield
        finally:
            sys.path.remove(self._source)
            self._modules = _taken()
            sys.modules.update(others)

    def names(self) -> tuple[str, ...]:
        """The controllers that can be built here."""
        with self.active():
            known = self._module("control.registry").controllers()
            invalid = self._module("errors").InvalidInput
        usable = []
        for name in known:
            try:
                self.simulation("stand_left", name, {})
                usable.append(name)
            except invalid:  # a controller from outside that lacks its library
                continue
        return tuple(usable)

    def simulation(self, scenario: str, controller: str, changes: dict[str, Any]) -> Any:
        """A run that measures its control ticks; changes of the scenario by dotted path."""
        with self.active():
            load = self._find("load_scenario", "experiments.scenario.scenario", "experiments.scenario")
            build = self._find("build_simulation", "experiments.scenario.build", "experiments.build")
            return build(load(scenario, changes), controller, rows=1, clock=time.perf_counter_ns).simulation

    def _module(self, name: str) -> Any:
        return importlib.import_module(f"{self._package}.{name}")

    def _find(self, name: str, *places: str) -> Any:
        """What the first of these modules has under that name: files move between two commits."""
        for place in places:
            with suppress(ModuleNotFoundError, AttributeError):
                return getattr(self._module(place), name)
        raise SystemExit(f"{self._source}: {name} is in none of {', '.join(places)}")


def _taken() -> dict[str, Any]:
    """All modules of the package and of the controllers from outside, taken out of the interpreter's table."""
    outside = {point.module.partition(".")[0] for point in entry_points(group="surefoot.controllers")}
    names = [name for name in sys.modules if name.partition(".")[0] in {"surefoot", "app", *outside}]
    return {name: sys.modules.pop(name) for name in names}


class Measured:
    """One run and its times."""

    def __init__(self, checkout: Checkout, scenario: str, controller: str, changes: dict[str, Any]) -> None:
        self.checkout, self.simulation = checkout, checkout.simulation(scenario, controller, changes)
        self.loop_ns: list[int] = []
        self.ways: dict[str, int] = {}

    def advance(self) -> None:
        """Some ticks; a fallen robot measures nothing more."""
        with self.checkout.active():
            for _ in range(CHUNK):
                if self.simulation.fallen:
                    return
                started = time.perf_counter_ns()
                result = self.simulation.tick()
                self.loop_ns.append(time.perf_counter_ns() - started)
                way = getattr(result.output, "qp_method", "")
                self.ways[way] = self.ways.get(way, 0) + 1

    def figures(self) -> tuple[np.ndarray, np.ndarray]:
        """Control and loop, median and p99 each [us], the first tenth left out as warm-up."""
        times = (self.simulation.tick_ns, self.loop_ns)
        control, loop = (1e-3 * np.percentile(ns[len(ns) // 10 :], (50, 99)) for ns in times)
        return control, loop

    def closed_form(self) -> str:
        """Share of ticks whose QP was solved in closed form."""
        solved = sum(count for way, count in self.ways.items() if way)
        return f"{100 * self.ways.get('closed-form', 0) / solved:.0f} %" if solved else ""


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ticks", type=int, default=4000)
    parser.add_argument("--scenarios", default=SCENARIOS, help="comma-separated")
    parser.add_argument("--baseline", type=Path, help="a checkout of another commit")
    arguments = parser.parse_args()
    if arguments.baseline and not (arguments.baseline / "app").is_dir():
        sys.exit(f"{arguments.baseline}: no checkout with a folder app")
    sides = [Checkout(HERE, outside=True)]
    if arguments.baseline:
        sides.append(Checkout(arguments.baseline.resolve(), outside=False))
    columns = ("controller", "control us", "p99", "loop us", "p99", "closed form")
    ratios = ("control ratio", "p99", "loop ratio", "p99") if arguments.baseline else ()
    usable = sides[0].names()
    for scenario in arguments.scenarios.split(","):
        table = Table(*columns, *ratios, title=f"{scenario}, {arguments.ticks} ticks each")
        variants = {what: variant for what, variant in VARIANTS.items() if variant[0] in usable}
        runs = {
            (what, side): Measured(side, scenario, *variant)
            for what, variant in variants.items() for side in sides if variant[0] != "tsid" or side is sides[0]
        }  # fmt: skip
        gc.collect()
        for _ in range(arguments.ticks // CHUNK):
            for run in runs.values():
                run.advance()
        for what in variants:
            ours = runs[what, sides[0]]
            control, loop = ours.figures()
            row = [what, *(f"{value:.0f}" for value in (*control, *loop)), ours.closed_form()]
            if arguments.baseline and (what, sides[1]) in runs:
                before = runs[what, sides[1]].figures()
                row += [f"{value:.3f}" for value in (*(control / before[0]), *(loop / before[1]))]
            table.add_row(*row)
        Console(width=130).print(table)


if __name__ == "__main__":
    main()
