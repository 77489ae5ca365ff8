#!/usr/bin/env python3
"""Draws random stones, stones with a push, pushes and swings, and counts in how many each controller stands.

Usage: .venv/bin/python scripts/random_mixtures.py [--first 48] [--last 144] [--workers 2] [NAME[+KEY=VALUE...] ...]

A seed is a scenario: one of four kinds, on the left foot, 4 s. Stones 6 to 18 mm along both edges of the sole; pushes
0.3 to 0.9 of the capture bound (with a stone 0.3 to 0.6) in any direction; swings up to 50 mm sideways and 80 mm fore
and aft within 0.35 to 0.6 s. Seeds 0 to 47 were used in tuning, 48 to 143 were not.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np

from surefoot.experiments.bench.entries import bench_entries
from surefoot.experiments.runs.run import run
from surefoot.experiments.scenario.bounds import push_bound
from surefoot.experiments.scenario.reference_spec import ReferenceSpec
from surefoot.experiments.scenario.scenario import Scenario
from surefoot.simulation.external_forces import Push
from surefoot.simulation.stones import Stone

KINDS = ("stone", "stone and push", "push", "swing")
DEFAULT = ("two-part", "two-part+roll_gate=true", "two-part+com_weight=1+foot_weight=1+roll_gate=true",
           "soft-qp+guard=true", "two-part-literal")  # fmt: skip


def scenario_of(seed: int) -> tuple[str, Scenario]:
    """The kind and the scenario of a seed."""
    random = np.random.default_rng(10_000 + seed)
    kind = KINDS[random.integers(4)]
    scenario = Scenario(name=f"mixture {seed}", duration_s=4.0)
    if "stone" in kind:
        x, side = random.uniform(-0.11, 0.16), random.choice([-1, 1])
        y, height = side * random.uniform(0.03, 0.08), random.uniform(0.006, 0.018)
        stone = Stone(x_m=float(x), y_m=float(y), height_m=float(height), rise_start_s=0.3)
        scenario = replace(scenario, stones=(stone,))
    if "push" in kind:
        direction = float(random.uniform(0.0, 360.0))
        share = float(random.uniform(0.3, 0.9 if kind == "push" else 0.6))
        push = Push(direction_deg=direction, impulse_ns=1.0, start_s=1.2, duration_s=0.1)
        bound = push_bound(replace(scenario, pushes=(push,)))
        scenario = replace(scenario, pushes=(replace(push, impulse_ns=share * bound.impulse_ns),))
    if kind == "swing":
        axis = str(random.choice(["lateral", "sagittal"]))
        amplitude = random.choice([-1, 1]) * random.uniform(0.02, 0.05 if axis == "lateral" else 0.08)
        spec = ReferenceSpec(
            kind="swing", axis=axis, amplitude_m=float(amplitude), duration_s=float(random.uniform(0.35, 0.6)),
            start_s=0.2,
        )  # fmt: skip
        scenario = replace(scenario, reference=spec)
    return kind, scenario


def stands(task: tuple[int, str, dict[str, Any]]) -> bool:
    """Whether a controller is still up at the end."""
    seed, controller, settings = task
    return not run(replace(scenario_of(seed)[1], controller=settings), controller).summary["fell"]


def main() -> None:
    """Count."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=48)
    parser.add_argument("--last", type=int, default=144)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("controllers", nargs="*", default=DEFAULT)
    asked = parser.parse_args()
    seeds = range(asked.first, asked.last)
    kinds = [scenario_of(seed)[0] for seed in seeds]
    with ProcessPoolExecutor(asked.workers) as pool:
        for one in bench_entries(",".join(asked.controllers), {}):
            if one.scenario:
                parser.error(f"{one.label}: these mixtures have plants of their own")
            up = list(pool.map(stands, [(seed, one.controller, dict(one.changes)) for seed in seeds]))
            by_kind = ", ".join(
                f"{kind} {sum(ok for ok, k in zip(up, kinds, strict=True) if k == kind)}/{kinds.count(kind)}"
                for kind in KINDS
            )
            fell = [seed for seed, ok in zip(seeds, up, strict=True) if not ok]
            print(f"{one.label}: {sum(up)}/{len(up)} ({by_kind}); fell: {fell}", flush=True)


if __name__ == "__main__":
    main()
