"""Packages with controllers and estimators, as pip would install them, and controllers that fail."""

import importlib
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from surefoot.control.registry import ENTRY_POINT_GROUP, forget_controllers
from surefoot.estimation.registry import forget_estimators

FAILS_AT_S = 0.05

_FAILING = f"""
import time
from dataclasses import replace

import numpy as np

from surefoot.control.controllers.two_part import TwoPart
from surefoot.control.registry import ControllerEntry


class Failing(TwoPart):
    def fail(self, output):
        raise RuntimeError("no idea [red] what to do")

    def tick(self, terms, reference, sensing):
        output = super().tick(terms, reference, sensing)
        return self.fail(output) if terms.state.time_s > {FAILS_AT_S} - 1e-6 else output


class Raises(Failing):
    pass


class GivesNothing(Failing):
    def fail(self, output):
        return None


class GivesTooFew(Failing):
    def fail(self, output):
        return replace(output, torques=output.torques[:14])


class GivesNan(Failing):
    def fail(self, output):
        return replace(output, torques=np.full(15, np.nan))


class Leaves(Failing):
    def fail(self, output):
        raise SystemExit(3)


class Unready(TwoPart):
    def __init__(self, robot, settings):
        raise KeyError("a file of mine")


class Stubborn(TwoPart):
    def reset(self, last_torques=None):
        raise RuntimeError("I do not take over")


class Slow(TwoPart):
    def tick(self, terms, reference, sensing):
        time.sleep(0.05)
        return super().tick(terms, reference, sensing)


raises, nothing, too_few, nan, leaves, unready, stubborn, slow = (
    ControllerEntry(kind.__name__.lower(), "fails", kind)
    for kind in (Raises, GivesNothing, GivesTooFew, GivesNan, Leaves, Unready, Stubborn, Slow)
)
"""
_ENTRIES = ("raises", "nothing", "too_few", "nan", "leaves", "unready", "stubborn", "slow")

FAILING = {  # name of a controller that fails in a tick -> what is said of it
    "raises": "RuntimeError: no idea [red] what to do (failing_controllers.py, line",
    "givesnothing": "tick gave a NoneType, not a ControlOutput",
    "givestoofew": "tick gave torques of shape (14,) and type float64, not 15 numbers",
    "givesnan": "tick gave torques that no motor has, nan N m among them",
    "leaves": "SystemExit: 3",
}


def put_package(folder: Path, name: str, points: Mapping[str, str], group: str = ENTRY_POINT_GROUP) -> Path:
    """Write the folder that says what a package is: its controllers are entry points, name -> value."""
    info = folder / f"{name.replace('-', '_')}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    lines = [f"{point} = {value}" for point, value in points.items()]
    (info / "entry_points.txt").write_text("\n".join((f"[{group}]", *lines, "")))
    return info


def put_failing_controllers(folder: Path) -> None:
    """Write a package with those of ``FAILING``, and ``unready``, ``stubborn`` and ``slow``."""
    (folder / "failing_controllers.py").write_text(_FAILING)
    put_package(folder, "failing-controllers", {name: f"failing_controllers:{name}" for name in _ENTRIES})


@contextmanager
def installed(folder: Path) -> Iterator[None]:
    """Let this process find a folder's packages."""
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    forget_controllers()
    forget_estimators()
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for module in folder.glob("*.py"):
            sys.modules.pop(module.stem, None)
        forget_controllers()
        forget_estimators()
