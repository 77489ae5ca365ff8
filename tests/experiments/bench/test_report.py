"""The page about a bench says what its files say, and the one that ships is made from the files that ship."""

import json
from pathlib import Path

import pytest

from surefoot.cli.bench_tables import print_cases, print_ledger, print_ranking
from surefoot.cli.main import main
from surefoot.control.registry import controllers
from surefoot.experiments.bench.ranking import as_data, standings
from surefoot.experiments.bench.report import bench_page, goals_table, read_bench
from surefoot.experiments.bench.store import MANIFEST, RANKING, TABLE, read_table
from surefoot.experiments.runs.table_file import write_parquet
from surefoot.resources import resource_folder

RESULT = resource_folder("static") / "results" / "bench"
PAGE = resource_folder("static") / "help" / "bench.md"


def test_the_page_that_ships_is_made_from_the_result_that_ships():
    assert PAGE.read_text(encoding="utf-8") == bench_page(*read_bench(RESULT))


def test_the_ranking_that_ships_is_that_of_the_table_that_ships():
    ranking, manifest = read_bench(RESULT)
    assert ranking == json.loads(json.dumps(as_data(standings(read_table(RESULT)))))
    assert manifest["complete"] and manifest["cells"] == len({row["cell"] for row in read_table(RESULT)})
    assert len(manifest["commit"]) == 40


def test_the_default_controller_reaches_every_goal_of_the_result_that_ships():
    """What the README says of it; seeds that were not used in tuning."""
    ranking, manifest = read_bench(RESULT)
    mine = [family for family in ranking["families"] if family["controller"] == "two-part"]
    assert {family["family"] for family in mine if family["goals"]} == {
        "swing", "stone", "landing", "push", "push-double"
    }  # fmt: skip
    assert all(family["goals_reached"] == family["goals"] for family in mine)
    assert manifest["arguments"]["first_seed"] > 0


@pytest.fixture
def made_up():
    """Ranking of two controllers, one of them from outside, over one case and three seeds, and its manifest."""
    case = {"median": 0.95, "low": 0.9, "high": 1.0}
    family = {
        "family": "push", "unit": "J/J_cap", "mean": 0.95, "worst": 0.9, "at_top": 0, "refused": 0, "score": 1.0,
        "goals_reached": 3, "goals": 6, "goal_cases": 2,
    }  # fmt: skip
    first = {"controller": "a", "score": 1.0, "score_95": [0.9, 1.0], "behind": 0.0, "behind_95": [0.0, 0.0]}
    second = {"controller": "b", "score": 0.5, "score_95": [0.4, 0.6], "behind": 0.5, "behind_95": [0.375, 0.6]}
    brought = {"package": "surefoot-b", "version": "0.1", "requires": {"tsid": "1.10.0"}, "code": "x"}
    ranking = {
        "ranking": [first, second],
        "families": [
            {**family, "controller": "a", "cases": {"left": case}},
            {**family, "controller": "b", "mean": None, "cases": {"left": dict.fromkeys(case)}},
        ],
    }
    manifest = {**read_bench(RESULT)[1], "seeds": [101, 102, 103], "plug_ins": {"b": brought}}
    return ranking, manifest


def test_intervals_and_ranges_are_written_as_they_are(made_up):
    page = bench_page(*made_up)
    assert "| push | impulse through the CoM, one foot | J/J_cap | 0.950 (0.900) | refused |" in page
    assert "| push | left | J/J_cap | 0.950 (0.900 to 1.000) | refused |" in page
    assert "| push | 3/6 [0.09, 0.91] | 3/6 [0.09, 0.91] |" in page  # Wilson by hand of 1 in 2: (0.0945, 0.9055)
    assert "| push | 1/1 [0.21, 1.00] | 0/1 [0.00, 0.79] |" in page
    assert "| **score** |  |  | **1.000 [0.900, 1.000]** | **0.500 [0.400, 0.600]** |" in page
    assert "| behind the first |  |  |  | 0.500 [0.375, 0.600] |" in page


def test_several_seeds_and_controllers_from_outside_are_told(made_up):
    ranking, manifest = made_up
    page = bench_page(ranking, manifest)
    assert "Seeds 101, 102, 103: each moves every case" in page and "0.05 s in onset" in page
    assert "From outside: `b` of surefoot-b 0.1, tsid 1.10.0." in page
    assert "## Seeds: cases whose threshold is not the same for all" in page
    assert "| push | J/J_cap | 1/1 (0.100) | 0/0 |" in page
    assert "## Seeds" not in bench_page(ranking, {**manifest, "seeds": [101]})  # nothing to compare


def test_no_page_without_a_finished_bench(tmp_path, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["bench", "--report", "--out", str(tmp_path)])
    assert exit_.value.code == 2 and "holds no finished bench" in capsys.readouterr().err


def test_the_table_in_the_readme_is_made_from_the_result_that_ships():
    readme = Path(__file__).parents[3] / "README.md"
    _, _, rest = readme.read_text(encoding="utf-8").partition("<!-- bench:begin -->\n")
    table, _, _ = rest.partition("\n<!-- bench:end -->")
    assert table == goals_table(read_bench(RESULT)[0])


@pytest.mark.parametrize("command", ["report", "map", "replay", "ledger"])
def test_a_result_with_a_controller_that_is_not_installed_is_read_like_any_other(command, tmp_path, capsys):
    """A table made where another plug-in is installed: rename one of the result that ships."""
    rows = [row for row in read_table(RESULT) if row["family"] in ("stone", "push", "push-double")]
    for row in rows:
        if row["registry_name"] == "two-part-literal":
            row.update(controller="absent+zmp_margin=0.9", registry_name="absent")
    assert "absent" not in controllers()
    manifest = {**read_bench(RESULT)[1], "plug_ins": {"absent": {"package": "p", "version": "1", "requires": {}}}}
    write_parquet(tmp_path / TABLE, {key: [row[key] for row in rows] for key in rows[0]}, {})
    (tmp_path / RANKING).write_text(json.dumps(as_data(standings(rows))))
    (tmp_path / MANIFEST).write_text(json.dumps(manifest))
    if command == "report":
        main(["bench", "--report", "--out", str(tmp_path)])
    elif command == "map":
        main(["map", "--bench", str(tmp_path), "--out", str(tmp_path / "maps")])
        assert "absent+zmp_margin=0.9" in (tmp_path / "maps" / "map.html").read_text()
        return
    elif command == "replay":
        index = next(i for i, row in enumerate(rows) if row["registry_name"] == "absent")
        main(["bench", "--replay", str(index), "--out", str(tmp_path), "--to", str(tmp_path / "one.toml")])
    else:
        print_ranking(rows)
        print_cases(rows)
        print_ledger(rows)
    captured = capsys.readouterr()
    assert "absent" in captured.out + captured.err
