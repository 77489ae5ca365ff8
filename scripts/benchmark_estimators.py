#!/usr/bin/env python3
"""Measures one tick of every estimator on one core, in the running loop, beside one control tick of ``two-part``.

Usage: .venv/bin/python scripts/benchmark_estimators.py [--ticks 5000] [--scenarios stand_double,walk_flat]
           [--estimators anchor,invariant-ekf] [--preset robot] [--baseline CHECKOUT]

All runs advance in turn, 50 ticks each. A ratio is the median, over such blocks, of the ratio of two runs' medians in a
block: microseconds depend on the machine and the minute, ratios less. The control tick is that of ``two-part`` standing
on one foot (``stand_left``) with the true state.

``--baseline`` is a checkout of another commit (``git worktree add ../then COMMIT``), run in the same process; then it
also gets every reading of our run again, and the largest differences of what both believed are told. Nothing here is
asserted anywhere.
"""

import argparse
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import copy
import gc
import time
from pathlib import Path
from typing import Any

import numpy as np
from benchmark_tick import CHUNK, HERE, Checkout
from rich.console import Console
from rich.table import Table

CONTROL = "two-part"
WARM_UP = 4  # blocks that are left out


class Run:
    """One run of the loop.

    Attributes:
        block_ns: times of the block that was measured last.
        blocks: all of them.
    """

    def __init__(self, checkout: Checkout, scenario: str, changes: dict[str, Any]) -> None:
        self._checkout = checkout
        self.simulation = checkout.simulation(scenario, CONTROL, changes)
        self.blocks: list[np.ndarray] = []

    def advance(self) -> None:
        """One block."""
        with self._checkout.active():
            for _ in range(CHUNK):
                self.simulation.tick()
        if self.simulation.fallen:
            sys.exit(f"fell at {self.simulation.fall_time_s} s: {self.simulation.fallen}")
        self.blocks.append(self._take())

    def _take(self) -> np.ndarray:
        return np.array(self.simulation.tick_ns[-CHUNK:])


class EstimatorRun(Run):
    """A run with sensors; it stands between them and the estimator, and measures that.

    Attributes:
        unused: a copy of the estimator as it was before its first tick.
        readings: all that it was told.
    """

    def __init__(self, checkout: Checkout, scenario: str, changes: dict[str, Any]) -> None:
        super().__init__(checkout, scenario, changes)
        senses = self.simulation.senses
        self._estimator, senses._estimator = senses._estimator, self
        with checkout.active():
            self.unused = copy.deepcopy(self._estimator)
        self.readings: list[Any] = []
        self._ns: list[int] = []

    def tick(self, readings: Any) -> Any:
        """In the estimator's place."""
        self.readings.append(readings)
        started = time.perf_counter_ns()
        estimate = self._estimator.tick(readings)
        self._ns.append(time.perf_counter_ns() - started)
        return estimate

    def _take(self) -> np.ndarray:
        return np.array(self._ns[-CHUNK:])


def ratio(ones: list[np.ndarray], others: list[np.ndarray]) -> float:
    """Median over the blocks of the ratio of their medians."""
    pairs = zip(ones[WARM_UP:], others[WARM_UP:], strict=True)
    return float(np.median([np.median(one) / np.median(other) for one, other in pairs]))


def differences(ours: EstimatorRun, theirs: EstimatorRun) -> np.ndarray:
    """(3,) largest between what both believe of the same readings: of q, of v, of the covariance by its largest."""
    largest = np.zeros(3)
    for readings in ours.readings:
        one, other = ours.unused.tick(readings), theirs.unused.tick(readings)
        pairs = (
            (one.state.q, other.state.q, 1.0),
            (one.state.v, other.state.v, 1.0),
            (one.covariance, other.covariance, np.abs(other.covariance).max()),
        )
        largest = np.maximum(largest, [np.abs(a - b).max() / unit for a, b, unit in pairs])
    return largest


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ticks", type=int, default=5000)
    parser.add_argument("--scenarios", default="stand_double,walk_flat", help="comma-separated")
    parser.add_argument("--estimators", default="anchor,invariant-ekf", help="comma-separated")
    parser.add_argument("--preset", default="robot", help="of the sensors")
    parser.add_argument("--seed", type=int, default=1, help="of the sensors")
    parser.add_argument("--baseline", type=Path, help="a checkout of another commit")
    arguments = parser.parse_args()
    if arguments.baseline and not (arguments.baseline / "app").is_dir():
        sys.exit(f"{arguments.baseline}: no checkout with a folder app")
    sides = [Checkout(HERE, outside=True)]
    if arguments.baseline:
        sides.append(Checkout(arguments.baseline.resolve(), outside=False))
    names = arguments.estimators.split(",")
    columns = ("estimator", "us", "p99", "of the control tick")
    more = ("before us", "p99", "of the control tick", "ratio", "q", "v", "covariance") if arguments.baseline else ()
    for scenario in arguments.scenarios.split(","):
        sensors = {"sensors.preset": arguments.preset, "sensors.seed": arguments.seed}
        control = Run(sides[0], "stand_left", {})
        runs = {
            (name, side): EstimatorRun(side, scenario, {**sensors, "estimator.kind": name})
            for name in names for side in sides
        }  # fmt: skip
        everything = [control, *runs.values()]
        gc.collect()
        for block in range(arguments.ticks // CHUNK):
            for run in everything if block % 2 else reversed(everything):
                run.advance()
        tick_us = 1e-3 * np.median(np.concatenate(control.blocks[WARM_UP:]))
        title = f"{scenario}, {arguments.ticks} ticks each; control tick {tick_us:.0f} us"
        table = Table(*columns, *more, title=title)
        for name in names:
            row = [name]
            for side in sides:
                run = runs[name, side]
                figures = 1e-3 * np.percentile(np.concatenate(run.blocks[WARM_UP:]), (50, 99))
                row += [*(f"{value:.1f}" for value in figures), f"{ratio(run.blocks, control.blocks):.3f}"]
            if arguments.baseline:
                ours, theirs = (runs[name, side] for side in sides)
                row.append(f"{ratio(ours.blocks, theirs.blocks):.3f}")
                row += [f"{value:.1e}" for value in differences(ours, theirs)]
            table.add_row(*row)
        Console(width=150).print(table)


if __name__ == "__main__":
    main()
