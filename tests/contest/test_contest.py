"""A controller from outside takes part: installed, listed, run by the real command, ranked by the bench's own probe."""

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
PAGE = ROOT / "static" / "help" / "contest.md"


@pytest.fixture
def install(tmp_path):
    """Put a package into a folder of its own, as ``pip install --target`` would: its modules, and its dist-info."""

    def put(name: str) -> Path:
        project = tomllib.loads((HERE / name / "pyproject.toml").read_text())
        target, about = tmp_path / "site", project["project"]
        info = target / f"{about['name'].replace('-', '_')}-{about['version']}.dist-info"
        info.mkdir(parents=True)
        for module in project["tool"]["hatch"]["build"]["targets"]["wheel"]["only-include"]:
            shutil.copy(HERE / name / module, target / module)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {about['name']}\nVersion: {about['version']}\n")
        points = [
            f"[{group}]\n" + "\n".join(f"{key} = {value}" for key, value in entries.items())
            for group, entries in about["entry-points"].items()
        ]
        (info / "entry_points.txt").write_text("\n".join(points) + "\n")
        return target

    return put


@pytest.fixture
def surefoot():
    def call(site: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(site), str(ROOT))), "COLUMNS": "200"}
        command = [sys.executable, "-m", "app", *arguments]
        return subprocess.run(command, capture_output=True, text=True, env=environment, cwd=site, timeout=120)

    return call


@pytest.mark.parametrize("scenario", ["push_left", "stand_double"])
def test_the_worked_example_runs_by_its_name(install, surefoot, scenario):
    changes = ("--set", "duration_s=1.6") if scenario == "push_left" else ("--set", "duration_s=0.5")
    done = surefoot(install("example_controller"), "run", scenario, "--controller", "dcm", "--json", *changes)
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert summary["controller"] == "dcm"
    assert summary["fell"] is False
    assert summary["com_error_max_m"] < 0.1


def test_the_settings_it_documents_reach_it(install, surefoot):
    site = install("example_controller")
    done = surefoot(site, "run", "stand_left", "--controller", "dcm", "--set", "controller.zmp_margin=9")
    assert done.returncode == 2
    assert "zmp_margin" in done.stderr


def test_without_the_package_the_name_is_unknown(tmp_path, surefoot):
    done = surefoot(tmp_path, "run", "stand_left", "--controller", "dcm")
    assert done.returncode == 2
    assert "no such controller" in done.stderr


def test_tsid_is_refused_in_one_line_where_it_cannot_be_imported(install, surefoot):
    """Where TSID can be imported the adapter itself is on trial, and nobody has run it yet."""
    site = install("tsid_controller")
    try_it = subprocess.run([sys.executable, "-c", "import tsid"], capture_output=True)
    if try_it.returncode == 0:
        pytest.skip("TSID can be imported here: try `surefoot run stand_left --controller tsid`")
    done = surefoot(site, "run", "stand_left", "--controller", "tsid", "--set", "duration_s=0.01")
    assert done.returncode == 2
    assert "TSID cannot be imported" in done.stderr
    assert "Traceback" not in done.stderr
    others = surefoot(site, "run", "stand_left", "--controller", "two-part", "--set", "duration_s=0.01", "--json")
    assert others.returncode == 0, others.stderr


def test_a_package_that_cannot_be_loaded_is_named_in_one_line(install, surefoot):
    site = install("example_controller")
    (site / "surefoot_dcm.py").write_text("import no_such_module\n")
    done = surefoot(site, "run", "stand_left", "--set", "duration_s=0.01")
    assert done.returncode == 2
    assert "entry point dcm" in done.stderr
    assert "no_such_module" in done.stderr
    assert "Traceback" not in done.stderr


def test_the_page_shows_the_example_as_it_is():
    """Every block of the page that is taken from the example stands in it, line by line."""
    page = PAGE.read_text(encoding="utf-8")
    sources = [(HERE / "example_controller" / name).read_text() for name in ("pyproject.toml", "surefoot_dcm.py")]
    blocks = [found[2] for found in re.finditer(r"```(toml|python)\n(.*?)```", page, re.DOTALL)]
    assert len(blocks) >= 2
    for block in blocks:
        assert any(block.strip() in source for source in sources), block
