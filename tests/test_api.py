"""The names for users: lazy, complete, and the same ticks to the bit wherever a run is made."""

import contextlib
import os
import subprocess
import sys
from pathlib import Path

import joblib
import numpy as np
import pytest

import surefoot
from surefoot.dashboard.live.playback import Playback

SOURCE = Path(__file__).resolve().parents[1] / "app"
SHORT = {"duration_s": 1.2, "pushes.0.start_s": 0.3}
TICKS = 1200


def python(code, **options):
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, **options)


@pytest.fixture(scope="module")
def pushed():
    return surefoot.run("push_left", "two-part", changes=SHORT)


def test_importing_it_loads_nothing_heavy():
    heavy = {"mujoco", "pinocchio", "viser", "matplotlib", "pyarrow", "scipy", "surefoot.api"}
    done = python(f"import surefoot, sys; print(*{heavy} & set(sys.modules)); surefoot.run")
    assert (done.returncode, done.stdout.strip()) == (0, ""), done.stderr


@pytest.mark.parametrize("name", surefoot.__all__)
def test_every_public_name_is_there_and_documented(name):
    assert getattr(surefoot, name).__doc__
    assert name in dir(surefoot)


def test_an_unknown_name_lists_the_known_ones():
    with pytest.raises(AttributeError, match=r"no attribute 'runn'.*load_scenario.*run"):
        surefoot.runn  # noqa: B018


def test_command_line_page_and_worker_make_the_same_bits(pushed, tmp_path):
    table = pushed.table.tobytes()
    assert len(pushed.table) == TICKS

    command = [sys.executable, "-m", "surefoot", "run", "push_left", "--out", str(tmp_path / "run.npz")]
    for key, value in SHORT.items():
        command += ["--set", f"{key}={value}"]
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, "PYTHONPATH": str(SOURCE)})
    assert surefoot.open_run(tmp_path / "run.npz").table.tobytes() == table

    playback = Playback(surefoot.load_scenario("push_left", SHORT), "two-part")
    for _ in range(TICKS):
        playback.tick()
    assert playback.saved_run().table.tobytes() == table

    made = joblib.Parallel(n_jobs=2)(joblib.delayed(surefoot.run)("push_left", changes=SHORT) for _ in range(2))
    assert [run.table.tobytes() for run in made] == [table, table]


def test_what_a_run_tells(pushed):
    assert not pushed.fell and pushed.fall_time_s is None and pushed.fall_cause is None
    assert pushed.summary["scenario"] == "push_left"
    assert np.array_equal(pushed.column("time_s"), pushed.table[:, pushed.columns.index("time_s")])
    arrow = pushed.arrow()
    assert tuple(arrow.column_names) == pushed.columns and arrow.num_rows == TICKS
    assert b"manifest" in arrow.schema.metadata
    with pytest.raises(surefoot.InvalidInput, match="zmp_margin_m"):
        pushed.column("margin")


def test_a_fall_is_told():
    fallen = surefoot.run("paper_push_beyond", "two-part-literal")
    assert fallen.fell and fallen.fall_cause == fallen.summary["fall_cause"] and fallen.first_limit
    assert "fell at" in repr(fallen)


@pytest.mark.parametrize("suffix", [".npz", ".parquet"])
def test_saved_and_opened_it_is_the_same(pushed, suffix, tmp_path):
    pushed.save(tmp_path / f"run{suffix}")
    again = surefoot.open_run(tmp_path / f"run{suffix}")
    assert (again.table.tobytes(), again.columns) == (pushed.table.tobytes(), pushed.columns)
    assert again.summary["fell"] is False


def test_a_notebook_shows_summary_plot_and_replay(pushed, tmp_path):
    shown = pushed._repr_html_()
    assert "push_left" in shown and "data:image/png;base64," in shown and "<iframe" in shown
    pushed.save(tmp_path / "replay.html")
    assert "<html" in (tmp_path / "replay.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("path", ["run.csv", "no-such-folder/run.npz"])
def test_what_cannot_be_saved_is_told_in_a_line(pushed, path, tmp_path):
    with pytest.raises(surefoot.InvalidInput, match=r"path"):
        pushed.save(tmp_path / path)


def test_a_loaded_scenario_takes_no_changes(pushed):
    with pytest.raises(surefoot.InvalidInput, match="load_scenario"):
        surefoot.run(surefoot.load_scenario("stand_left"), changes={"duration_s": 0.1})


@pytest.mark.parametrize("wanted", [True, False])
def test_a_bar_is_shown_on_request(wanted, monkeypatch):
    shown = []
    monkeypatch.setattr("surefoot.api._bar", lambda what: contextlib.nullcontext(shown.append))
    surefoot.run("stand_left", changes={"duration_s": 0.12}, progress=wanted)
    assert shown == sorted(shown)
    assert shown[-1:] == ([1.0] if wanted else [])
