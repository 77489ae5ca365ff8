#!/usr/bin/env python3
"""Says where two commits give another result: every shipped scenario under every controller, to the last digit.

Usage: .venv/bin/python scripts/compare_runs.py CHECKOUT [--scenarios stand_left,...] [--controllers two-part,...]

CHECKOUT is a working tree of another commit (``git worktree add ../then COMMIT``). Each runs in a process of its own
what ``surefoot run SCENARIO --controller NAME --json`` runs; all of the JSON is compared but the times of the wall
clock, the commit and what only one of them tells. Exit code 1 when anything differs. A quarter of an hour on two cores.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
CONTROLLERS = "two-part,optimization,soft-qp,two-part-literal"
NOT_COMPARED = ("tick_us_median", "tick_us_p99", "real_time_factor", "git_commit")
# In each checkout: the command itself, its output caught; one line of JSON for each run.
PROGRAM = """
import contextlib, io, json, sys
from {command} import main
for scenario in sys.argv[1].split(","):
    for controller in sys.argv[2].split(","):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            main(["run", scenario, "--controller", controller, "--json"])
        print(json.dumps([scenario, controller, json.loads(out.getvalue())]), flush=True)
"""


def shipped() -> list[str]:
    """Names of the scenarios of this checkout."""
    folder = HERE / "app" / "surefoot" / "experiments" / "scenario" / "shipped"
    return sorted(file.stem for file in folder.glob("*.toml"))


def start(checkout: Path, scenarios: str, controllers: str) -> subprocess.Popen[str]:
    """Start all runs of a checkout."""
    renamed = (checkout / "app" / "surefoot").is_dir()  # before that the package was called app
    source = checkout / "app" if renamed else checkout
    flat = not renamed and (checkout / "app" / "cli.py").is_file()
    command = "surefoot.cli.main" if renamed else "app.cli" if flat else "app.cli.main"
    environment = {**os.environ, "PYTHONPATH": str(source)}
    arguments = [sys.executable, "-P", "-W", "ignore", "-c", PROGRAM.format(command=command), scenarios, controllers]
    return subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True, cwd=checkout, env=environment)


def compared(line: str) -> tuple[str, dict[str, object]]:
    """Name and result of a run."""
    scenario, controller, result = json.loads(line)
    return f"{scenario} | {controller}", {key: value for key, value in result.items() if key not in NOT_COMPARED}


def main() -> None:
    """Run both, compare line by line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkout", type=Path)
    parser.add_argument("--scenarios", default=",".join(shipped()))
    parser.add_argument("--controllers", default=CONTROLLERS)
    wanted = parser.parse_args()
    one, other = (start(c, wanted.scenarios, wanted.controllers) for c in (HERE, wanted.checkout.resolve()))
    assert one.stdout is not None and other.stdout is not None
    runs, different = 0, 0
    alone: set[str] = set()
    for ours, theirs in zip(one.stdout, other.stdout, strict=True):
        (name, now), (_, then) = compared(ours), compared(theirs)
        runs += 1
        alone |= now.keys() ^ then.keys()
        keys = [key for key in sorted(now.keys() & then.keys()) if now[key] != then[key]]
        if keys:
            different += 1
            print(f"{name}: " + "; ".join(f"{key} {then[key]} -> {now[key]}" for key in keys), flush=True)
    if alone:
        print(f"told by one of them only: {', '.join(sorted(alone))}")
    failed = [process.wait() for process in (one, other)]
    print(f"{runs} runs, {different} differ")
    sys.exit(1 if different or any(failed) or not runs else 0)


if __name__ == "__main__":
    main()
