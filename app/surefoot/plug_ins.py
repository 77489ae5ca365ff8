"""Entry points of installed packages, found so that a package with broken metadata does not hide the others."""

from importlib.metadata import EntryPoint, distributions, entry_points
from typing import NamedTuple

from surefoot.errors import one_line


class Refusal(NamedTuple):
    """What cannot be used, and why, one clause."""

    name: str
    reason: str


def entry_points_of_group(group: str) -> tuple[list[EntryPoint], list[Refusal]]:
    """All entry points of a group, and the packages whose list of them cannot be read.

    As ``importlib.metadata.entry_points`` finds them; that stops at the first file it cannot parse, so then the
    packages are read one by one.
    """
    try:
        return list(entry_points(group=group)), []
    except Exception:
        return _read_one_by_one(group)


def _read_one_by_one(group: str) -> tuple[list[EntryPoint], list[Refusal]]:
    found: list[EntryPoint] = []
    refused: list[Refusal] = []
    seen: set[str] = set()
    for package in distributions():
        name = str(package.name)
        if name in seen:  # another one of that name is found before it
            continue
        seen.add(name)
        try:
            found += [point for point in package.entry_points if point.group == group]
        except Exception as error:
            text = package.read_text("entry_points.txt") or ""
            if f"[{group}]" in text:
                refused.append(Refusal(name, f"its entry_points.txt cannot be read ({one_line(error)})"))
    return found, refused
