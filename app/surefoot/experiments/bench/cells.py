"""A cell: one disturbance of growing intensity, one controller, one seed. Plain data: it travels and is hashed."""

import copy
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from surefoot.experiments.scenario.bounds import push_bound, step_impulse
from surefoot.experiments.scenario.robots import without_folder
from surefoot.experiments.scenario.scenario import Scenario, scenario_from_table, set_in_table


@dataclass(frozen=True, kw_only=True)
class Case:
    """A disturbance with one knob.

    Attributes:
        family: e.g. ``push``.
        name: which of the family, e.g. ``45 deg``.
        table: the scenario file, parsed, at any level.
        knob: dotted path of the value that grows.
        levels: its sizes, ascending, in ``unit``.
        unit: ``m``, ``deg``, ``N s``, ``J/J_cap`` or ``J/J_cap1``.
        sign: the knob is turned to sign x level (x J_cap when the unit is ``J/J_cap``, x J_cap1 likewise).
        goal: a level worth reaching: what physics allows where that is known, else a round figure; None for none.
    """

    family: str
    name: str
    table: Mapping[str, Any]
    knob: str
    levels: tuple[float, ...]
    unit: str
    sign: float = 1.0
    goal: float | None = None

    def table_at(self, level: float, changes: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """The parsed scenario file at one level, after ``changes`` (dotted path -> value)."""
        table = copy.deepcopy(dict(self.table))
        for path, value in (changes or {}).items():
            set_in_table(table, path, value)
        value = self.sign * level
        if self.unit == "J/J_cap":
            value *= push_bound(scenario_from_table(table, robot_files=True)).impulse_ns
        elif self.unit == "J/J_cap1":
            value *= step_impulse(scenario_from_table(table, robot_files=True))
        set_in_table(table, self.knob, round(value, 9))
        return table


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A case under one controller with one seed; the unit of work, of storage and of resuming.

    Attributes:
        case: the disturbance, already varied by the seed.
        label: how tables call the controller.
        controller: its name in the registry.
        settings: what differs from the controller's own settings.
        changes: further changes of the scenario, e.g. ``physics.friction``.
        seed: 0 is the case as designed; others are varied.
        every_level: run every level instead of bisecting.
        code: fingerprint of the code, and of the robot's files, that decide the outcome.
    """

    case: Case
    label: str
    controller: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    changes: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    every_level: bool = False
    code: str = ""

    @property
    def key(self) -> str:
        """Names the cell for ever: the same only if everything that decides its outcome is the same."""
        case = self.case
        what = [
            case.family,
            case.name,
            without_folder(case.table),
            case.knob,
            case.levels,
            case.unit,
            case.sign,
            case.goal,
            self.label,
            self.controller,
            self.settings,
            self.changes,
            self.seed,
            self.every_level,
            self.code,
        ]
        return hashlib.sha256(json.dumps(what, sort_keys=True).encode()).hexdigest()[:24]

    def table_at(self, level: float) -> dict[str, Any]:
        """The parsed scenario file of one level."""
        table = self.case.table_at(level, self.changes)
        if self.settings:
            table["controller"] = dict(self.settings)
        return table

    def scenario_at(self, level: float) -> Scenario:
        """The checked scenario of one level. Raises InvalidInput."""
        return scenario_from_table(self.table_at(level), f"{self.case.family} {self.case.name}", robot_files=True)
