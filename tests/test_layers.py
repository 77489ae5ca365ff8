"""The house rules, read from the imports: who may know whom, and where each dependency may be named.

    geometry -> robot -> dynamics -> {momentum | task} -> gait -> control -> simulation -> experiments -> dashboard
             {dynamics | task} -> robot_import -> experiments
                     dynamics  -> estimation -> simulation

"A -> B" reads "A is used by B". Modules directly in surefoot/ (errors, resources, ...) are below all layers and know
none of them; the package itself, api, __main__ and cli are above and may know all. Every import counts.
"""

import functools
from pathlib import Path

import pytest

from tests.support.imports import FILES, SOURCE, imports

FIRST_LENGTH_REFUSED = 300

BASE, TOP = 0, 10
# What stands above all layers; the other modules directly in surefoot/ stand below
ABOVE = ("__main__", "api", "cli")
RANK = {
    "geometry": 1,
    "robot": 2,
    "dynamics": 3,
    "momentum": 4,  # momentum and task stand side by side: equal rank, no acquaintance; they meet in gait and control
    "task": 4,
    "gait": 5,
    "estimation": 5,  # beside gait, which it does not know: what it believes comes from readings alone
    "robot_import": 5,  # beside gait, which it does not know: it stands foreign robots in the controllers' postures
    "control": 6,
    "simulation": 7,
    "experiments": 8,
    "dashboard": 9,
}

# The dashboard's own layers, along its data flow; rooms of equal rank do not know each other.
DASHBOARD_RANK = {
    "messages": 1,
    "live": 2,
    "access": 2,
    "ui": 2,
    "engine": 3,
    "scene": 3,
    "panels": 4,
    "page": 5,
    "launch": 6,
    "replay": 7,
}
MOST_ARROWS = 30  # between two rooms of the dashboard

# Third-party package -> the only places under surefoot/ that may import it; a folder ends with a slash.
SCENE_VIEW = "surefoot/dashboard/scene/robot.py"
HOMES = {
    "pinocchio": ("surefoot/robot/pinocchio_library.py",),
    "mujoco": ("surefoot/simulation/", "surefoot/robot_import/", SCENE_VIEW),
    "qpsolvers": ("surefoot/control/qp/solver.py",),
    "daqp": ("surefoot/control/qp/solver.py",),
    "clarabel": ("surefoot/control/qp/solver.py",),
    "viser": ("surefoot/dashboard/",),
    "mjviser": ("surefoot/dashboard/",),
    "matplotlib": ("surefoot/experiments/plots/",),
    "pyarrow": ("surefoot/experiments/runs/table_file.py",),
    "mcap": ("surefoot/experiments/runs/mcap_file.py",),
    "threadpoolctl": ("surefoot/blas_threads.py",),
    "joblib": ("surefoot/experiments/bench/engine.py",),
    "distributed": ("surefoot/experiments/bench/engine.py",),
}

# Folder -> standard modules it must not import, and why.
CLOCKS = {"time", "datetime", "sched", "timeit", "threading", "asyncio"}
NO_CLOCK = {
    "surefoot/control/": "control also runs on recorded data: its time is an argument",
    "surefoot/simulation/": "a run repeats to the bit: no clock, no sleep",
    "surefoot/experiments/": "a run repeats to the bit: no clock, no sleep",
}

WINDOWS = ("surefoot/dashboard/panels/", "surefoot/dashboard/scene/")


def within(file: str, places: tuple[str, ...]) -> bool:
    """Whether a file is one of the places, or lies in a place that is a folder."""
    return any(file.startswith(place) if place.endswith("/") else file == place for place in places)


def rank(parts: list[str]) -> int:
    """Height of a module in the house; parts is its dotted name, e.g. ["surefoot", "control", "qp"]."""
    if len(parts) == 1 or parts[1] in ABOVE:
        return TOP
    return RANK.get(parts[1], BASE)


@functools.cache
def reaches_mujoco(dotted: str) -> bool:
    """Whether a module of the simulation names MuJoCo, itself or through its neighbours: it may hold MjData."""
    path = SOURCE / (dotted.replace(".", "/") + ".py")
    if not path.is_file():
        return True  # the folder's own names can be anything
    names = {name for _, name in imports(path.relative_to(SOURCE).as_posix(), path.read_text(encoding="utf-8"))}
    if any(name.split(".")[0] == "mujoco" for name in names):
        return True
    return any(name.startswith("surefoot.simulation.") and name != dotted and reaches_mujoco(name) for name in names)


def window_breach(name: str) -> str | None:
    """What is wrong with a panel or view that imports a module of ours, if anything."""
    if (name == "surefoot.control" or name.startswith("surefoot.control.")) and name != "surefoot.control.settings":
        return "panels and views send commands; of control they know the settings only (surefoot.control.settings)"
    if name == "surefoot.robot_import" or name.startswith("surefoot.robot_import."):
        return "panels and views get a robot's description, never what reads its files and holds MjData"
    if (name == "surefoot.simulation" or name.startswith("surefoot.simulation.")) and reaches_mujoco(name):
        return "panels and views get snapshots, never what holds MjData: import from a module that reaches no mujoco"
    return None


