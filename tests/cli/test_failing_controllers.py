"""What a person sees of a controller from outside that fails: an ordinary end of the run, its files, and its name."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from surefoot.cli.main import main
from tests.support.plug_ins import FAILING, FAILS_AT_S, installed, put_failing_controllers

ROOT = Path(__file__).resolve().parents[2]
TICKS = round(FAILS_AT_S / 1e-3)


@pytest.fixture
def site(tmp_path):
    """A folder in which controllers that fail are installed, for this process too."""
    folder = tmp_path / "site"
    folder.mkdir()
    put_failing_controllers(folder)
    with installed(folder):
        yield folder


def test_the_run_ends_in_order_and_its_ticks_are_kept(site, tmp_path):
    out = tmp_path / "run.npz"
    path = os.pathsep.join((str(site), str(ROOT / "app")))
    command = [sys.executable, "-m", "surefoot", "run", "stand_left", "--controller", "raises", "--out", str(out)]
    environment = {**os.environ, "PYTHONPATH": path, "COLUMNS": "200"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
    assert "stand_left under raises: fell at 0.050 s: the controller failed" in done.stdout
    assert f"controller raises: {FAILING['raises']}" in done.stdout
    with np.load(out) as archive:
        assert len(archive["table"]) == TICKS
        assert json.loads(str(archive["summary"]))["fall_cause"] == "controller_error"


@pytest.mark.parametrize(("name", "kind"), list(zip(FAILING, ("json", "csv", "json", "csv", "json"), strict=True)))
def test_whatever_it_does_the_summary_names_it(site, tmp_path, capsys, name, kind):
    out = tmp_path / f"run.{kind}"
    main(["run", "stand_left", "--controller", name, "--json", "--out", str(out)])
    summary = json.loads(capsys.readouterr().out)
    assert (summary["fell"], summary["fall_cause"], summary["fall_time_s"]) == (True, "controller_error", FAILS_AT_S)
    assert summary["error"].startswith(f"controller {name}: {FAILING[name]}")
    if kind == "csv":
        assert len(out.read_text().splitlines()) == 1 + TICKS
    else:
        assert json.loads(out.read_text())["error"] == summary["error"]


def test_one_that_fails_at_once_has_a_summary_too(site, monkeypatch, tmp_path, capsys):
    import failing_controllers  # pyright: ignore[reportMissingImports]  (installed by the fixture)

    monkeypatch.setattr(failing_controllers.Raises, "tick", lambda *_: None)
    for kind in ("npz", "csv", "parquet"):
        main(["run", "stand_left", "--controller", "raises", "--out", str(tmp_path / f"run.{kind}")])
    said = capsys.readouterr().out
    assert "fell at 0.000 s" in said
    assert "a NoneType" in said


def test_one_that_cannot_be_built_is_refused_in_one_line(site, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["run", "stand_left", "--controller", "unready"])
    assert ended.value.code == 2
    assert capsys.readouterr().err == "surefoot: controller unready: cannot be built (KeyError: 'a file of mine')\n"
