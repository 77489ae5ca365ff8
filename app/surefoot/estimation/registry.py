"""Estimators by name: ours, and any that an installed package brings."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import EntryPoint
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.estimation.anchor import Anchor
from surefoot.estimation.interface import Estimator
from surefoot.estimation.invariant_ekf import InvariantEKF
from surefoot.plug_ins import Registry, registry_of
from surefoot.robot.description import RobotDescription
from surefoot.robot.sensing import ImuMount, SensorNoise

ENTRY_POINT_GROUP = "surefoot.estimators"
TRUTH = "truth"

BuildEstimator = Callable[[RobotDescription, ImuMount, SensorNoise], Estimator]


@dataclass(frozen=True)
class EstimatorEntry:
    """One estimator as the program offers it.

    Attributes:
        name: what the user types.
        help: one line.
        build: nominal robot, place of the IMU and data sheets of the sensors -> estimator; None for the true state,
            which no estimator is needed for.
    """

    name: str
    help: str
    build: BuildEstimator | None


_BUILT_IN = (
    EstimatorEntry(TRUTH, "no estimator: the controller gets the true state, which no robot has", None),
    EstimatorEntry("anchor", "attitude filter on the IMU, position by where the loaded feet were put down", Anchor),
    EstimatorEntry(
        "invariant-ekf",
        "contact-aided invariant Kalman filter of IMU, feet and biases (arXiv 1904.09251)",
        InvariantEKF,
    ),
)


def estimators() -> dict[str, EstimatorEntry]:
    """Every estimator by name; those of the entry-point group ``surefoot.estimators`` come after ours."""
    return dict(_registry().entries)


def unavailable_estimators() -> dict[str, str]:
    """The entry points that bring no estimator, by name, and why."""
    return _registry().unavailable


def estimator_named(name: str) -> EstimatorEntry:
    """The estimator of that name. Raises InvalidInput listing the names there are, and those that cannot be used."""
    entries, unavailable = estimators(), unavailable_estimators()
    if isinstance(name, str) and name in entries:
        return entries[name]
    others = "".join(f"; {other} is not available: {reason}" for other, reason in unavailable.items())
    raise InvalidInput("estimator.kind", name, f"no such estimator{others}", entries)


def estimator_point(name: str) -> EntryPoint | None:
    """The entry point that brings an estimator; None for ours. Raises InvalidInput for an unknown one."""
    return _registry().points.get(estimator_named(name).name)


def forget_estimators() -> None:
    """Look for estimators again when they are next asked for: packages may have come or gone."""
    _registry.cache_clear()


@lru_cache(maxsize=1)
def _registry() -> Registry[EstimatorEntry]:
    return registry_of(ENTRY_POINT_GROUP, _BUILT_IN, _fault)


def _fault(entry: Any, taken: Mapping[str, EstimatorEntry]) -> str:
    """What is wrong with what an entry point names; empty when it can be used."""
    if not isinstance(entry, EstimatorEntry):
        return f"is no EstimatorEntry but a {type(entry).__name__}"
    if not isinstance(entry.name, str) or not entry.name or any(sign.isspace() for sign in entry.name):
        return f"has the name {entry.name!r}: it must be a word"
    if entry.name in taken:
        return f"has the name {entry.name!r}, which another estimator has"
    if not isinstance(entry.help, str) or not callable(entry.build):
        return "has a help that is no text, or a build that cannot be called"
    return ""