def dashboard_breach(own: list[str], other: list[str]) -> str | None:
    """What is wrong with one room of the dashboard that knows another, if anything."""
    me, they = (parts[2] if len(parts) > 2 else "" for parts in (own, other))
    if me == they or me not in DASHBOARD_RANK or they not in DASHBOARD_RANK:
        return None
    if DASHBOARD_RANK[they] > DASHBOARD_RANK[me]:
        return f"{they} is above {me}"
    return f"{me} and {they} do not know each other" if DASHBOARD_RANK[they] == DASHBOARD_RANK[me] else None


def layer_breach(file: str, name: str) -> str | None:
    """What is wrong with a file that imports a module of ours, if anything."""
    own = ["surefoot"] if file == "surefoot/__init__.py" else list(Path(file).with_suffix("").parts)
    other = name.split(".")
    if rank(other) > rank(own):
        return f"{other[1]} is to the right of {own[1]}"
    if rank(other) == rank(own) and own[1] in RANK and other[1] != own[1]:
        return f"{own[1]} and {other[1]} do not know each other"
    if own[1:2] == other[1:2] == ["dashboard"] and (problem := dashboard_breach(own, other)):
        return problem
    if file == SCENE_VIEW and other[1] == "simulation":
        return None  # it draws a copy of MjData, so it may know what makes one
    return window_breach(name) if within(file, WINDOWS) else None


def breaches(file: str, source: str) -> list[str]:
    """All broken house rules of one source, each as ``file:line: what and why``."""
    found = []
    for line, name in dict.fromkeys(imports(file, source)):
        package = name.split(".")[0]
        problem = None
        if name.startswith("surefoot."):
            problem = layer_breach(file, name)
        elif package in HOMES and not within(file, HOMES[package]):
            problem = f"only {' and '.join(HOMES[package])} may"
        elif package in CLOCKS:
            problem = next((reason for folder, reason in NO_CLOCK.items() if file.startswith(folder)), None)
        if problem:
            found.append(f"{file}:{line}: imports {name}: {problem}")
    return found


@pytest.mark.parametrize("file", FILES)
def test_imports_keep_the_house_rules(file):
    found = breaches(file, (SOURCE / file).read_text(encoding="utf-8"))
    assert not found, "\n" + "\n".join(found)


@pytest.mark.parametrize("file", FILES)
def test_files_stay_small(file):
    length = len((SOURCE / file).read_text(encoding="utf-8").splitlines())
    assert length < FIRST_LENGTH_REFUSED, f"{file} has {length} lines: split it into two ideas"


def test_every_folder_of_the_package_is_a_known_layer():
    folders = {Path(file).parts[1] for file in FILES if len(Path(file).parts) > 2}
    assert folders <= {*RANK, *ABOVE}


def test_every_room_of_the_dashboard_is_a_known_one_and_few_arrows_join_them():
    arrows = set()
    for file in (file for file in FILES if file.startswith("surefoot/dashboard/")):
        room = Path(file).with_suffix("").parts[2]
        assert room in DASHBOARD_RANK or room == "__init__"
        for _, name in imports(file, (SOURCE / file).read_text(encoding="utf-8")):
            parts = name.split(".")
            if parts[:2] == ["surefoot", "dashboard"] and len(parts) > 2 and parts[2] != room:
                arrows.add((room, parts[2]))
    assert len(arrows) <= MOST_ARROWS, sorted(arrows)


