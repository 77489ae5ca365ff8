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

from app.experiments.lab.bench import BenchRequest, plan_bench, run_bench


def cpu_times() -> tuple[int, int, int]:
    """Ticks (all, idle, stolen) of all cores since the machine started; zeros where the system does not tell."""
    try:
        fields = [int(word) for word in Path("/proc/stat").read_text(encoding="ascii").splitlines()[0].split()[1:]]
    except OSError:
        return 0, 0, 0
    return sum(fields[:8]), fields[3] + fields[4], fields[7]


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

    before, ratios, tables = cpu_times(), [], set()
    for number in range(1, asked.rounds + 1):
        (one, first), (two, second) = timed(request, 1), timed(request, 2)
        ratios.append(one / two)
        tables |= {first, second}
        print(f"round {number}: 1 worker {one:.1f} s, 2 workers {two:.1f} s, ratio {ratios[-1]:.2f}", flush=True)
    everything, _, stolen = (now - then for now, then in zip(cpu_times(), before, strict=True))
    print(f"median ratio {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})")
    equal = "yes" if len(tables) == 1 else "NO"
    print(f"tables equal to the byte: {equal}; CPU steal {stolen / max(everything, 1):.1%}")


if __name__ == "__main__":
    main()
