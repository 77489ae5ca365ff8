"""Which line of the program owns which equation of the paper, read from the docstrings of the package's own sources.

An owner says so in its docstring, e.g. ``Equation: (5)``, ``Equation: (3), (16)`` or ``Equation: (11)-(13)``; in
backticks, as here, it is only a mention. Sources are parsed, never imported: the ledger needs neither MuJoCo nor a
display.
"""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent

TITLES = {
    1: "Constrained dynamics of the robot",
    2: "Output function kappa(q)",
    3: "Total rate of angular momentum: delta_P = dL_P/dt",
    4: "Angular momentum L_P as a sum over links",
    5: "delta_P as a sum over links",
    6: "delta_P in the sagittal and frontal planes",
    7: "Second line of (6), printed without its number",
    8: "Moment of inertial and gravitational forces about P",
    9: "The ZMP C: where that moment vanishes",
    10: "PC from delta_P",
    11: "PC from delta_P, as deviations from the reference",
    12: "Definition of the deviations",
    13: "PC when C_ref = P and PG_ref is vertical",
    14: "ZMP, lateral component",
    15: "ZMP, forward component",
    16: "Deviation of delta_P from its reference",
    17: "Contact dynamics as a quadratic problem",
    18: "Task error e",
    19: "Its rate e'",
    20: "Its acceleration e''",
    21: "Error dynamics asked for",
    22: "Dynamics in the task space",
    23: "Tracking law v = -K_P e - K_D e'",
    24: "Task acceleration from q''",
    25: "Task acceleration from the tracking law",
    26: "Acceleration of the centre of mass",
    27: "Its place in kappa'': the first three rows",
    28: "Ankle torques",
}

_ITEM = r"\((\d+)\)(?:\s*[-\N{EN DASH}]\s*\((\d+)\))?"
_CLAIM = re.compile(rf"(?<!`)\bEquations?:\s*({_ITEM}(?:(?:\s*,\s*(?:and\s+)?|\s+and\s+){_ITEM})*)")
_LOOKS_LIKE_CLAIM = re.compile(r"^\s*Equations?:.*$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Owner:
    """One docstring that claims an equation.

    Attributes:
        qualified_name: dotted name of the module, class, method or function, e.g.
            ``surefoot.momentum.delta.delta_about``.
        location: ``file:line`` of its definition, the file as seen from the folder that holds the package.
        summary: first line of the docstring.
    """

    qualified_name: str
    location: str
    summary: str


def claimed_equations(docstring: str) -> list[int]:
    """Equation numbers that a docstring claims, in order, ranges spelt out; who claims (6) has (7), its second line.

    Raises:
        ValueError: a line starts with ``Equation:`` but has no readable number, or a range runs backwards, or the
            paper has no such equation.
    """
    numbers: list[int] = []
    for claim in _CLAIM.finditer(docstring):
        for first, last in re.findall(_ITEM, claim[1]):
            span = range(int(first), int(last or first) + 1)
            if not span or span[0] not in TITLES or span[-1] not in TITLES:
                raise ValueError(f"{claim[0]!r}: equations are (1) to ({max(TITLES)})")
            numbers.extend(number for number in span if number not in numbers)
    if 6 in numbers and 7 not in numbers:
        numbers.insert(numbers.index(6) + 1, 7)
    for line in _LOOKS_LIKE_CLAIM.findall(docstring):
        if not _CLAIM.search(line):
            raise ValueError(f"{line.strip()!r}: write Equation: (5), (16) or Equation: (11)-(13)")
    return numbers


def _documented(node: ast.AST, name: str) -> Iterator[tuple[str, int, str]]:
    """Qualified name, line and docstring of a node and of all the definitions inside it."""
    if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
        if docstring := ast.get_docstring(node):
            yield name, getattr(node, "lineno", 1), docstring
    for child in ast.iter_child_nodes(node):
        is_definition = isinstance(child, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
        yield from _documented(child, f"{name}.{child.name}" if is_definition else name)


def owners(package: Path = PACKAGE) -> dict[int, list[Owner]]:
    """The ledger: for each equation (1) to (28) its owners, none where nobody claims it.

    Args:
        package: folder of the package to read; this one unless a test asks otherwise.

    Raises:
        ValueError: a docstring claims what cannot be read or does not exist; the text names file and line.
    """
    ledger: dict[int, list[Owner]] = {number: [] for number in TITLES}
    for path in sorted(package.rglob("*.py")):
        shown = path.relative_to(package.parent).as_posix()
        module = shown.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
        for name, line, docstring in _documented(ast.parse(path.read_text(encoding="utf-8")), module):
            try:
                claimed = claimed_equations(docstring)
            except ValueError as error:
                raise ValueError(f"{shown}:{line}: {error}") from error
            for number in claimed:
                ledger[number].append(Owner(name, f"{shown}:{line}", docstring.splitlines()[0]))
    return ledger


def markdown_table(ledger: dict[int, list[Owner]] | None = None) -> str:
    """The ledger as a Markdown table, one row for an owner; an equation without one says so.

    Args:
        ledger: what ``owners`` returned; read from the sources if it is left out.
    """
    rows = ["| Eq. | What it is | Owner | Where | What the owner does |", "|---|---|---|---|---|"]
    for number, claims in (owners() if ledger is None else ledger).items():
        title = TITLES[number]
        if not claims:
            rows.append(f"| ({number}) | {title} | *nobody* | | |")
        for claim in claims:
            summary = claim.summary.replace("|", r"\|")
            rows.append(f"| ({number}) | {title} | `{claim.qualified_name}` | {claim.location} | {summary} |")
    return "\n".join(rows)


def owned_where() -> dict[str, list[list[str]]]:
    """Who owns which equation, as the page shows it: number -> [file, function] of each owner, in order."""
    return {str(number): [_place(claim) for claim in claims] for number, claims in owners().items()}


def _place(owner: Owner) -> list[str]:
    file = owner.location.rpartition(":")[0]
    module = file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
    return [file, owner.qualified_name.removeprefix(module).lstrip(".")]
