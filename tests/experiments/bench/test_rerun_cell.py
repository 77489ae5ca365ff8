"""A cell of the bench that was committed, made by another commit, comes out the same again."""

import pytest

from surefoot.cli.main import main
from surefoot.errors import InvalidInput
from surefoot.experiments.bench import rerun_cell as module
from surefoot.experiments.bench.rerun_cell import rerun_cell
from surefoot.experiments.bench.store import read_manifest, read_table
from surefoot.resources import resource_folder

CELL = {"family": "landing", "controller": "two-part-literal", "seed": 103}


@pytest.fixture(scope="module")
def folder():
    return resource_folder("static") / "results" / "bench"


@pytest.fixture(scope="module")
def kept(folder):
    rows = read_table(folder)
    number = next(i for i, row in enumerate(rows) if all(row[key] == value for key, value in CELL.items()))
    return number, [row for row in rows if row["cell"] == rows[number]["cell"]], read_manifest(folder)


def test_a_committed_cell_is_made_again(folder, kept, capsys):
    main(["rerun", str(folder), "--row", str(kept[0])])
    assert "equal: landing" in capsys.readouterr().out


def test_what_differs_is_named(kept, monkeypatch):
    _, rows, manifest = kept
    again = [{**row, "cell": "of another commit"} for row in rows]
    monkeypatch.setattr(module, "run_cell", lambda cell: again)
    assert rerun_cell(rows[0]["cell"], rows, manifest) is None
    again[0]["outcome"] = "flies"
    assert "'flies' at level" in rerun_cell(rows[0]["cell"], rows, manifest)
    again.pop()
    assert "episodes instead of" in rerun_cell(rows[0]["cell"], rows, manifest)


@pytest.mark.parametrize(
    "manifest", [{}, {"arguments": 3}, {"arguments": {"families": 3}}, {"arguments": {"seeds": 1}}]
)
def test_a_manifest_that_does_not_tell_is_refused(kept, manifest):
    _, rows, _ = kept
    with pytest.raises(InvalidInput):
        rerun_cell(rows[0]["cell"], rows, manifest)


def test_a_row_that_is_not_there_is_refused(folder, capsys):
    with pytest.raises(SystemExit) as end:
        main(["rerun", str(folder), "--row", "999999"])
    assert end.value.code == 2
    assert "no such row" in capsys.readouterr().err