@pytest.mark.parametrize(
    ("file", "source"),
    [
        ("surefoot/dashboard/messages/x.py", "from surefoot.dashboard.live import playback"),
        ("surefoot/dashboard/live/x.py", "import surefoot.dashboard.engine.session"),
        ("surefoot/dashboard/ui/x.py", "from surefoot.dashboard.live.playback import Playback"),
        ("surefoot/dashboard/scene/x.py", "from surefoot.dashboard.engine import session"),
        ("surefoot/dashboard/panels/x.py", "from surefoot.dashboard.page import Page"),
        ("surefoot/geometry/x.py", "import surefoot.robot.description"),
        ("surefoot/errors.py", "from surefoot.geometry import rotations"),
        ("surefoot/robot/x.py", "from surefoot import dynamics"),
        ("surefoot/momentum/x.py", "from surefoot.task.reference import task_error"),
        ("surefoot/task/x.py", "from ..momentum import zmp"),
        ("surefoot/dynamics/x.py", "from ..control.qp import build"),
        ("surefoot/control/x.py", "def late():\n    from surefoot.simulation.plant import Plant"),
        ("surefoot/simulation/x.py", "import surefoot.experiments"),
        ("surefoot/experiments/x.py", "if TYPE_CHECKING:\n    from surefoot.dashboard import session"),
        ("surefoot/dashboard/x.py", "import surefoot.cli.main"),
        ("surefoot/estimation/x.py", "from surefoot.simulation.plant import Plant"),
        ("surefoot/control/x.py", "import mujoco"),
        ("surefoot/control/x.py", "import viser"),
        ("surefoot/control/x.py", "from time import perf_counter"),
        ("surefoot/control/x.py", "import threading"),
        ("surefoot/simulation/x.py", "from datetime import datetime"),
        ("surefoot/experiments/x.py", "import numpy, time"),
        ("surefoot/experiments/x.py", "import asyncio"),
        ("surefoot/momentum/x.py", "import pinocchio as pin"),
        ("surefoot/robot/feet.py", "import pinocchio"),
        ("surefoot/dashboard/engine/session.py", "import mujoco"),
        ("surefoot/dashboard/x.py", "import importlib\nimportlib.import_module('mujoco.viewer')"),
        ("surefoot/cli/main.py", "__import__('mujoco')"),
        ("surefoot/control/qp/x.py", "from qpsolvers import solve_qp"),
        ("surefoot/control/qp/x.py", "import daqp, clarabel"),
        ("surefoot/experiments/x.py", "import mjviser"),
        ("surefoot/dashboard/x.py", "import matplotlib.pyplot as plt"),
        ("surefoot/experiments/x.py", "import pyarrow.parquet as pq"),
        ("surefoot/dashboard/panels/x.py", "import mujoco"),
        ("surefoot/dashboard/panels/x.py", "from surefoot.control import registry"),
        ("surefoot/dashboard/panels/x.py", "from surefoot.robot_import.inspection import inspect_robot"),
        ("surefoot/dashboard/scene/robot.py", "import surefoot.robot_import.inspection"),
        ("surefoot/robot_import/x.py", "from surefoot.control.interface import Controller"),
        ("surefoot/robot/x.py", "import surefoot.robot_import.inspection"),
        ("surefoot/dashboard/scene/x.py", "from surefoot.control.settings_of_another import Gains"),
        ("surefoot/dashboard/scene/robot.py", "import surefoot.control.qp"),
        ("surefoot/dashboard/scene/x.py", "from surefoot.simulation import Plant"),
        ("surefoot/dashboard/panels/x.py", "import surefoot.simulation.no_such_module"),
    ],
)
def test_a_forbidden_import_is_found(file, source):
    found = breaches(file, source)
    assert found, f"{source!r} in {file} went unnoticed"
    last_line = source.count("\n") + 1
    assert all(text.startswith(f"{file}:{last_line}: imports ") for text in found)


@pytest.mark.parametrize(
    ("file", "source"),
    [
        (
            "surefoot/geometry/x.py",
            "import numpy as np\nfrom surefoot.errors import InvalidInput\nfrom surefoot import __version__",
        ),
        ("surefoot/momentum/x.py", "from surefoot.dynamics.terms import DynamicsTerms\nfrom . import zmp"),
        (
            "surefoot/control/x.py",
            "from surefoot.momentum import zmp\nfrom surefoot.task.reference import task_error\nimport math",
        ),
        ("surefoot/control/qp/solver.py", "import qpsolvers\nimport daqp\nimport clarabel"),
        ("surefoot/simulation/x.py", "import mujoco\nfrom surefoot.control.interface import ControlOutput"),
        (
            "surefoot/experiments/plots/x.py",
            "import matplotlib\nimport subprocess, importlib.metadata, multiprocessing",
        ),
        (
            "surefoot/dashboard/engine/session.py",
            "import time\nimport viser\nimport surefoot.simulation.plant",
        ),
        ("surefoot/dashboard/panels/x.py", "from surefoot.control.settings import Gains\nimport viser, time"),
        ("surefoot/dashboard/scene/robot.py", "import mujoco, mjviser"),
        (
            "surefoot/cli/main.py",
            "import time\nimport surefoot.dashboard.x\nfrom surefoot.geometry import polygon",
        ),
        ("surefoot/__init__.py", "import surefoot.dashboard"),
    ],
)
def test_an_allowed_import_is_left_alone(file, source):
    assert breaches(file, source) == []


def test_pinocchio_is_used_where_the_robot_is_read_and_its_dynamics_computed():
    door = "surefoot.robot.pinocchio_library"
    users = {file for file in FILES if door in {name for _, name in imports(file, (SOURCE / file).read_text())}}
    assert users == {
        "surefoot/robot/description.py",
        "surefoot/robot_import/agreement.py",
        "surefoot/robot_import/inspection.py",
        "surefoot/robot/leg_chains.py",
        "surefoot/robot/link_chains.py",
        "surefoot/robot/sizes.py",
        "surefoot/dynamics/imu_kinematics.py",
        "surefoot/dynamics/links.py",
        "surefoot/dynamics/model.py",
        "surefoot/dynamics/turns.py",
    }
