#!/usr/bin/env python3
"""Measures one tick of every estimator on one core, in the running loop, beside one control tick of ``two-part``.

Usage: .venv/bin/python scripts/benchmark_estimators.py [--ticks 5000] [--scenarios stand_double,walk_flat]
           [--estimators anchor,invariant-ekf] [--preset robot] [--baseline CHECKOUT]

All runs advance in turn, 50 ticks each. A ratio is the median, over such blocks, of the ratio of two runs' medians in a
block: microseconds depend on the machine and the minute, ratios less. The control tick is that of ``two-part`` standing
on one foot (``stand_left``) with the true state.

"Alone" is the same estimator told the same readings again with nothing in between, so that all that it needs is in the
cache. In the loop it is not, and less so the more other processes there are.

``--baseline`` is a checkout of another commit (``git worktree add ../then COMMIT``), run in the same process; alone it
gets the readings of our run, and the largest differences of what both believed are told. Nothing here is asserted
anywhere.
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

    def believe(self, readings: list[Any]) -> tuple[list[Any], np.ndarray]:
        """What the unused estimator makes of them, and how long each took [ns]."""
        estimates, stamps = [], [time.perf_counter_ns()]
        for now in readings:
            estimates.append(self.unused.tick(now))
            stamps.append(time.perf_counter_ns())
        return estimates, np.diff(stamps)

    def _take(self) -> np.ndarray:
        return np.array(self._ns[-CHUNK:])


def ratio(ones: list[np.ndarray], others: list[np.ndarray]) -> float:
    """Median over the blocks of the ratio of their medians."""
    pairs = zip(ones[WARM_UP:], others[WARM_UP:], strict=True)
    return float(np.median([np.median(one) / np.median(other) for one, other in pairs]))


def alone(runs: list[EstimatorRun]) -> tuple[list[list[np.ndarray]], np.ndarray]:
    """All get the readings of the first, in turn by blocks: times [ns], and how far beliefs were apart, (3,).

    That is the largest difference of q, of v, and of the covariance by its largest.
    """
    times: list[list[np.ndarray]] = [[] for _ in runs]
    largest = np.zeros(3)
    for start in range(0, len(runs[0].readings), CHUNK):
        believed = [run.believe(runs[0].readings[start : start + CHUNK]) for run in runs]
        for kept, (_, took) in zip(times, believed, strict=True):
            kept.append(took)
        for one, other in zip(believed[0][0], believed[-1][0], strict=True):
            unit = np.abs(other.covariance).max()
            off = (one.state.q - other.state.q, one.state.v - other.state.v, (one.covariance - other.covariance) / unit)
            largest = np.maximum(largest, [np.abs(part).max() for part in off])
    return times, largest


def microseconds(blocks: list[np.ndarray], *percentiles: int) -> list[str]:
    """Of all ticks after the warm-up."""
    return [f"{1e-3 * value:.1f}" for value in np.percentile(np.concatenate(blocks[WARM_UP:]), percentiles)]


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
    if arguments.ticks <= WARM_UP * CHUNK:
        parser.error(f"--ticks: more than {WARM_UP * CHUNK}, which are left out as warm-up")
    if arguments.baseline and not (arguments.baseline / "app").is_dir():
        sys.exit(f"{arguments.baseline}: no checkout with a folder app")
    sides = [Checkout(HERE, outside=True)]
    if arguments.baseline:
        sides.append(Checkout(arguments.baseline.resolve(), outside=False))
    names = arguments.estimators.split(",")
    columns = ("estimator", "us", "p99", "of control tick", "alone us")
    more = (*(f"before: {column}" for column in columns[1:]), "ratio", "alone", "q", "v", "covariance")
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
        title = f"{scenario}, {arguments.ticks} ticks each; control tick {microseconds(control.blocks, 50)[0]} us"
        table = Table(*columns, *(more if arguments.baseline else ()), title=title)
        for name in names:
            of_name = [runs[name, side] for side in sides]
            times, apart = alone(of_name)
            row = [name]
            for run, by_itself in zip(of_name, times, strict=True):
                share = f"{ratio(run.blocks, control.blocks):.3f}"
                row += [*microseconds(run.blocks, 50, 99), share, *microseconds(by_itself, 50)]
            if arguments.baseline:
                row += [f"{ratio(of_name[0].blocks, of_name[1].blocks):.3f}", f"{ratio(*times):.3f}"]
                row += [f"{value:.1e}" for value in apart]
            table.add_row(*row)
        Console(width=170).print(table)


if __name__ == "__main__":
    main()
