"""Every example runs as it stands, in a folder of its own."""

import json
import os
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "scripts" / "examples"


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("00_run_scenario.py", ["optimization falls at", "two-part stands"]),  # the paper's point
        ("02_sweep_setting.py", ["com_stiffness 30: ", "com_stiffness 120: "]),
    ],
)
def test_script(script, said, tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "app")}
    done = subprocess.run(
        [sys.executable, str(EXAMPLES / script)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert all(text in done.stdout for text in said)


def test_no_example_is_left_out():
    assert {script.name for script in EXAMPLES.glob("*.py")} == {"00_run_scenario.py", "02_sweep_setting.py"}


def test_every_cell_of_the_notebook_runs(tmp_path):
    notebook = json.loads((EXAMPLES / "03_notebook.ipynb").read_text(encoding="utf-8"))
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert all(not cell["outputs"] for cell in notebook["cells"] if cell["cell_type"] == "code"), "clear the outputs"
    (tmp_path / "notebook.py").write_text("\n".join(cells), encoding="utf-8")
    names = runpy.run_path(str(tmp_path / "notebook.py"))
    assert names["fallen"].fell and not names["stands"].fell
