"""The benches whose results ship: what the page of results says is made from them, and they are whole."""

import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from surefoot.experiments.bench.belief_table import belief_lines
from surefoot.experiments.bench.goal_table import goal_lines
from surefoot.experiments.bench.made_by import command_of, robot_of
from surefoot.experiments.bench.report import goals_table, means_table, read_bench
from surefoot.experiments.bench.share_table import share_lines
from surefoot.experiments.bench.store import MANIFEST, read_table
from surefoot.experiments.bench.walk_pushes import push_lines
from surefoot.experiments.price import page as price_page
from surefoot.resources import resource_folder

RESULTS = resource_folder("static") / "results"
PAGE = (resource_folder("static") / "help" / "results.md").read_text(encoding="utf-8")
# The mark of a table in the page -> the result it is made from, and how
TABLES: dict[str, tuple[str, Callable[[Any, Any], str]]] = {
    "walk-goals": ("walk_goals", lambda ranking, manifest: "\n".join(goal_lines(ranking, manifest))),
    "walk-push": ("walk_push", lambda ranking, _: "\n".join(push_lines(ranking["walk_pushes"]))),
    "step-push": ("step_push", lambda ranking, _: "\n".join(share_lines(ranking["shares"]))),
    "robots-g1-means": ("robots_g1", lambda ranking, _: means_table(ranking)),
    "robots-g1-goals": ("robots_g1", lambda ranking, _: goals_table(ranking)),
    "presets-means": ("presets", lambda ranking, _: means_table(ranking)),
    "presets-stand": ("presets_stand", lambda ranking, _: "\n".join(belief_lines(ranking["beliefs"]))),
    "presets-stand-600": ("presets_stand_600", lambda ranking, _: "\n".join(belief_lines(ranking["beliefs"]))),
    "presets-stone": ("presets_stone", lambda ranking, _: "\n".join(belief_lines(ranking["beliefs"]))),
    "presets-walk": ("presets_walk", lambda ranking, _: "\n".join(belief_lines(ranking["beliefs"]))),
    "presets-walk-stones": ("presets_walk_stones", lambda ranking, _: "\n".join(share_lines(ranking["shares"]))),
    "presets-walk-stones-beliefs": (
        "presets_walk_stones",
        lambda ranking, _: "\n".join(belief_lines(ranking["beliefs"])),
    ),
}
CHEAP = "presets_cheap"  # told in words: there is nothing to rank
IN_THE_PAGE = sorted({CHEAP, *(folder for folder, _ in TABLES.values())})


@pytest.fixture(scope="module", params=IN_THE_PAGE)
def folder(request) -> Path:
    return RESULTS / request.param


PRICE = "price"


@pytest.mark.parametrize("mark", TABLES)
def test_a_table_in_the_documents_is_made_from_the_result_that_ships(mark):
    name, table = TABLES[mark]
    _, begun, rest = PAGE.partition(f"<!-- {mark}:begin -->\n")
    assert begun and rest.partition(f"\n<!-- {mark}:end -->")[0] == table(*read_bench(RESULTS / name))


def test_every_marked_table_is_held_by_this_test():
    assert set(re.findall(r"<!-- ([a-z0-9-]+):begin -->", PAGE)) == {*TABLES, PRICE}


def test_the_price_list_in_the_documents_is_made_from_the_result_that_ships():
    found, manifest = price_page.read_price(RESULTS / PRICE)
    _, _, rest = PAGE.partition(f"<!-- {PRICE}:begin -->\n")
    assert rest.partition(f"\n<!-- {PRICE}:end -->")[0] == "\n".join(price_page.price_tables(found, manifest)).strip()
    assert price_page.command_of(manifest) in PAGE
    assert manifest["complete"] and manifest["cells"] == len({row["cell"] for row in read_table(RESULTS / PRICE)})
    assert not re.search(r'"/|[A-Z]:\\\\', (RESULTS / PRICE / MANIFEST).read_text(encoding="utf-8"))


def test_what_the_page_says_of_cheap_sensors_is_what_was_measured():
    rows = read_table(RESULTS / CHEAP)
    assert not any(row["survived"] for row in rows)
    falls: dict[tuple[str, float], list[bool]] = {}
    for row in rows:
        falls.setdefault((row["family"], row["level"]), []).append(row["outcome"] == "falls")
    counts = {key: (sum(found), len(found)) for key, found in falls.items()}
    assert counts == {
        ("push", 0.5): (0, 16), ("push", 0.65): (0, 16), ("push", 0.9): (6, 16),
        ("push-double", 0.8): (0, 4), ("push-double", 0.95): (2, 4),
    }  # fmt: skip
    for text in ("0 of 32 pushes of 0.5 and 0.65", "6 of 16 of 0.9", "0 of 4 of 0.8", "2 of 4 of 0.95"):
        assert text in PAGE
    speeds = sorted(1e3 * row["com_speed_mps"] for row in rows if row["outcome"] != "falls")
    assert [round(speed) for speed in (speeds[0], speeds[-2], speeds[-1])] == [41, 61, 277]
    assert min(row["dcm_error_p99_mm"] for row in rows) > 37.0


def test_what_the_page_says_of_ten_minutes_beside_one_is_what_was_measured():
    def values(folder: str, column: str, digits: int, factor: float = 1.0) -> str:
        of_seed = {row["case"]: row[column] for row in read_table(RESULTS / folder) if row["seed"] == 7100}
        return " and ".join(f"{factor * abs(of_seed[case]):.{digits}f}" for case in ("two feet", "left foot"))

    dcm = values("presets_stand", "dcm_error_p99_mm", 1)
    tilt = values("presets_stand", "tilt_error_p99_deg", 3)
    com = values("presets_stand", "com_error_m", 1, 1e3)
    assert f"DCM {dcm} mm, tilt {tilt} degrees, CoM {com} mm" in PAGE
    assert values("presets_stand_600", "position_drift_mm", 1) == "0.6 and 0.6"
    assert f"the heading by {values('presets_stand_600', 'yaw_drift_deg', 2)} degrees" in PAGE


def test_it_is_finished_and_the_page_has_its_command(folder):
    _, manifest = read_bench(folder)
    assert manifest["complete"] and manifest["cells"] == len({row["cell"] for row in read_table(folder)})
    assert command_of(manifest) in PAGE


def test_no_folder_of_the_machine_that_made_it_is_in_it(folder):
    _, manifest = read_bench(folder)
    assert not re.search(r'"/|[A-Z]:\\\\', (folder / MANIFEST).read_text(encoding="utf-8"))
    assert {tomllib.loads(row["scenario"])["robot"] for row in read_table(folder)} == {robot_of(manifest)}


def test_the_files_of_a_robot_that_does_not_ship_are_named_by_their_hash():
    _, manifest = read_bench(RESULTS / "robots_g1")
    assert robot_of(manifest) == "g1.xml" and re.fullmatch(r"[0-9a-f]{64}", manifest["robot"]["sha256"])
