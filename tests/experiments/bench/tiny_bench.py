"""A bench of a few hundred milliseconds; as a program it is what the tests interrupt and kill.

    python tiny_bench.py FOLDER WORKERS [FLAG]

With FLAG, a file that does not exist, the first worker that takes up a cell makes the file and kills itself.
"""

import os
import signal
import sys
from functools import partial
from pathlib import Path

from surefoot.experiments.bench.bench import Bench, BenchRequest, run_bench
from surefoot.experiments.bench.cell_runner import Row, run_cell
from surefoot.experiments.bench.cells import Case, Cell
from surefoot.experiments.bench.entries import bench_entries

DURATION_S = 0.25


def tiny_bench(duration_s: float = DURATION_S, controllers: str = "two-part-literal,optimization") -> Bench:
    """Pushes, slopes and swings that end long before anything comes to rest."""
    table = {"robot": "bip", "support": "left", "duration_s": duration_s}
    push = [{"direction_deg": 90.0, "impulse_ns": 0.0, "start_s": 0.02, "duration_s": 0.1}]
    cases = [
        Case(family="push", name="left", table={**table, "pushes": push}, knob="pushes.0.impulse_ns",
             levels=(0.001, 0.4, 1.1), unit="J/J_cap", goal=0.4),
        Case(family="slope", name="rises left", table={**table, "ground": {"direction_deg": 90.0}},
             knob="ground.slope_deg", levels=(1.0, 19.0), unit="deg"),
        Case(family="trunk", name="right",
             table={**table, "pushes": [{**push[0], "direction_deg": 270.0, "link": "trunk", "duration_s": 0.02}]},
             knob="pushes.0.impulse_ns", levels=(1.0, 400.0), unit="N s"),
        Case(family="swing", name="forward", table={**table, "reference": {"kind": "swing", "axis": "sagittal",
             "duration_s": 0.1, "start_s": 0.02}}, knob="reference.amplitude_m", levels=(0.001, 0.05), unit="m"),
    ]  # fmt: skip
    entries = bench_entries(controllers, {})
    cells = [Cell(case=case, label=c.label, controller=c.controller, code="x") for case in cases for c in entries]
    return Bench(request=BenchRequest(), entries=entries, cells=tuple(cells))


def kill_the_first_worker(cell: Cell, flag: str) -> list[Row]:
    """Run the cell, but the first to come here dies."""
    try:
        os.close(os.open(flag, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return run_cell(cell)
    os.kill(os.getpid(), signal.SIGKILL)
    return []


if __name__ == "__main__":
    folder, workers, *flag = sys.argv[1:]
    task = partial(kill_the_first_worker, flag=flag[0]) if flag else run_cell
    run_bench(tiny_bench(), Path(folder), workers=int(workers), task=task)
