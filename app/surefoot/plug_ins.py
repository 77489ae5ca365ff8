"""What installed packages bring under an entry-point group, found so that a broken one does not hide the others."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from importlib.metadata import EntryPoint, distributions, entry_points
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

from surefoot.errors import one_line


class Refusal(NamedTuple):
    """What cannot be used, and why, one clause."""

    name: str
    reason: str


class Named(Protocol):
    """What a registry holds."""

    @property
    def name(self) -> str:
        """What the user types."""
        ...


Entry = TypeVar("Entry", bound=Named)


@dataclass(frozen=True)
class Registry(Generic[Entry]):
    """What there is: entries by name, the entry points of those from outside, and those that cannot be used."""

    entries: dict[str, Entry]
    points: dict[str, EntryPoint]
    refused: tuple[Refusal, ...]

    @property
    def unavailable(self) -> dict[str, str]:
        """The entry points that bring nothing, by name, and why."""
        return {refusal.name: refusal.reason for refusal in self.refused}


def registry_of(
    group: str, built_in: Iterable[Entry], fault: Callable[[Any, Mapping[str, Entry]], str]
) -> Registry[Entry]:
    """Ours, then what the entry points of a group name.

    Args:
        group: of the entry points.
        built_in: ours.
        fault: what an entry point names, and the entries that are taken -> what is wrong with it, empty for nothing.
    """
    entries, points = {entry.name: entry for entry in built_in}, dict[str, EntryPoint]()
    found, refused = entry_points_of_group(group)
    for point in found:
        try:
            entry = point.load()
            reason = fault(entry, entries)
        except (Exception, SystemExit) as error:  # someone else's code: whatever goes wrong there is told by its name
            entry, reason = None, f"cannot be loaded ({one_line(error)})"
        if entry is None or reason:
            refused.append(Refusal(point.name, f"{point.value} {reason}; repair or uninstall its package"))
            continue
        entries[entry.name], points[entry.name] = entry, point
    return Registry(entries, points, tuple(refused))


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
