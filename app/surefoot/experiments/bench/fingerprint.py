"""Which code decides an outcome, controllers and estimators from outside included.

Finished cells of other code are not used again.
"""

import hashlib
import json
import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import Distribution, EntryPoint, PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

import surefoot
from surefoot.control.registry import controller_named, entry_point_of
from surefoot.estimation.registry import TRUTH, estimator_named, estimator_point
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.runs.provenance import versions
from surefoot.experiments.scenario.robots import is_robot_file, robot_named
from surefoot.resources import resource_folder

_NAME = re.compile(r"\s*([A-Za-z0-9._-]+)\s*(?:\[([^]]*)\])?")
_EXTRA = re.compile(r"extra\s*==\s*['\"]([^'\"]+)['\"]")
_OURS = "surefoot"  # what surefoot itself needs is in every manifest
_CODE = (".py", ".so", ".pyd")


@dataclass(frozen=True)
class PlugIn:
    """The package of a controller or an estimator.

    Attributes:
        package, version: as installed.
        requires: package -> version of what it needs, and what that needs, as installed.
        files: its code.
    """

    package: str
    version: str
    requires: dict[str, str]
    files: tuple[Path, ...]

    def fingerprint_with(self, robot: str) -> str:
        """Hash of our code and a robot's files, all code of its package and the versions of what that needs."""
        about = [robot_fingerprint(robot), self.package, self.version, self.requires]
        digest = hashlib.sha256(json.dumps(about, sort_keys=True).encode())
        for file in self.files:
            digest.update(file.name.encode())
            digest.update(file.read_bytes())
        return digest.hexdigest()[:16]


def plug_in(name: str) -> PlugIn | None:
    """What brings a controller; None for ours. Raises InvalidInput for an unknown one."""
    return _brought(entry_point_of(name), controller_named(name).build)


def estimator_plug_in(name: str) -> PlugIn | None:
    """What brings an estimator; None for ours. Raises InvalidInput for an unknown one."""
    return _brought(estimator_point(name), estimator_named(name).build)


def _brought(point: EntryPoint | None, build: Any) -> PlugIn | None:
    if point is None:
        return None
    package = point.dist
    modules = (point.module, getattr(build, "__module__", None) or type(build).__module__)
    files = sorted({file for module in modules for file in _files(module.partition(".")[0])})
    if package is None:
        return PlugIn(point.module, "unknown", {}, tuple(files))
    needs = dict(sorted(_needs(package, (), set())))
    return PlugIn(package.name, package.version, needs, tuple(files))


def _files(module: str) -> list[Path]:
    """All code of a top-level module; none of ours, which has a fingerprint of its own."""
    file = getattr(sys.modules.get(module), "__file__", None)
    if module == "surefoot" or file is None:
        return []
    path = Path(file)
    if path.stem != "__init__":
        return [path]
    return [found for found in path.parent.rglob("*") if found.suffix in _CODE]


def _needs(
    package: Distribution, extras: Sequence[str], seen: set[tuple[str, tuple[str, ...]]]
) -> Iterator[tuple[str, str]]:
    """(name, version) of all that a package needs, down to the last; what is not installed is left out."""
    for text in package.requires or ():
        match, only_with = _NAME.match(text), _EXTRA.search(text)
        if match is None or (only_with and only_with[1] not in extras):
            continue
        if package.name == _OURS and not only_with:
            continue
        asked = tuple(extra.strip() for extra in (match[2] or "").split(",") if extra.strip())
        if (match[1], asked) in seen:
            continue
        seen.add((match[1], asked))
        try:
            needed = distribution(match[1])
        except PackageNotFoundError:
            continue
        if needed.name != _OURS:
            yield needed.name, needed.version
        yield from _needs(needed, asked, seen)


# What an outcome depends on; the rest of the program may change while a bench is under way.
_DECIDES = (
    "geometry",
    "robot",
    "dynamics",
    "momentum",
    "task",
    "gait",
    "estimation",
    "control",
    "simulation",
    "robot_import",
    "field_metadata.py",
    "record.py",
    "experiments/scenario",
    "experiments/runs/belief_tally.py",
    "experiments/runs/walk_tally.py",
    *(f"experiments/bench/{name}.py" for name in ("cells", "criteria", "episode", "impulse_budget", "cell_runner")),
)


@lru_cache(maxsize=1)
def code_fingerprint() -> str:
    """Hash of the sources, the robot files and the versions of the packages that compute."""
    root = Path(surefoot.__file__).parent
    files = [root / name for name in _DECIDES if name.endswith(".py")]
    files += [file for name in _DECIDES if not name.endswith(".py") for file in (root / name).rglob("*.py")]
    files += resource_folder("robot_models").rglob("*.xml")
    digest = hashlib.sha256(json.dumps(versions(), sort_keys=True).encode())
    for file in sorted(files):
        digest.update(file.name.encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def robot_fingerprint(robot: str) -> str:
    """The same with a robot's own files, if it is not one of ours. Raises InvalidInput."""
    if not is_robot_file(robot):
        return code_fingerprint()
    return hashlib.sha256(f"{code_fingerprint()} {robot_named(robot).sha256}".encode()).hexdigest()[:16]


def controller_fingerprint(name: str, robot: str = BIP) -> str:
    """The same; of a controller from outside with all code of its package and the versions of what that needs.

    Args:
        name: of the controller.
        robot: as a scenario names it; of one of somebody else's with its files.
    """
    found = plug_in(name)
    return robot_fingerprint(robot) if found is None else found.fingerprint_with(robot)


def entry_fingerprint(controller: str, estimator: str = TRUTH, robot: str = BIP) -> str:
    """Of a controller and a robot, with an estimator from outside that of both. Raises InvalidInput."""
    found = estimator_plug_in(estimator)
    return controller_fingerprint(controller, robot) + ("" if found is None else f"-{found.fingerprint_with(robot)}")
