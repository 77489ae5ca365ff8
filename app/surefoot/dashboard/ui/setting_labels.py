"""What the page calls each setting (the words of the field, the paper's symbol, the unit), and changes in words."""

import dataclasses
from collections.abc import Sequence
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.dashboard.messages.snapshot import SettingsChange
from surefoot.dashboard.ui.plot_kinds import PLOTS

_WORDS = {
    "com_stiffness": "CoM K_P",
    "com_damping": "CoM K_D",
    "pelvis_stiffness": "Trunk K_P",
    "pelvis_damping": "Trunk K_D",
    "foot_stiffness": "Swing foot K_P",
    "foot_damping": "Swing foot K_D",
    "lumbar_stiffness": "Lumbar K_P",
    "lumbar_damping": "Lumbar K_D",
    "stance_foot_damping": "Stance foot K_D",
    "delta_ref_sagittal_nm": "δ_P ref sagittal",
    "delta_ref_frontal_nm": "δ_P ref frontal",
    "zmp_margin": "ZMP margin [-]",
    "p_point": "Point P",
    "p_offset_x_m": "P offset forward x",
    "p_offset_y_m": "P offset left y",
    "p_offset_z_m": "P offset up z",
    "tangential_term": "Tangential term",
    "saturation": "ZMP limits ζ",
    "composition": "Ankle torques",
    "other_joints": "Other joints",
    "guard": "Capture guard",
    "roll_gate": "Rolled-sole gate",
    "double_support_split": "Double-support split",
    "joint_ranges": "Joint ranges",
    "latched": "Latch when infeasible",
    "delta_form": "Form of δ_P",
    "delta_source": "Source of δ_P",
    "feedforward": "Feed-forward",
    "com_weight": "Weight CoM",
    "pelvis_weight": "Weight trunk",
    "foot_weight": "Weight swing foot",
    "lumbar_weight": "Weight lumbar",
    "assumed_friction": "Friction assumed μ",
    "ankle_limits": "Ankles beyond limits",
    "joint_friction_compensation": "Joint friction",
    "solver": "QP solver",
}
_UNITS = {"1/s2": "1/s²", "m/s2": "m/s²", "N m": "N·m", "N m s/rad": "N·m·s/rad"}
_PLOT_NAMES = {plot.key: plot.name for plot in PLOTS}


def label_of(field: dataclasses.Field) -> str:
    """Words, symbol and unit."""
    words, unit = _WORDS.get(field.name, field.name.replace("_", " ")), unit_of(field)
    return f"{words} [{unit}]" if unit else words


def help_of(field: dataclasses.Field) -> str:
    """The help of the field with its equation."""
    equation = field.metadata.get("equation", "")
    return field.metadata["help"] + (f" — equation {equation}" if equation else "")


def hint_of(field: dataclasses.Field, ends: tuple[float, float] | None = None) -> str:
    """Its tooltip: help and equation, what raising it does, the plots that show it, unit and range.

    Args:
        field: of the settings.
        ends: of its slider; None: all that it may be.
    """
    meta = field.metadata
    raised = f" Raise it: {meta['raised']}." if meta.get("raised") else ""
    plots = " and ".join(f"“{name}”" for name in watched(field))
    watch = f" Watch the plot{'s' * (len(meta['watch']) > 1)} {plots}." if plots else ""
    return f"{help_of(field)}.{raised}{watch}{_range(field, ends)}"


def watched(field: dataclasses.Field) -> list[str]:
    """Names of the plots that show what a field does."""
    return [_PLOT_NAMES[key] for key in field.metadata.get("watch", ())]


def unit_of(field: dataclasses.Field) -> str:
    """Its unit as the page writes it; empty for a number without one."""
    unit: str = field.metadata.get("unit", "")
    return _UNITS.get(unit, unit)


def _range(field: dataclasses.Field, ends: tuple[float, float] | None) -> str:
    meta = field.metadata
    if meta["kind"] != "number":
        return ""
    unit, (low, high) = unit_of(field) or "no unit", ends or (meta["low"], meta["high"])
    return f" {low:g} to {high:g} [{unit}]; two-part's default {field.default:g}."


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
