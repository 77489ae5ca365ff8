"""The real command in a process of its own, and the scenario file of the documentation."""

import os
import resource
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

FULL_EXAMPLE = """\
robot = "bip"
support = "left"            # left | right | double
duration_s = 0.05
com_height_m = 0.975        # optional, as is everything below

[reference]                 # kind = "hold" | "swing"
kind = "swing"
axis = "lateral"            # lateral (positive = left) | sagittal (positive = forward)
amplitude_m = -0.035        # rest to rest by a quintic, then it stays there
duration_s = 0.45
start_s = 0.2

[[stones]]
x_m = 0.05                  # centre, relative to the point below the stance ankle at t = 0, world axes
y_m = 0.07
height_m = 0.01
size_m = [0.06, 0.05]
rise_start_s = 0.5
rise_duration_s = 0.3

[[stones]]
height_m = 0.02

[[pushes]]
link = "trunk"              # a link, or "com": through the whole robot's centre of mass
direction_deg = 90.0        # 0 = forward, 90 = to the left
impulse_ns = 10.0
start_s = 1.0
duration_s = 0.1

[physics]
friction = 0.8
mass_scale = 1.05
control_delay_s = 0.001
torque_limits = false

[controller]
saturation = "clip"
com_stiffness = 50.0
guard = false
"""


def _command(*arguments: str | Path) -> tuple[list[str], dict[str, str]]:
    """What to type, and the environment to type it in."""
    environment = {**os.environ, "COLUMNS": "200", "PYTHONPATH": str(ROOT / "app")}
    return [sys.executable, "-m", "surefoot", *map(str, arguments)], environment


def call_surefoot(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run the command to its end; nothing is checked."""
    command, environment = _command(*arguments)
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment, timeout=120)


@contextmanager
def running_surefoot(*arguments: str | Path, largest_file: int | None = None) -> Iterator[subprocess.Popen[str]]:
    """The command while it runs; killed in the end, if it still does. No file of its may get larger [bytes]."""
    command, environment = _command(*arguments)

    def limit() -> None:
        if largest_file is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, text=True, cwd=ROOT, env=environment, preexec_fn=limit, **pipes) as process:
        try:
            yield process
        finally:
            process.kill()
