"""Controllers by name: the four that ship and any that an installed package brings."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from surefoot.control.controllers.optimization import Optimization
from surefoot.control.controllers.soft_qp import SoftQP
from surefoot.control.controllers.two_part import TwoPart
from surefoot.control.interface import Controller
from surefoot.control.settings import ControllerSettings
from surefoot.errors import InvalidInput
from surefoot.field_metadata import from_mapping
from surefoot.robot.description import RobotDescription

ENTRY_POINT_GROUP = "surefoot.controllers"


@dataclass(frozen=True)
class ControllerEntry:
    """One controller as the program offers it.

    Attributes:
        name: what the user types.
        help: one line.
        build: robot and settings -> controller.
        preset: settings that differ from the defaults for this controller.
    """

    name: str
    help: str
    build: Callable[[RobotDescription, ControllerSettings], Controller]
    preset: Mapping[str, Any] = field(default_factory=dict)

    def settings(self, changes: Mapping[str, Any] | None = None) -> ControllerSettings:
        """Defaults, then this controller's preset, then ``changes``. Raises InvalidInput."""
        return from_mapping(ControllerSettings, {**self.preset, **(changes or {})}, "controller")


_LITERAL: dict[str, Any] = {
    "p_point": "ground",
    "tangential_term": False,
    "saturation": "none",
    "guard": False,
    "composition": "override",
    "other_joints": "inverse-dynamics",
}

_BUILT_IN = (
    ControllerEntry("two-part", "ankles by delta_P (28) with capture guard, the rest by the QP", TwoPart),
    ControllerEntry(
        "optimization", "the paper's baseline: hard tracking, holds the last torques when infeasible", Optimization
    ),
    ControllerEntry(
        "soft-qp",
        "the modern baseline: weighted least squares under contact and torque limits",
        SoftQP,
        {"guard": False, "com_weight": 1.0, "foot_weight": 1.0},
    ),
    ControllerEntry(
        "two-part-literal", "(28) as printed: P on the ground, no tangential term, no limits", TwoPart, _LITERAL
    ),
)


@lru_cache(maxsize=1)
def controllers() -> dict[str, ControllerEntry]:
    """Every controller by name; those of the entry-point group ``surefoot.controllers`` come after ours.

    An entry point names a ``ControllerEntry``; one that reuses a name of ours is refused.
    """
    found = {entry.name: entry for entry in _BUILT_IN}
    for point in entry_points(group=ENTRY_POINT_GROUP):
        try:
            entry = point.load()
        except Exception as error:  # it is someone else's code: whatever goes wrong there is told by its name
            reason = f"cannot be loaded ({type(error).__name__}: {error}); repair or uninstall its package"
            raise InvalidInput(f"entry point {point.name}", point.value, reason) from error
        if not isinstance(entry, ControllerEntry) or entry.name in found:
            raise InvalidInput(f"entry point {point.name}", entry, "must be a ControllerEntry with a name of its own")
        found[entry.name] = entry
    return found


def entry_point_of(name: str) -> EntryPoint | None:
    """The entry point that brings a controller; None for ours. Raises InvalidInput for an unknown one."""
    entry = controller_named(name)
    return next((point for point in entry_points(group=ENTRY_POINT_GROUP) if point.load() is entry), None)


def controller_named(name: str) -> ControllerEntry:
    """The controller of that name. Raises InvalidInput listing the names there are."""
    if name not in controllers():
        raise InvalidInput("controller", name, "no such controller", controllers())
    return controllers()[name]
