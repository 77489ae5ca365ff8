"""Changes of settings in words."""

import dataclasses
from collections.abc import Sequence
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages.snapshot import SettingsChange
from surefoot.dashboard.ui.setting_labels import label_of, unit_of

Differences = Sequence[tuple[str, Any, Any]]
FIELDS = {field.name: field for field in dataclasses.fields(ControllerSettings)}


def name_of(setting: str) -> str:
    """What the page calls a setting, without its unit."""
    return label_of(FIELDS[setting]).partition(" [")[0]


def value_text(value: Any) -> str:
    """A value without its unit."""
    if isinstance(value, bool):
        return "on" if value else "off"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def difference_text(setting: str, before: Any, after: Any, *, unit: bool = False) -> str:
    """``CoM K_P 60 → 70``, with the unit if asked for."""
    mark = unit_of(FIELDS[setting]) if unit else ""
    return f"{name_of(setting)} {value_text(before)} → {value_text(after)}{f' {mark}' if mark else ''}"


def change_text(change: SettingsChange, most: int = 1) -> str:
    """A change in a line that names up to ``most`` settings and counts the others."""
    before, after = change.controller
    parts = [f"{before} → {after}"] if before != after else []
    shown = change.values if len(change.values) <= most else change.values[: max(most - len(parts), 0)]
    parts += [difference_text(*value) for value in shown]
    more = len(change.values) - len(shown)
    if more:
        parts.append(f"{more} more" if parts else f"{more} settings")
    return ", ".join(parts) or "nothing that shows here"
