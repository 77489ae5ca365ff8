"""What sets a scenario apart from the shipped one of its name, as the dotted paths and values that ``--set`` takes."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, shipped_scenarios

_LEFT_OUT = ("name", "duration_s", "controller")  # a live run has no end, and its settings have changes of their own


def changes_of(scenario: Scenario) -> Mapping[str, Any] | None:
    """Dotted path -> value: set in the shipped scenario, they make this one.

    Duration and settings of the controller are left out. None where no shipped scenario has its name, or no changes
    lead from there to here.
    """
    if scenario.name not in shipped_scenarios():
        return None
    changes, shipped = {}, load_scenario(scenario.name)
    if scenario.robot != shipped.robot:
        try:
            changes, shipped = {"robot": scenario.robot}, load_scenario(scenario.name, {"robot": scenario.robot})
        except InvalidInput:  # a file
            return None
    for field in dataclasses.fields(Scenario):
        if field.name in _LEFT_OUT:
            continue
        now, before = (_plain(getattr(it, field.name)) for it in (scenario, shipped))
        changes.update(_differences(field.name, before, now))
    try:  # some entries of a list cannot be taken away alone
        again = load_scenario(scenario.name, changes, robot_files=True)  # a file was taken before
    except InvalidInput:
        return None
    same = {name: getattr(scenario, name) for name in _LEFT_OUT}
    return changes if dataclasses.replace(again, **same) == scenario else None


def sizes_in_proportion(scenario: Scenario, path: str, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Dotted path -> value of what another robot than the one that a scenario was written for makes different.

    Empty where the file's own robot runs.

    Args:
        scenario: as it was loaded.
        path: of its file, or its name.
        changes: with which it was loaded; what they say is left out.

    Raises:
        InvalidInput: the file cannot be read.
    """
    if "robot" not in changes:
        return {}
    written = load_scenario(path, robot_files=True)
    if written.robot == scenario.robot:
        return {}
    left_out = ("name", "robot", *changes)
    names = [field.name for field in dataclasses.fields(Scenario) if field.name not in left_out]
    pairs = [(name, *(_plain(getattr(it, name)) for it in (written, scenario))) for name in names]
    found = {path: value for pair in pairs for path, value in _differences(*pair)}
    return {path: value for path, value in found.items() if path not in changes}


def _differences(path: str, before: Any, now: Any) -> Iterator[tuple[str, Any]]:
    if now == before:
        return
    if isinstance(now, Mapping):
        for key, value in now.items():
            yield from _differences(f"{path}.{key}", before.get(key) if isinstance(before, Mapping) else None, value)
    elif isinstance(now, Sequence) and any(isinstance(entry, Mapping) for entry in now):
        for i, entry in enumerate(now):
            known = isinstance(before, Sequence) and i < len(before)
            yield from _differences(f"{path}.{i}", before[i] if known else None, entry)
    else:
        yield path, list(now) if isinstance(now, tuple) else now


def _plain(value: Any) -> Any:
    """Tables as mappings, without what is not there, for the page only, or said by a preset."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        entries = {field.name: _plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
        if (preset := entries.get("preset")) is not None:
            usual = type(value)(**{"preset": preset})
            entries = {key: entry for key, entry in entries.items() if key == "preset" or entry != getattr(usual, key)}
        return {key: entry for key, entry in entries.items() if entry is not None and key != "drops"}
    return tuple(map(_plain, value)) if isinstance(value, tuple) else value
