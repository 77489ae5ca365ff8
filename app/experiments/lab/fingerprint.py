"""Which code decides an outcome: a finished cell is used again only while this has not changed."""

import hashlib
import inspect
import json
from functools import lru_cache
from pathlib import Path

import app
from app.control.registry import controller_named
from app.experiments.provenance import versions
from app.resources import resource_folder

# What an outcome depends on; the rest of the program may change while a bench is under way.
_DECIDES = (
    "geometry", "robot", "dynamics", "momentum", "task", "control", "simulation", "fields.py", "experiments/build.py",
    "experiments/references.py", "experiments/scenario.py", "experiments/lab/bounds.py", "experiments/lab/cells.py",
    "experiments/lab/criteria.py", "experiments/lab/episode.py", "experiments/lab/excursion.py",
    "experiments/lab/ledger.py", "experiments/lab/probe.py", "experiments/lab/search.py",
)  # fmt: skip


@lru_cache(maxsize=1)
def code_fingerprint() -> str:
    """Hash of the sources, the robot files and the versions of the packages that compute."""
    root = Path(app.__file__).parent
    files = [root / name for name in _DECIDES if name.endswith(".py")]
    files += [file for name in _DECIDES if not name.endswith(".py") for file in (root / name).rglob("*.py")]
    files += resource_folder("robot_models").rglob("*.xml")
    digest = hashlib.sha256(json.dumps(versions(), sort_keys=True).encode())
    for file in sorted(files):
        digest.update(file.name.encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def controller_fingerprint(name: str) -> str:
    """The same with the file that a controller from outside is written in."""
    build = controller_named(name).build
    try:
        source = Path(inspect.getsourcefile(build) or "")
    except TypeError:  # a callable object: its class
        source = Path(inspect.getsourcefile(type(build)) or "")
    own = source.read_bytes() if source.is_file() else b""
    return hashlib.sha256(code_fingerprint().encode() + own).hexdigest()[:16]
