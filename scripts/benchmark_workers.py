#!/usr/bin/env python3
"""Measures what a second worker brings to ``surefoot bench``: the same cells on one and on two processes, in turns.

Usage: .venv/bin/python scripts/benchmark_workers.py [--rounds 5] [--families push] [--controllers two-part,soft-qp]

Prints every round, the median ratio, whether the tables are equal to the byte, and the share of the CPU time that the
machine's owner took away (steal), without which a ratio on a virtual machine means little.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import hashlib
import statistics
import tempfile
import time
from pathlib import Path

from machine import machine_times

from surefoot.experiments.bench.bench import BenchRequest, plan_bench, run_bench


def timed(request: BenchRequest, workers: int) -> tuple[float, str]:
    """Seconds of one bench in an empty folder, and a fingerprint of its table."""
    bench = plan_bench(request)
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        table = run_bench(bench, Path(folder), workers=workers)
        return time.perf_counter() - began, hashlib.sha256(table.read_bytes()).hexdigest()


def main() -> None:
    """Alternate one and two workers."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--families", default="push")
    parser.add_argument("--controllers", default="two-part,soft-qp")
    asked = parser.parse_args()
    request = BenchRequest(controllers=asked.controllers, families=tuple(asked.families.split(",")), quick=True)

    before, ratios, tables = machine_times(), [], set()
    for number in range(1, asked.rounds + 1):
        (one, first), (two, second) = timed(request, 1), timed(request, 2)
        ratios.append(one / two)
        tables |= {first, second}
        print(f"round {number}: 1 worker {one:.1f} s, 2 workers {two:.1f} s, ratio {ratios[-1]:.2f}", flush=True)
    used = machine_times() - before
    print(f"median ratio {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})")
    equal = "yes" if len(tables) == 1 else "NO"
    print(f"tables equal to the byte: {equal}; CPU steal {used.stolen / max(used.all, 1.0):.1%}")


if __name__ == "__main__":
    main()
