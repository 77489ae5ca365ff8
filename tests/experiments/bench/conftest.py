"""The tiny bench, here and as a program of its own."""

import contextlib
import importlib.util
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest

from surefoot.experiments.bench.episode import GroundHistory

PROGRAM = Path(__file__).with_name("tiny_bench.py")
ROOT = Path(__file__).resolve().parents[3]


def _module(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name(f"{name}.py"))
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def tiny() -> ModuleType:
    return _module("tiny_bench")


@pytest.fixture(scope="session")
def point_mass() -> Callable[..., GroundHistory]:
    """Ground histories made by hand: see ``pushed_point_mass``."""
    return _module("point_mass").pushed_point_mass


@pytest.fixture
def start_tiny() -> Iterator[Callable[..., subprocess.Popen]]:
    """Folder, workers and perhaps a flag file -> the running program, leader of a process group of its own."""
    started = []

    def start(*arguments: object) -> subprocess.Popen:
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "app"), "OMP_NUM_THREADS": "1"}
        command = [sys.executable, str(PROGRAM), *map(str, arguments)]
        process = subprocess.Popen(command, env=environment, start_new_session=True)
        started.append(process)
        return process

    yield start
    for process in started:  # workers of a killed program
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


@pytest.fixture(scope="session")
def finished_tiny(tiny, tmp_path_factory) -> Path:
    """The folder of a tiny bench run in one go, in this process."""
    folder = tmp_path_factory.mktemp("one_go")
    tiny.run_bench(tiny.tiny_bench(), folder, workers=1)
    return folder
