"""A run that is killed, stopped, or meets a full disk: what it recorded is there, opens, and is right to the bit."""

import json
import signal
from pathlib import Path

import numpy as np
import pytest

from surefoot import open_run, run
from surefoot.cli.main import main
from surefoot.errors import InvalidInput
from surefoot.experiments.runs.run_reader import read_run
from surefoot.experiments.runs.saved_run import INTERRUPTED
from tests.support.cli import running_surefoot
from tests.support.waiting import wait_for

SCENARIO, PUSH = "stone_outer_edge", ("--set", "controller.guard=false")
FOR_EVER = ("run", SCENARIO, *PUSH, "--set", "duration_s=600", "--set", "stones.0.rise_start_s=500")
CHANGES = {"controller.guard": False, "stones.0.rise_start_s": 500.0}


def ticks_in(partial: Path) -> int:
    try:
        return len(read_run(partial).table) if partial.exists() else 0
    except InvalidInput:
        return 0  # only its manifest is there


def recorded_until(process, partial: Path) -> None:
    """Wait until a run has ticks on disk."""
    wait_for(lambda: ticks_in(partial) > 0 or process.poll() is not None)
    assert process.poll() is None, process.communicate()


@pytest.fixture(scope="module")
def left(tmp_path_factory) -> Path:
    """What a run leaves that was killed without warning."""
    out = tmp_path_factory.mktemp("killed") / "run.npz"
    partial = out.with_name("run.npz.partial")
    with running_surefoot(*FOR_EVER, "--out", out) as process:
        recorded_until(process, partial)
        process.send_signal(signal.SIGKILL)
        assert process.wait() == -signal.SIGKILL
    assert not out.exists()
    return partial


def test_what_a_killed_run_leaves_is_the_run_so_far_to_the_bit(left):
    with pytest.warns(UserWarning, match=r"interrupted at t = \d"):
        kept = open_run(left)
    again = run(SCENARIO, changes={**CHANGES, "duration_s": len(kept.table) * 1e-3})
    assert kept.columns == again.columns
    assert kept.table.tobytes() == again.table.tobytes()
    assert kept.interrupted_s == kept.column("time_s")[-1]
    assert "interrupted at t =" in repr(kept)
    first = {key: value for key, value in kept.manifest.items() if key not in ("events", "summary", INTERRUPTED)}
    made = json.loads(json.dumps(again.manifest))
    assert {**first, "scenario": {**first["scenario"], "duration_s": None}} == {
        **{key: value for key, value in made.items() if key not in ("events", "summary")},
        "scenario": {**made["scenario"], "duration_s": None},
    }
    assert [event[1:] for event in kept.manifest["events"]] == [["run", "interrupted: the record ends here"]]


def test_every_reader_says_in_one_line_that_it_was_interrupted(left, tmp_path, capsys):
    main(["rerun", str(left)])
    again = capsys.readouterr()
    assert again.out.startswith(f"equal: {SCENARIO} under two-part, {len(read_run(left).table)} ticks")
    main(["replay", str(left), "--out", str(tmp_path / "left.parquet")])
    converted = capsys.readouterr()
    main(["replay", str(tmp_path / "left.parquet"), "--out", str(tmp_path / "left.mcap")])
    for said in (again.err, converted.err, capsys.readouterr().err):
        assert len(said.splitlines()) == 1
        assert "this run was interrupted at t = " in said
    assert read_run(tmp_path / "left.parquet").table.tobytes() == read_run(left).table.tobytes()


def test_it_is_replayed_as_a_page_that_says_so(left):
    with running_surefoot("replay", left) as process:
        said = process.stderr.readline()  # after the address: the page is there
        process.send_signal(signal.SIGINT)
        printed, rest = process.communicate()
    assert (process.returncode, rest) == (0, "")
    assert said.startswith("surefoot: this run was interrupted at t = ")
    assert f"Surefoot replays {left.name}: open http" in printed


def test_who_asks_for_the_file_is_told_what_there_is_instead(left, capsys):
    with pytest.raises(SystemExit) as end:
        main(["rerun", str(left.with_suffix(""))])
    assert end.value.code == 2
    assert f"{left} is what an interrupted run left" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_a_run_that_is_stopped_makes_its_file_in_order(tmp_path, capsys, name):
    out, partial = tmp_path / "run.npz", tmp_path / "run.npz.partial"
    with running_surefoot(*FOR_EVER, "--json", "--out", out) as process:
        recorded_until(process, partial)
        process.send_signal(signal.Signals[name])
        printed, told = process.communicate()
    assert process.returncode == 128 + signal.Signals[name]
    summary = json.loads(printed)
    assert any(line.startswith("interrupted at t = ") for line in summary["warnings"])
    assert told.splitlines()[-1] == f"surefoot: {_line(out)} (in {out})"
    assert list(tmp_path.iterdir()) == [out]
    assert len(read_run(out).table) == round(summary["duration_s"] / 1e-3)
    main(["rerun", str(out)])
    assert capsys.readouterr().out.startswith("equal: ")


def _line(out: Path) -> str:
    return f"this run was interrupted at t = {read_run(out).manifest[INTERRUPTED]:.3f} s; its record ends there"


def test_a_disk_that_gets_full_ends_the_record_and_not_the_run(tmp_path):
    """A limit on the size of files stands for the disk: the same error, at the same place."""
    out, partial = tmp_path / "run.parquet", tmp_path / "run.parquet.partial"
    arguments = ("run", SCENARIO, *PUSH, "--set", "duration_s=0.8", "--json", "--out", out)
    with running_surefoot(*arguments, largest_file=400_000) as process:
        printed, told = process.communicate()
    assert process.returncode == 2
    assert json.loads(printed)["duration_s"] == 0.8
    assert len(told.splitlines()) == 1
    assert "File too large" in told
    assert f"ticks are in {partial}, which opens as a run" in told
    assert list(tmp_path.iterdir()) == [partial]
    kept = read_run(partial)
    again = run(SCENARIO, changes={"controller.guard": False, "duration_s": 0.8})
    assert 0 < len(kept.table) < len(again.table)
    assert kept.table.tobytes() == again.table[: len(kept.table)].tobytes()


def test_what_an_earlier_run_left_stays(left, tmp_path, capsys):
    out, earlier = tmp_path / "run.npz", tmp_path / "run.npz.partial"
    earlier.write_bytes(left.read_bytes())
    main(["run", SCENARIO, "--set", "duration_s=0.02", "--out", str(out)])
    assert earlier.read_bytes() == left.read_bytes()
    assert sorted(tmp_path.iterdir()) == [out, earlier]
    assert capsys.readouterr().err.startswith(f"surefoot: {earlier} is of another run, which was interrupted")


def test_the_file_is_that_of_a_run_in_memory(tmp_path):
    """Value for value: what is recorded tick by tick and what is kept in memory."""
    again = run(SCENARIO, changes={"duration_s": 0.6})
    for kind in ("npz", "parquet"):
        main(["run", SCENARIO, "--set", "duration_s=0.6", "--out", str(tmp_path / f"run.{kind}")])
        kept = open_run(tmp_path / f"run.{kind}")
        assert (kept.columns, kept.table.tobytes()) == (again.columns, again.table.tobytes())
        assert kept.interrupted_s is None
        assert kept.manifest["events"] == [list(event) for event in again.manifest["events"]]
    main(["run", SCENARIO, "--set", "duration_s=0.6", "--out", str(tmp_path / "run.csv")])
    table = np.loadtxt(tmp_path / "run.csv", delimiter=",", skiprows=1)
    np.testing.assert_allclose(table, again.table, rtol=1e-8, atol=0.0)
