"""Files of a run, made away from the simulation: in a process of their own where that takes long."""

import io
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np
from PIL import Image

from surefoot.experiments.runs.run_writer import npz_bytes, parquet_bytes, write_run
from surefoot.experiments.runs.saved_run import SavedRun

_QUICK: Mapping[str, Callable[[SavedRun], bytes]] = MappingProxyType({"parquet": parquet_bytes, "npz": npz_bytes})
_PATIENCE_S = 300.0


def file_name(run: SavedRun, suffix: str) -> str:
    """``surefoot-SCENARIO-CONTROLLER.SUFFIX``."""
    return f"surefoot-{run.manifest['scenario_name']}-{run.manifest['controller']}.{suffix}"


def run_bytes(run: SavedRun, suffix: str) -> bytes:
    """The file of that kind. Raises RuntimeError.

    What takes long is made by another process: this one has a simulation to keep up with.
    """
    if suffix in _QUICK:
        return _QUICK[suffix](run)
    with tempfile.TemporaryDirectory(prefix="surefoot-") as folder:
        source, out = Path(folder) / "run.npz", Path(folder) / f"run.{suffix}"
        write_run(run, source)
        command = [sys.executable, "-m", "surefoot", "replay", str(source), "--out", str(out)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=_PATIENCE_S, check=False)
        if done.returncode != 0 or not out.is_file():
            raise RuntimeError(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "it was not written")
        return out.read_bytes()


def png_bytes(pixels: np.ndarray) -> bytes:
    """A picture (h, w, 3 or 4) as PNG."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, format="PNG")
    return file.getvalue()
