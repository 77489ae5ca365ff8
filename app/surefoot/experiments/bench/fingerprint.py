"""Which code decides an outcome: a finished cell is used again only while this has not changed."""

import hashlib
import json
from functools import lru_cache
from pathlib import Path

import surefoot
from surefoot.experiments.bench.plug_ins import plug_in
from surefoot.experiments.runs.provenance import versions
from surefoot.resources import resource_folder

# What an outcome depends on; the rest of the program may change while a bench is under way.
_DECIDES = (
    "geometry", "robot", "dynamics", "momentum", "task", "control", "simulation", "field_metadata.py",
    "experiments/scenario", "experiments/bench/bounds.py", "experiments/bench/cells.py",
    "experiments/bench/criteria.py", "experiments/bench/episode.py", "experiments/bench/swing_margins.py",
    "experiments/bench/impulse_budget.py", "experiments/bench/cell_runner.py", "experiments/bench/search.py",
)  # fmt: skip


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


def controller_fingerprint(name: str) -> str:
    """The same; of a controller from outside with all code of its package and the versions of what that needs."""
    found = plug_in(name)
    if found is None:
        return code_fingerprint()
    about = [code_fingerprint(), found.package, found.version, found.requires]
    digest = hashlib.sha256(json.dumps(about, sort_keys=True).encode())
    for file in found.files:
        digest.update(file.name.encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]
