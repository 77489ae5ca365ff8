"""All that was done to a run since its start, as plain values: with the scenario they make the same run again."""

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

from surefoot.dashboard.live.rewind.history import Journal
from surefoot.dashboard.messages import commands as cmd
from surefoot.dashboard.messages.command_base import WorldCommand
from surefoot.dashboard.messages.command_check import check_command
from surefoot.errors import InvalidInput
from surefoot.field_metadata import from_mapping

_DISTURBANCES: Mapping[str, type[WorldCommand]] = {
    name: kind for name, kind in vars(cmd).items() if isinstance(kind, type) and issubclass(kind, WorldCommand)
}
_MOST_TICKS = 10**8  # more than a day


@dataclasses.dataclass(frozen=True)
class Deed:
    """One thing that was done.

    Attributes:
        tick: ticks before it.
        disturbance: a command to the world, or
        led_to: the controller, and its changed settings, that drove from then on.
    """

    tick: int
    disturbance: WorldCommand | None = None
    led_to: tuple[str, Mapping[str, Any]] | None = None


def run_script(controller: str, changes: Mapping[str, Any], ticks: int, journal: Journal) -> dict[str, Any]:
    """The script as it stands in a manifest.

    Args:
        controller: that the run began with.
        changes: of its settings, likewise.
        ticks: from the start to now.
        journal: what was obeyed, and when.
    """
    done: list[list[Any]] = []
    for entry in journal.entries:
        if entry.tick <= ticks and entry.disturbs:
            done.append([entry.tick, type(entry.command).__name__, dataclasses.asdict(entry.command)])
        elif entry.tick <= ticks and entry.led_to is not None:
            done.append([entry.tick, *entry.led_to])
    return {"controller": controller, "changes": dict(changes), "ticks": ticks, "done": done, "whole": journal.whole}


def read_script(script: Any) -> tuple[str, Mapping[str, Any], int, tuple[Deed, ...]]:
    """Controller, changes and ticks of a script, and what was done. Raises InvalidInput: it makes no sense."""
    try:
        controller, changes, ticks = script["controller"], script["changes"], script["ticks"]
        good = isinstance(controller, str) and isinstance(changes, dict) and type(ticks) is int
        if not good or not 0 <= ticks <= _MOST_TICKS:
            raise ValueError("controller, changes or ticks are none")
        if script["whole"] is not True:
            raise InvalidInput("script", "not whole", "more was done to that run than its file could keep")
        deeds = tuple(_deed(*entry) for entry in script["done"])
    except (KeyError, TypeError, ValueError) as error:
        raise InvalidInput("script", f"{error}", "is not that of a saved run") from None
    return controller, changes, ticks, tuple(sorted(deeds, key=lambda deed: deed.tick))


def perform(ticks: int, deeds: tuple[Deed, ...], tick: Callable[[], object], do: Callable[[Deed], object]) -> None:
    """Tick from the start to the end, and do everything in its time."""
    coming = iter((*deeds, Deed(ticks + 1)))
    deed = next(coming)
    for now in range(ticks + 1):
        while deed.tick == now:
            do(deed)
            deed = next(coming)
        if now < ticks:
            tick()


def _deed(tick: Any, name: Any, values: Any) -> Deed:
    if type(tick) is not int or tick < 0 or not isinstance(name, str) or not isinstance(values, dict):
        raise ValueError("what was done is no list of tick, name and values")
    if name not in _DISTURBANCES:
        return Deed(tick, led_to=(name, values))
    plain = {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}
    command = from_mapping(_DISTURBANCES[name], plain, f"script.{name}")
    check_command(command)
    return Deed(tick, disturbance=command)
