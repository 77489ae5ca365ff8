"""What a robot may be asked for where that goes with its size: the ranges that Bip's fields describe, in proportion."""

import dataclasses
from collections.abc import Collection
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.scenario.proportions import proportions_of, scaled
from surefoot.field_metadata import described, range_of


def own_range(cls: type, name: str, robot: str) -> tuple[float, float]:
    """Least and greatest value of a number field for a robot, rounded as what is in proportion to it.

    Args:
        cls: the settings dataclass.
        name: of the field.
        robot: as scenarios name it.

    Raises:
        InvalidInput: the robot cannot be used.
    """
    low, high = range_of(cls, name)
    size = described(cls, name).get("goes_with")
    ratio = getattr(proportions_of(robot), size) if size else 1.0
    return scaled(low, ratio), scaled(high, ratio)


def check_own_ranges(instance: Any, prefix: str, robot: str, *, besides: Collection[str] = ()) -> None:
    """Check the fields of a settings dataclass whose range goes with the robot.

    Args:
        instance: of the dataclass.
        prefix: of the fields' names in errors.
        robot: as scenarios name it.
        besides: fields that are not looked at.

    Raises:
        InvalidInput: a value that this robot cannot be asked for, with its own range.
    """
    for field in dataclasses.fields(instance):
        if not field.metadata.get("goes_with") or field.name in besides:
            continue
        value, (low, high) = getattr(instance, field.name), own_range(type(instance), field.name, robot)
        if not low <= value <= high:
            valid = [f"{low:g} to {high:g} {field.metadata['unit']}"]
            raise InvalidInput(f"{prefix}.{field.name}", value, "out of range for this robot", valid)
