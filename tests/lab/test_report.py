"""The page about a bench says what its files say, and the one that ships is made from the files that ship."""

import json
from pathlib import Path

import pytest

from app.cli import main
from app.experiments.lab.ranking import as_data, standings
from app.experiments.lab.report import bench_page, goals_table, read_bench
from app.experiments.lab.store import read_table
from app.resources import resource_folder

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


def test_intervals_and_ranges_are_written_as_they_are():
    case = {"median": 0.95, "low": 0.9, "high": 1.0}
    family = {
        "family": "push", "unit": "J/J_cap", "mean": 0.95, "worst": 0.9, "at_top": 0, "refused": 0, "score": 1.0,
        "goals_reached": 1, "goals": 2,
    }  # fmt: skip
    ranking = {
        "ranking": [{"controller": "a", "score": 1.0}, {"controller": "b", "score": 0.5}],
        "families": [
            {**family, "controller": "a", "cases": {"left": case}},
            {**family, "controller": "b", "mean": None, "cases": {"left": dict.fromkeys(case)}},
        ],
    }
    page = bench_page(ranking, {**read_bench(RESULT)[1]})
    assert "| push | impulse through the CoM, one foot | J/J_cap | 0.950 (0.900) | refused |" in page
    assert "| push | left | J/J_cap | 0.950 (0.900 to 1.000) | refused |" in page
    assert "| push | 1/2 [0.09, 0.91] | 1/2 [0.09, 0.91] |" in page  # Wilson by hand: (0.0945, 0.9055)
    assert "| push | 1/1 [0.21, 1.00] | 0/1 [0.00, 0.79] |" in page


def test_no_page_without_a_finished_bench(tmp_path, capsys):
    with pytest.raises(SystemExit) as exit_:
        main(["bench", "--report", "--out", str(tmp_path)])
    assert exit_.value.code == 2 and "holds no finished bench" in capsys.readouterr().err


def test_the_table_in_the_readme_is_made_from_the_result_that_ships():
    readme = Path(__file__).parents[2] / "README.md"
    _, _, rest = readme.read_text(encoding="utf-8").partition("<!-- bench:begin -->\n")
    table, _, _ = rest.partition("\n<!-- bench:end -->")
    assert table == goals_table(read_bench(RESULT)[0])
