"""The equation ledger: every equation of the paper has an owner in the code, and the ledger reads claims rightly."""

from pathlib import Path

import pytest

from surefoot.equation_ledger import TITLES, claimed_equations, markdown_table, owners


def test_the_paper_has_28_equations():
    assert list(TITLES) == list(range(1, 29))


@pytest.mark.parametrize("number", TITLES)
def test_equation_is_owned(number):
    assert owners()[number], f"no docstring under app/surefoot/ says 'Equation: ({number})': {TITLES[number]}"


@pytest.mark.parametrize(
    ("docstring", "numbers"),
    [
        ("What it does.\n\nEquation: (5)", [5]),
        ("In one line. Equation: (28).", [28]),
        ("Equation: (3), (16)", [3, 16]),
        ("Equations: (3) and (4), (18), and (21)", [3, 4, 18, 21]),
        ("Equation: (11)-(13), (1)", [11, 12, 13, 1]),
        ("Equation: (14) \N{EN DASH} (15)", [14, 15]),
        ("Equation: (1),\n    (2)", [1, 2]),
        ("Equation: (6)", [6, 7]),
        ("Equation: (6), (7)", [6, 7]),
        ("Only talks about (5), or shows how to write ``Equation: (5)``.", []),
    ],
)
def test_claims_are_read(docstring, numbers):
    assert claimed_equations(docstring) == numbers


@pytest.mark.parametrize("docstring", ["Equation: (0)", "Equation: (29)", "Equation: (13)-(11)", "Equation: 5"])
def test_unreadable_claims_are_refused(docstring):
    with pytest.raises(ValueError, match="Equation"):
        claimed_equations(docstring)


@pytest.fixture
def small_package(tmp_path: Path) -> Path:
    """A package with one owning method and one owning module."""
    package = tmp_path / "small"
    (package / "room").mkdir(parents=True)
    (package / "__init__.py").write_text('"""All.\n\nEquation: (1)\n"""\n')
    (package / "room" / "law.py").write_text(
        'class Law:\n    def torque(self):\n        """Ankle | torque.\n\n        Equation: (28)\n        """\n'
    )
    return package


def test_owner_has_name_place_and_summary(small_package):
    ledger = owners(small_package)
    (law,) = ledger[28]
    assert (law.qualified_name, law.location, law.summary) == (
        "small.room.law.Law.torque",
        "small/room/law.py:2",
        "Ankle | torque.",
    )
    assert [owner.qualified_name for owner in ledger[1]] == ["small"]
    assert [number for number, claims in ledger.items() if claims] == [1, 28]


def test_refusal_names_the_file(small_package):
    (small_package / "room" / "wrong.py").write_text('def law():\n    """No such thing. Equation: (99)"""\n')
    with pytest.raises(ValueError, match=r"small/room/wrong\.py:1: .*\(99\)"):
        owners(small_package)


def test_table_has_a_row_for_each_equation_and_names_who_is_missing(small_package):
    lines = markdown_table(owners(small_package)).splitlines()
    assert len(lines) == 2 + 28
    assert r"`small.room.law.Law.torque` | small/room/law.py:2 | Ankle \| torque. |" in lines[-1]
    assert "*nobody*" in lines[3]
