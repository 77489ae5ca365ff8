#!/usr/bin/env python3
"""Measures how soon a click on another tab is answered by a page that draws in software, with the tab Plots open.

Usage: .venv/bin/python scripts/benchmark_tabs.py [--clicks 20] [--settle 10]

Every click starts with the tab Plots open for a while; the time runs from the click of the mouse until the
page finds the other tab selected. Beside it: simulated seconds per second meanwhile (every second is one value), and
what the hypervisor took from the machine. Nothing is asserted.
"""

import argparse
import os
import subprocess
import sys
import threading
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from browser import opened_page
from machine import machine_times

SELECTED = """(name) => [...document.querySelectorAll('[role="tab"]')]
  .some((tab) => tab.textContent.trim() === name && tab.getAttribute("aria-selected") === "true")"""


def browse(address: str) -> None:
    """A page until standard input ends; a line with a tab's name clicks it and prints the time [ms]."""
    with opened_page(address) as page:
        boxes = {name: page.get_by_role("tab", name=name, exact=True).bounding_box() for name in ("Balance", "Plots")}
        places = {name: (box["x"] + 15, box["y"] + 15) for name, box in boxes.items() if box}
        print("ready", flush=True)
        for line in sys.stdin:
            name = line.strip()
            started = time.perf_counter()
            page.mouse.click(*places[name])
            page.wait_for_function(SELECTED, arg=name)
            print(1e3 * (time.perf_counter() - started), flush=True)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--clicks", type=int, default=20)
    parser.add_argument("--settle", type=float, default=10.0, help="seconds with Plots open before the first click")
    parser.add_argument("--browse", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.browse:
        return browse(arguments.browse)

    from surefoot.dashboard.launch import start_dashboard

    dashboard = start_dashboard(port=0)
    command = [sys.executable, __file__, "--browse", dashboard.address]
    helper = subprocess.Popen(command, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert helper.stdin and helper.stdout
    helper.stdout.readline()
    print("the page is open", file=sys.stderr, flush=True)

    def click(tab: str) -> float:
        assert helper.stdin and helper.stdout
        helper.stdin.write(tab + "\n")
        helper.stdin.flush()
        return float(helper.stdout.readline())

    click("Plots")
    time.sleep(arguments.settle)
    times: list[float] = []
    factors: list[float] = []
    over = threading.Event()

    def watch() -> None:
        while True:
            ticks, begun = dashboard.session.statistics().ticks, time.perf_counter()
            if over.wait(1.0):
                return  # a second that was cut short
            simulated = (dashboard.session.statistics().ticks - ticks) * 1e-3
            factors.append(simulated / (time.perf_counter() - begun))

    watcher, before = threading.Thread(target=watch), machine_times()
    watcher.start()
    for _ in range(arguments.clicks):
        times.append(click("Balance"))
        print(f"{times[-1]:.0f} ms", file=sys.stderr, flush=True)
        click("Plots")
        time.sleep(1.0)
    over.set()
    watcher.join()
    machine, low = machine_times() - before, np.percentile(factors, 1)
    middle, most, worst = np.percentile(times, [50, 90, 100])
    print(f"click to tab [ms]: median {middle:.0f}, p90 {most:.0f}, worst {worst:.0f}")
    print(f"real-time factor: mean {np.mean(factors):.3f}, median {np.median(factors):.3f}, p1 {low:.3f}")
    print(f"stolen from the machine: {100 * machine.stolen / max(machine.all, 1.0):.1f} %", flush=True)
    helper.stdin.close()
    helper.wait()
    os._exit(0)


if __name__ == "__main__":
    main()
