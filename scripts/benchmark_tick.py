#!/usr/bin/env python3
"""Measures one control tick (state in, torques out, all terms included) of every controller on one core.

Usage: .venv/bin/python scripts/benchmark_tick.py [--ticks 4000] [--scenario stand_left]

Prints median and p99 in microseconds and the ratio of medians to the first line. The machine may be busy: compare
ratios, and repeat. Nothing here is asserted anywhere.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from app.control.settings import ControllerSettings
from app.dynamics.model import DynamicsModel
from app.experiments.build import build_simulation
from app.experiments.scenario import load_scenario

VARIANTS: list[tuple[str, str, dict[str, Any]]] = [
    ("optimization", "optimization", {}),
    ("two-part, rest by inverse dynamics", "two-part", {"rest": "inverse-dynamics"}),
    ("two-part-literal", "two-part-literal", {}),
    ("soft-qp", "soft-qp", {}),
    ("two-part, rest by QP", "two-part", {}),
    ("two-part, rest by QP, Clarabel", "two-part", {"solver": "clarabel"}),
]


def measure_controller(scenario_name: str, controller: str, changes: dict[str, Any], ticks: int) -> np.ndarray:
    """Nanoseconds of each tick of a run, the first tenth left out as warm-up."""
    scenario = load_scenario(scenario_name, {f"controller.{key}": value for key, value in changes.items()})
    simulation = build_simulation(scenario, controller, rows=1, clock=time.perf_counter_ns).simulation
    for _ in range(ticks):
        simulation.tick()
    return np.array(simulation.tick_ns[ticks // 10 :])


def measure_call(call: Callable[[], object], times: int) -> np.ndarray:
    """Nanoseconds of each call, after a warm-up."""
    for _ in range(times // 10):
        call()
    found = np.empty(times)
    for i in range(times):
        start = time.perf_counter_ns()
        call()
        found[i] = time.perf_counter_ns() - start
    return found


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ticks", type=int, default=4000)
    parser.add_argument("--scenario", default="stand_left")
    arguments = parser.parse_args()

    table = Table("what", "median us", "p99 us", "ratio", title=f"{arguments.scenario}, {arguments.ticks} ticks each")
    first: float | None = None

    def line(what: str, nanoseconds: np.ndarray) -> None:
        nonlocal first
        median, p99 = np.median(nanoseconds) * 1e-3, np.percentile(nanoseconds, 99) * 1e-3
        first = first or float(median)
        table.add_row(what, f"{median:.0f}", f"{p99:.0f}", f"{median / first:.2f}")

    for what, controller, changes in VARIANTS:
        line(what, measure_controller(arguments.scenario, controller, changes, arguments.ticks))

    scenario = load_scenario(arguments.scenario)
    simulation = build_simulation(scenario, "two-part", rows=1).simulation
    simulation.tick()
    state, _ = simulation.plant.sense()
    dynamics = DynamicsModel(simulation.robot)
    torques = np.zeros(len(simulation.robot.joints))
    table.add_section()
    line("of which: dynamics terms", measure_call(lambda: dynamics.evaluate(state), arguments.ticks))
    line("besides: MuJoCo step", measure_call(lambda: simulation.plant.step(torques), min(arguments.ticks, 400)))
    console = Console()
    console.print(table)
    console.print(f"default solver: {ControllerSettings().solver}")


if __name__ == "__main__":
    main()
