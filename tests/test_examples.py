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


@pytest.mark.parametrize("script", sorted(EXAMPLES.glob("*.py")), ids=lambda script: script.name)
def test_script(script, tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "app")}
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, cwd=tmp_path, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()


def test_the_first_example_shows_the_papers_point(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "app")}
    command = [sys.executable, str(EXAMPLES / "00_run_scenario.py")]
    said = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=environment, check=True).stdout
    assert "optimization falls at" in said and "two-part stands" in said


def test_every_cell_of_the_notebook_runs(tmp_path):
    notebook = json.loads((EXAMPLES / "03_notebook.ipynb").read_text(encoding="utf-8"))
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert all(not cell["outputs"] for cell in notebook["cells"] if cell["cell_type"] == "code"), "clear the outputs"
    (tmp_path / "notebook.py").write_text("\n".join(cells), encoding="utf-8")
    names = runpy.run_path(str(tmp_path / "notebook.py"))
    assert names["fallen"].fell and not names["stands"].fell


def test_the_controller_of_the_second_example_is_there():
    assert (ROOT / "tests" / "contest" / "example_controller" / "pyproject.toml").is_file()
