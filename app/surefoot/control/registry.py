"""Controllers by name: the four that ship and any that an installed package brings."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.metadata import EntryPoint
from typing import Any

from surefoot.control.controllers.optimization import Optimization
from surefoot.control.controllers.soft_qp import SoftQP
from surefoot.control.controllers.two_part import TwoPart
from surefoot.control.interface import Controller
from surefoot.control.joint_friction import FrictionCompensated
from surefoot.control.settings import ControllerSettings
from surefoot.errors import ControllerError, InvalidInput, SurefootError, one_line
from surefoot.field_metadata import from_mapping
from surefoot.plug_ins import Registry, registry_of
from surefoot.robot.description import RobotDescription

ENTRY_POINT_GROUP = "surefoot.controllers"
_SEPARATORS = ",+"  # of lists of controllers: see ``bench_entries``


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

    def make(self, robot: RobotDescription, settings: ControllerSettings) -> Controller:
        """Build one. Raises what the controller itself raises for the user, ControllerError for all else."""
        try:
            controller = self.build(robot, settings)
        except SurefootError:
            raise
        except (Exception, SystemExit) as error:  # it may be someone else's code
            raise ControllerError(self.name, f"cannot be built ({one_line(error)})") from error
        for method in ("tick", "reset"):
            if not callable(getattr(controller, method, None)):
                raise ControllerError(self.name, f"its build gave a {type(controller).__name__} without {method}()")
        return FrictionCompensated(controller, robot, settings) if settings.joint_friction_compensation else controller


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


def controllers() -> dict[str, ControllerEntry]:
    """Every controller by name; those of the entry-point group ``surefoot.controllers`` come after ours.

    An entry point names a ``ControllerEntry``. One that cannot be used leaves the others alone: see
    ``unavailable_controllers``.
    """
    return dict(_registry().entries)


def unavailable_controllers() -> dict[str, str]:
    """The entry points that bring no controller, by name, and why."""
    return _registry().unavailable


def entry_point_of(name: str) -> EntryPoint | None:
    """The entry point that brings a controller; None for ours. Raises InvalidInput for an unknown one."""
    return _registry().points.get(controller_named(name).name)


def controller_named(name: str) -> ControllerEntry:
    """The controller of that name. Raises InvalidInput listing the names there are, and those that cannot be used."""
    registry = _registry()
    if name in registry.entries:
        return registry.entries[name]
    unavailable = unavailable_controllers()
    if name in unavailable:
        raise InvalidInput("controller", name, f"is not available: {unavailable[name]}", registry.entries)
    others = "".join(f"; {other} is not available: {reason}" for other, reason in unavailable.items())
    raise InvalidInput("controller", name, f"no such controller{others}", registry.entries)


def forget_controllers() -> None:
    """Look for controllers again when they are next asked for: packages may have come or gone."""
    _registry.cache_clear()


@lru_cache(maxsize=1)
def _registry() -> Registry[ControllerEntry]:
    return registry_of(ENTRY_POINT_GROUP, _BUILT_IN, _fault)


def _fault(entry: Any, taken: Mapping[str, ControllerEntry]) -> str:
    """What is wrong with what an entry point names; empty when it can be used."""
    if not isinstance(entry, ControllerEntry):
        return f"is no ControllerEntry but a {type(entry).__name__}"
    name = entry.name
    if not isinstance(name, str) or not name or any(sign.isspace() or sign in _SEPARATORS for sign in name):
        return f"has the name {name!r}: it must be a word without , and +"
    if name in taken:
        return f"has the name {name!r}, which another controller has"
    if not isinstance(entry.help, str) or not callable(entry.build):
        return "has a help that is no text, or a build that cannot be called"
    try:
        entry.settings()
    except SurefootError as error:
        return f"has a preset that cannot be used ({error})"
    return ""
