"""The bench of Unitree's G1 that ships: what the page says is made from it, and nothing in it names a folder."""

import re
import tomllib

import pytest

from surefoot.experiments.bench.made_by import command_of, robot_of
from surefoot.experiments.bench.report import goals_table, means_table, read_bench
from surefoot.experiments.bench.store import MANIFEST, read_table
from surefoot.resources import resource_folder

RESULT = resource_folder("static") / "results" / "robots_g1"
PAGE = (resource_folder("static") / "help" / "results.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def result():
    return read_bench(RESULT)


@pytest.mark.parametrize(("mark", "table"), [("means", means_table), ("goals", goals_table)])
def test_the_tables_in_the_documents_are_made_from_the_result_that_ships(mark, table, result):
    _, begun, rest = PAGE.partition(f"<!-- robots-g1-{mark}:begin -->\n")
    assert begun and rest.partition(f"\n<!-- robots-g1-{mark}:end -->")[0] == table(result[0])


def test_it_is_finished_and_the_page_has_its_command(result):
    _, manifest = result
    assert manifest["complete"] and manifest["cells"] == len({row["cell"] for row in read_table(RESULT)})
    assert command_of(manifest) in PAGE
    assert robot_of(manifest) == "g1.xml" and re.fullmatch(r"[0-9a-f]{64}", manifest["robot"]["sha256"])


def test_no_folder_of_the_machine_that_made_it_is_in_it():
    assert not re.search(r'"/|[A-Z]:\\\\', (RESULT / MANIFEST).read_text(encoding="utf-8"))
    robots = {tomllib.loads(row["scenario"])["robot"] for row in read_table(RESULT)}
    assert robots == {"g1.xml"}
