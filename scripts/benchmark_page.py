#!/usr/bin/env python3
"""Measures the dashboard as it is used: one real page (headless Chromium, drawing in software), then more readers.

Usage: .venv/bin/python scripts/benchmark_page.py [--seconds 20] [--phases single,twin,readers] [--scenario walk_flat]
       [--elsewhere]

With --elsewhere the page is drawn on another machine: a client that reads all and draws nothing stands for it.
Everything shares the machine's cores. Per phase: simulated seconds per second (every second is one value), scene
updates a second, how long a click takes from the page's callback until a scene with its stone has been sent, frames
that the browser drew, and what of the machine went elsewhere (other programs, steal of the hypervisor). Nothing is
asserted.
"""

import argparse
import asyncio
import os
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlsplit

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from browser import opened_page
from machine import machine_times
from rich.console import Console
from rich.markup import escape
from rich.table import Table

READERS = 4
PHASES = ("single", "twin", "readers")
COUNT_FRAMES = "() => { window.drawn = 0; const f = () => { window.drawn++; requestAnimationFrame(f) }; f() }"


def browse(address: str) -> None:
    """A page in Chromium until standard input ends; prints ``ready``, then frames drawn whenever a line comes."""
    with opened_page(address) as page:
        page.get_by_role("tab", name="Twin", exact=True).click()
        page.evaluate(COUNT_FRAMES)
        print("ready", flush=True)
        for _ in sys.stdin:
            print(page.evaluate("() => window.drawn"), flush=True)


def read(address: str, readers: int) -> None:
    """Websocket clients that read everything until they are killed."""
    import viser
    from websockets.asyncio.client import connect

    async def reader() -> None:
        place = f"ws://{urlsplit(address).netloc}"
        async with connect(place, subprotocols=[f"viser-v{viser.__version__}"], max_size=None) as socket:  # type: ignore[list-item]
            async for _ in socket:
                pass

    async def all_of_them() -> None:
        await asyncio.gather(*(reader() for _ in range(readers)))

    asyncio.run(all_of_them())


class Helper:
    """This script once more, as a browser or as readers."""

    def __init__(self, role: str, address: str, *more: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, __file__, f"--{role}", address, *more],
            text=True,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,
        )

    def line(self, cmd: str = "") -> str:
        """The next line it prints, after asking for one."""
        assert self.process.stdin and self.process.stdout
        if cmd:
            self.process.stdin.write(cmd + "\n")
            self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def close(self, *, kill: bool = False) -> None:
        """End it."""
        if kill:
            self.process.kill()
        assert self.process.stdin
        self.process.stdin.close()
        self.process.wait()


def ours() -> float:
    """Jiffies used by this process and all that came from it."""
    parents: dict[int, int] = {}
    used: dict[int, float] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        parents[int(folder.name)] = int(words[1])
        used[int(folder.name)] = sum(float(word) for word in words[11:15])
    family = {os.getpid()}
    while new := {pid for pid, parent in parents.items() if parent in family and pid not in family}:
        family |= new
    return sum(used.get(pid, 0.0) for pid in family)


def measure(dashboard, browser: Helper | None, seconds: int) -> dict[str, str]:
    """One phase: name of a figure -> its text."""
    from surefoot.dashboard.messages.commands import ClearStones, PlaceStone

    session, page = dashboard.session, dashboard.page
    factors, updates, delays = [], [], []
    drawn_at_first = int(browser.line("frames?")) if browser else 0
    before, mine, started = machine_times(), ours(), time.perf_counter()
    for _ in range(seconds):
        ticks, frames, begun = session.statistics().ticks, page.frames, time.perf_counter()
        session.send(PlaceStone(x_m=1.5, y_m=-1.0, height_m=0.01, size_m=0.1))
        while not len(page.shown.geometry.stones) and time.perf_counter() - begun < 0.8:
            time.sleep(0.004)
        delays.append(1e3 * (time.perf_counter() - begun))
        session.send(ClearStones())
        time.sleep(max(0.0, begun + 1.0 - time.perf_counter()))
        span = time.perf_counter() - begun
        factors.append((session.statistics().ticks - ticks) * 1e-3 / span)
        updates.append((page.frames - frames) / span)
    span = time.perf_counter() - started
    machine, mine = machine_times() - before, ours() - mine
    drawn = int(browser.line("frames?")) - drawn_at_first if browser else 0
    low, delay = np.percentile(factors, 1), np.percentile(delays, 99)
    return {
        "real-time factor: mean, median, p1": f"{np.mean(factors):.3f}  {np.median(factors):.3f}  {low:.3f}",
        "scene updates/s: median, p1": f"{np.median(updates):.1f}  {np.percentile(updates, 1):.1f}",
        "mean update [ms]": f"{page.statistics.frame_ms:.2f}",
        "click to stone [ms]: median, p99": f"{np.median(delays):.0f}  {delay:.0f}",
        "browser frames/s": f"{drawn / span:.1f}" if browser else "elsewhere",
        "machine: ours, others, stolen [%]": f"{100 * mine / machine.all:.0f}  "
        f"{100 * (machine.busy - mine) / machine.all:.0f}  {100 * machine.stolen / machine.all:.1f}",
    }  # fmt: skip


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=20, help="of each phase")
    parser.add_argument("--phases", default=",".join(PHASES), help="out of " + ", ".join(PHASES))
    parser.add_argument("--scenario", default="stand_left", help="begins anew with every phase")
    parser.add_argument("--elsewhere", action="store_true", help="the page is drawn on another machine")
    parser.add_argument("--readers", type=int, default=READERS, help=argparse.SUPPRESS)
    parser.add_argument("--robot", help="a name, or an MJCF or robot.toml; without, the scenario's")
    parser.add_argument("--browse", help=argparse.SUPPRESS)
    parser.add_argument("--read", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.browse:
        return browse(arguments.browse)
    if arguments.read:
        return read(arguments.read, arguments.readers)

    from surefoot.dashboard.launch import start_dashboard
    from surefoot.dashboard.messages.commands import Reset, StartTwin, StopTwin

    dashboard = start_dashboard(port=0, scenario=arguments.scenario, robot=arguments.robot)
    browser = None if arguments.elsewhere else Helper("browse", dashboard.address)
    if browser:
        browser.line()
    client = Helper("read", dashboard.address, "--readers", "1") if browser is None else None
    time.sleep(3.0)
    results: dict[str, dict[str, str]] = {}
    for phase in arguments.phases.split(","):
        if phase == "single":
            dashboard.session.send(StopTwin())
            dashboard.session.send(Reset())
        elif dashboard.session.snapshot.twin is None:
            dashboard.session.send(StartTwin("two-part", {"guard": False}))  # the most expensive one, twice
        else:
            dashboard.session.send(Reset())
        readers = Helper("read", dashboard.address) if phase == "readers" else None
        time.sleep(3.0)
        results[phase] = measure(dashboard, browser, arguments.seconds)
        if readers:
            readers.close(kill=True)
    if browser:
        browser.close()
    if client:
        client.close(kill=True)
    dashboard.stop()

    robot = f" with {dashboard.session.snapshot.robot.title}" if arguments.robot else ""
    table = Table(
        "figure",
        *results,
        title=f"{arguments.scenario}{robot}, one page, {arguments.seconds} s each, {os.cpu_count()} cores",
    )
    for figure in next(iter(results.values())):
        table.add_row(escape(figure), *(found[figure] for found in results.values()))
    Console().print(table)
    os._exit(0)


if __name__ == "__main__":
    main()
