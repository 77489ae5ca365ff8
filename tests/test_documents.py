"""What is written for people: every link leads somewhere, the README stays short, the index names every page."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
HELP = ROOT / "static" / "help"
PAGES = sorted(
    page for folder in (ROOT, *map(ROOT.joinpath, ("static", "robot_models", "tests", "scripts", ".github")))
    for page in (folder.glob("*.md") if folder == ROOT else folder.rglob("*.md"))
)  # fmt: skip
LINK = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")
README_LINES = 130


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_link_leads_to_a_file(page):
    targets = [link[1] for link in LINK.finditer(page.read_text(encoding="utf-8"))]
    inside = [target for target in targets if not re.match(r"[a-z]+:", target)]
    lost = [target for target in inside if not (page.parent / target).exists()]
    assert not lost


def test_the_readme_stays_short():
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= README_LINES


def test_the_index_names_every_page():
    listed = {link[1] for link in LINK.finditer((HELP / "README.md").read_text(encoding="utf-8"))}
    assert {page.name for page in HELP.glob("*.md")} - {"README.md"} <= listed


@pytest.mark.parametrize("page", [ROOT / "SECURITY.md", HELP / "reliability.md"], ids=["SECURITY", "reliability"])
def test_every_promise_names_a_test_that_there_is(page):
    rows = [line for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
    for row in (row for row in rows if not row.endswith("| test |")):
        named = re.findall(r"`((?:tests|access)/[^`:]+\.py)(?:::(\w+))?`", row)
        assert named, row
        for path, function in named:
            text = (ROOT / path.replace("access/", "tests/dashboard/access/", path.startswith("access/"))).read_text(
                "utf-8"
            )
            assert f"def {function}" in text, (path, function)


def test_the_counts_of_hostile_inputs_are_those_of_the_tests():
    text = (ROOT / "tests" / "test_hostile_input.py").read_text(encoding="utf-8")
    few, many = map(int, re.search(r"^FEW, MANY = (\d+), (\d+)$", text, re.MULTILINE).groups())
    kinds = len(re.findall(r"^@hostile\(", text, re.MULTILINE))
    assert f"| all | {kinds * few:,} | {kinds * many:,} |" in (HELP / "reliability.md").read_text(encoding="utf-8")


def test_a_dead_link_would_be_found():
    assert [link[1] for link in LINK.finditer("see [a](b.md) and [c](https://d.e) and ![f](g/h.png#i)")] == [
        "b.md", "https://d.e", "g/h.png"
    ]  # fmt: skip
