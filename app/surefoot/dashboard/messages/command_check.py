"""Whether a command is of the kind that its class says: a widget's value is whatever a browser sent."""

import dataclasses
import re
from collections.abc import Mapping
from typing import Any, get_args, get_origin

from surefoot.dashboard.messages.command_base import Command
from surefoot.errors import InvalidInput

_LONGEST_TEXT, _MOST_ENTRIES = 4000, 200
_NO_NUMBER = float("inf")
_SCALARS = (bool, int, float, str)


def check_command(command: Command) -> None:
    """Refuse numbers that are none, and what is of another kind than the field. Raises InvalidInput.

    What is in range, or there at all, whoever obeys the command knows.
    """
    if dataclasses.is_dataclass(command):
        for field in dataclasses.fields(command):
            value = getattr(command, field.name)
            if not _fits(value, field.type):
                raise InvalidInput(f"{_name(command)}.{field.name}", value, f"must be {_words(field.type)}")


def _fits(value: Any, kind: Any) -> bool:
    if kind is float:
        return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < _NO_NUMBER  # NaN neither
    if kind is int:
        return isinstance(value, int) and not isinstance(value, bool)
    if kind is str:
        return isinstance(value, str) and len(value) <= _LONGEST_TEXT
    if get_origin(kind) is tuple:
        kinds = get_args(kind)
        return isinstance(value, tuple) and len(value) == len(kinds) and all(map(_fits, value, kinds))
    if get_origin(kind) is Mapping:
        return isinstance(value, Mapping) and len(value) <= _MOST_ENTRIES and all(map(_is_entry, value.items()))
    return isinstance(value, kind)


def _is_entry(entry: tuple[Any, Any]) -> bool:
    """A setting's own check knows which numbers are valid, and says so."""
    name, value = entry
    return isinstance(name, str) and isinstance(value, _SCALARS)


def _name(command: Command) -> str:
    """``PlaceStone`` as ``place_stone``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", type(command).__name__).lower()


def _words(kind: Any) -> str:
    if kind in (float, int):
        return "a number" if kind is float else "a whole number"
    if get_origin(kind) is tuple:
        return f"{len(get_args(kind))} numbers"
    if get_origin(kind) is Mapping:
        return "names with a number, a text, or true or false each"
    return "a text" if kind is str else "true or false"
