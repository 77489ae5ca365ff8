"""``--out`` that cannot be written: refused before the work; and what was computed is said before it fails."""

import json
import tempfile
from pathlib import Path

import pytest

from surefoot.cli.main import main

NOWHERE = Path("/proc")  # nobody can make a file there, not even root
FULL = Path("/dev/full")
needs_linux = pytest.mark.skipif(not (NOWHERE.is_dir() and FULL.exists()), reason="needs Linux' /proc and /dev/full")
SHORT = ("--set", "duration_s=0.02")


@pytest.fixture
def saved_run(tmp_path) -> Path:
    file = tmp_path / "run.npz"
    main(["run", "stand_left", *SHORT, "--out", str(file)])
    return file


@pytest.fixture
def no_work(monkeypatch):
    """Whatever would compute for minutes."""

    def work(*arguments, **options):
        raise AssertionError("it computed first")

    monkeypatch.setattr("surefoot.experiments.runs.run.run", work)
    monkeypatch.setattr("surefoot.experiments.scenario.references.plan_scenario", work)
    monkeypatch.setattr("surefoot.experiments.studies.grid.run_cells", work)
    monkeypatch.setattr("surefoot.experiments.studies.ablation.run_ablation", work)
    monkeypatch.setattr("surefoot.experiments.paper.make_report.gather", work)
    monkeypatch.setattr("surefoot.experiments.bench.bench.run_bench", work)
    monkeypatch.setattr("surefoot.experiments.runs.run_reader.read_run", work)


def ends(arguments, capsys, code: int):
    with pytest.raises(SystemExit) as end:
        main([str(argument) for argument in arguments])
    printed = capsys.readouterr()
    assert end.value.code == code
    assert len(printed.err.splitlines()) == 1, printed.err
    return printed


@needs_linux
@pytest.mark.parametrize("command", ["ablate", "figures", "map", "grid", "run", "plan", "replay"])
@pytest.mark.parametrize("place", ["/proc/{}", "/proc/new/{}"])
def test_nothing_is_computed_for_a_place_that_takes_no_files(no_work, capsys, command, place):
    of = {"run": ["stand_left"], "plan": ["swing_inward"], "replay": ["a.npz"]}.get(command, [])
    kind = {"run": "x.json", "plan": "x.csv", "replay": "x.mcap", "grid": "x.json"}.get(command, "x")
    assert "--out" in ends([command, *of, "--out", place.format(kind)], capsys, 2).err


@needs_linux
def test_a_bench_has_its_folder_before_it_begins(capsys):
    arguments = ("bench", "--quick", "--controllers", "two-part", "--families", "swing", "--out", "/proc/bench")
    assert "--out" in ends(arguments, capsys, 2).err


@needs_linux
@pytest.mark.parametrize("kind", [".json", ".csv", ".npz", ".parquet"])
def test_the_summary_is_printed_though_the_disk_is_full(tmp_path, capsys, monkeypatch, kind):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))  # for the ticks, on their way to a device
    out = tmp_path / f"full{kind}"
    out.symlink_to(FULL)
    printed = ends(("run", "stand_left", "--json", *SHORT, "--out", out), capsys, 2)
    assert json.loads(printed.out)["fell"] is False
    assert "No space left on device" in printed.err


@needs_linux
def test_the_plan_is_printed_though_the_disk_is_full(tmp_path, capsys):
    out = tmp_path / "full.csv"
    out.symlink_to(FULL)
    printed = ends(("plan", "swing_inward", "--out", out), capsys, 2)
    assert "feasible" in printed.out
    assert "No space left on device" in printed.err


@needs_linux
def test_the_grid_is_printed_though_the_disk_is_full(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("surefoot.experiments.studies.grid.run_cells", lambda cells, workers: iter(()))
    monkeypatch.setattr("surefoot.experiments.studies.grid.markdown_tables", lambda results: "the tables")
    out = tmp_path / "full.json"
    out.symlink_to(FULL)
    printed = ends(("grid", "--out", out), capsys, 2)
    assert "the tables" in printed.out
    assert "No space left on device" in printed.err


@needs_linux
@pytest.mark.parametrize("kind", [".mcap", ".parquet"])
def test_a_conversion_onto_a_full_disk_is_one_line(saved_run, tmp_path, capsys, kind):
    out = tmp_path / f"full{kind}"
    out.symlink_to(FULL)
    capsys.readouterr()
    assert "No space left on device" in ends(("replay", saved_run, "--out", out), capsys, 2).err


@pytest.mark.parametrize("kind", [".npz", ".parquet"])
@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"PAR1"])
def test_a_foreign_file_is_one_line(tmp_path, capsys, kind, content):
    file = tmp_path / f"foreign{kind}"
    file.write_bytes(content)
    assert "is no saved run" in ends(("replay", file, "--out", tmp_path / "run.mcap"), capsys, 2).err
    assert not (tmp_path / "run.mcap").exists()


@pytest.mark.parametrize(
    "command", [("map", "--bench"), ("bench", "--report", "--out"), ("bench", "--replay", "0", "--out")]
)
@pytest.mark.parametrize("content", ["", "[1]", "{"])
def test_a_foreign_bench_is_one_line(tmp_path, capsys, command, content, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "foreign"
    folder.mkdir()
    for name in ("bench.parquet", "manifest.json", "ranking.json"):
        (folder / name).write_text(content)
    ends((*command, folder), capsys, 2)
