"""The variants that a price list compares: perfect, one imperfection at a time, and all of them together."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.estimation.registry import TRUTH, estimator_named
from surefoot.experiments.bench.entries import OF_SCENARIO
from surefoot.experiments.bench.imperfections import IMPERFECTIONS, KIND, SENSORS, imperfections_of
from surefoot.experiments.scenario.scenario import parse_change

NONE, ESTIMATOR, TOGETHER = "perfect", "estimator", "together"


@dataclass(frozen=True, kw_only=True)
class Variant:
    """One line of the list.

    Attributes:
        name: of the imperfection, or one of the three above.
        changes: of the scenario (dotted path -> value).
        base: the variant that lacks nothing but this; empty for ``perfect``, which has none.
    """

    name: str
    changes: Mapping[str, Any]
    base: str


def variants(preset: str, estimator: str, chosen: Sequence[str] = ()) -> list[Variant]:
    """All of them, perfect first, together last.

    An imperfection of the sensors is compared with perfect sensors read by the same estimator, whose price is a line of
    its own; all others with ``perfect``. So the lines add up to ``together``, but for what they do to one another.

    Args:
        preset: whose imperfections.
        estimator: what reads the sensors; with ``truth`` the imperfections of the sensors are left out.
        chosen: only these; ``NAME+key=value+...`` is one of your own.

    Raises:
        InvalidInput: no such preset, estimator or imperfection, or nothing is left.
    """
    estimator_named(estimator)
    known: dict[str, Mapping[str, Any]] = {**imperfections_of(preset)}
    asked = {name: changes for name, changes in (_parsed(text, known) for text in chosen)} if chosen else known
    if len(asked) < len(chosen):
        raise InvalidInput("--imperfections", ",".join(chosen), "one is named twice")
    read = estimator != TRUTH
    singles = {name: changes for name, changes in asked.items() if read or not _of_sensors(changes)}
    if left_out := [name for name in asked if name not in singles] if chosen else []:
        reason = "nobody reads the sensors: the controller gets the true state; say which --estimator"
        raise InvalidInput("--imperfections", ",".join(left_out), reason, ["anchor", "invariant-ekf"])
    if not singles and not read:
        reason = "nothing differs from perfect"
        raise InvalidInput("--preset", preset, reason, ["lab", "robot", "cheap"])
    reads = {KIND: estimator} if read else {}
    found = [Variant(name=NONE, changes={}, base="")]
    if read:
        found.append(Variant(name=ESTIMATOR, changes=reads, base=NONE))
    for name, changes in singles.items():
        on_sensors = _of_sensors(changes)
        found.append(
            Variant(
                name=name, changes={**(reads if on_sensors else {}), **changes}, base=ESTIMATOR if on_sensors else NONE
            )
        )
    every = {path: value for changes in singles.values() for path, value in changes.items()}
    return [*found, Variant(name=TOGETHER, changes={**reads, **every}, base=NONE)]


def _of_sensors(changes: Mapping[str, Any]) -> bool:
    return any(path.startswith(SENSORS) for path in changes)


def _parsed(text: str, known: Mapping[str, Mapping[str, Any]]) -> tuple[str, Mapping[str, Any]]:
    """One that is asked for by name, or is told whole."""
    name, *parts = text.split("+")
    if not parts:
        if name in known:
            return name, known[name]
        other = name in IMPERFECTIONS
        reason = "the preset does not have it" if other else "no such imperfection"
        raise InvalidInput("--imperfections", name, reason, [*known, "NAME+physics.control_delay_s=0.002"])
    if name in (*IMPERFECTIONS, NONE, ESTIMATOR, TOGETHER) or not name:
        raise InvalidInput("--imperfections", text, "one of your own needs a name of its own")
    changes = dict(parse_change(part) for part in parts)
    for path in changes:
        if not path.startswith(OF_SCENARIO) or path == KIND:
            raise InvalidInput("--imperfections", path, "is no imperfection", OF_SCENARIO)
    return name, changes
