"""Settings dataclasses described once: range, unit and help are field metadata that files, flags and sliders share."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, TypeVar

from surefoot.errors import InvalidInput

T = TypeVar("T")


def number(
    default: float,
    low: float,
    high: float,
    unit: str,
    help: str,
    *,
    group: str = "",
    equation: str = "",
    step: float = 0.0,
    raised: str = "",
    watch: tuple[str, ...] = (),
    goes_with: str = "",
) -> Any:
    """A float field that accepts ``low`` to ``high``; ``raised`` is what more of it does, ``watch`` the plots' keys.

    ``goes_with`` names the size of the robot (a ratio of ``Proportions``) that the range goes with: low and high are
    then Bip's, and the field itself takes any finite number; who knows the robot checks it (``check_own_ranges``).
    """
    return dataclasses.field(
        default=default,
        metadata={
            "kind": "number",
            "low": low,
            "high": high,
            "unit": unit,
            "help": help,
            "group": group,
            "equation": equation,
            "step": step or (high - low) / 100.0,
            "raised": raised,
            "watch": watch,
            "goes_with": goes_with,
        },
    )


def preset_number(low: float, high: float, unit: str, help: str, *, step: float = 0.0) -> Any:
    """A ``number`` whose value, where none is given, is that of the preset: see ``take_preset``."""
    return number(None, low, high, unit, help, step=step)  # pyright: ignore[reportArgumentType]


def count(default: int, low: int, high: int, help: str) -> Any:
    """A field of whole numbers from ``low`` to ``high``."""
    return dataclasses.field(default=default, metadata={"kind": "count", "low": low, "high": high, "help": help})


def switch(default: bool, help: str, *, group: str = "", equation: str = "", watch: tuple[str, ...] = ()) -> Any:
    """A bool field; ``watch``: keys of the plots that show what it does."""
    return dataclasses.field(
        default=default,
        metadata={
            "kind": "switch",
            "help": help,
            "group": group,
            "equation": equation,
            "watch": watch,
        },
    )


def choice(
    default: str,
    valid: tuple[str, ...],
    help: str,
    *,
    group: str = "",
    equation: str = "",
    watch: tuple[str, ...] = (),
    formerly: str = "",
) -> Any:
    """A field with a few valid words; ``watch``: keys of the plots that show it, ``formerly``: a name still read."""
    return dataclasses.field(
        default=default,
        metadata={
            "kind": "choice",
            "valid": valid,
            "help": help,
            "group": group,
            "equation": equation,
            "watch": watch,
            "formerly": formerly,
        },
    )


def check_fields(instance: Any, prefix: str) -> None:
    """Check every described field of a frozen dataclass, for its ``__post_init__``. Raises InvalidInput."""
    for field in dataclasses.fields(instance):
        value = getattr(instance, field.name)
        object.__setattr__(instance, field.name, _checked(value, field.metadata, f"{prefix}.{field.name}".lstrip(".")))


def from_mapping(cls: type[T], table: Mapping[str, Any], prefix: str) -> T:
    """Build a dataclass from a table of a file. Raises InvalidInput for an unknown key or a bad value."""
    table = with_current_names(cls, table)
    known = [field.name for field in dataclasses.fields(cls)]  # type: ignore[arg-type]
    for key in table:
        if key not in known:
            raise InvalidInput(f"{prefix}.{key}", table[key], "unknown setting", known)
    return cls(**table)


def take_preset(instance: Any, presets: Mapping[str, Mapping[str, Any]], prefix: str) -> None:
    """Give the fields of a frozen dataclass that are None what its ``preset`` says, for its ``__post_init__``.

    Raises:
        InvalidInput: there is no such preset.
    """
    name = instance.preset
    if not isinstance(name, str) or name not in presets:
        raise InvalidInput(f"{prefix}.preset", name, "no such preset", presets)
    for field, value in presets[name].items():
        if getattr(instance, field) is None:
            object.__setattr__(instance, field, value)


def described(cls: type, name: str) -> Mapping[str, Any]:
    """How a field of a settings dataclass is described: range, unit, help and the like."""
    return next(field.metadata for field in dataclasses.fields(cls) if field.name == name)


def range_of(cls: type, name: str) -> tuple[float, float]:
    """Least and greatest value that a number field accepts; Bip's where that goes with the robot."""
    meta = described(cls, name)
    return meta["low"], meta["high"]


def with_current_names(cls: type, table: Mapping[str, Any]) -> dict[str, Any]:
    """The table, fields that had another name when it was written under their name of today; later entries win."""
    old = {
        field.metadata["formerly"]: field.name for field in dataclasses.fields(cls) if field.metadata.get("formerly")
    }
    return {old.get(key, key): value for key, value in table.items()}


def _checked(value: Any, meta: Mapping[str, Any], name: str) -> Any:
    kind = meta.get("kind")
    if kind == "number":
        low, high, unit = meta["low"], meta["high"], meta["unit"]
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise InvalidInput(name, value, "must be a number", [f"{low:g} to {high:g} {unit}".strip()])
        if meta.get("goes_with"):
            if not math.isfinite(value):
                raise InvalidInput(name, value, "must be a finite number")
        elif not low <= value <= high:  # NaN too
            raise InvalidInput(name, value, "out of range", [f"{low:g} to {high:g} {unit}".strip()])
        return float(value)
    if kind == "count":
        valid = [f"{meta['low']} to {meta['high']}"]
        if isinstance(value, bool) or not isinstance(value, int | float) or value != value // 1:  # NaN, infinity too
            raise InvalidInput(name, value, "must be a whole number", valid)
        if not meta["low"] <= value <= meta["high"]:
            raise InvalidInput(name, value, "out of range", valid)
        return int(value)
    if kind == "switch" and not isinstance(value, bool):
        raise InvalidInput(name, value, "must be true or false", ["true", "false"])
    if kind == "choice" and value not in meta["valid"]:
        raise InvalidInput(name, value, "no such choice", meta["valid"])
    return value
