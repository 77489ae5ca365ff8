"""A run as a link: ``?scenario=swing_inward&controller=optimization&controller.guard=false``."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import parse_qsl, quote, urlencode

from surefoot.control.registry import controller_named
from surefoot.control.settings import settings_differences
from surefoot.dashboard.messages.shown_robot import FIRST_ROBOT
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.scenario.robots import is_robot_file
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, parse_change, shipped_scenarios
from surefoot.robot.description import available_robots

SCENARIO, CONTROLLER, ROBOT = "scenario", "controller", "robot"
TABLES = (  # what a dotted path may begin with
    *("controller", "physics", "reference", "footsteps"),
    *("sensors", "estimator", "motors", "model_error"),
    *("stones", "pushes", "ground", "stones_under_steps", "ledges"),
)
FIRST_SCENARIO, FIRST_CONTROLLER = "stand_left", "two-part"
_FRICTION = "physics.friction"  # a person can change it while the run goes on
_LONGEST, _MOST = 4000, 60
_OTHERS = ("token", "websocket")  # not ours: the gate's and viser's own


@dataclass(frozen=True)
class Link:
    """What a link asks for.

    Attributes:
        scenario: a shipped one by name.
        controller: name in the registry.
        changes: dotted path -> value, as ``--set`` takes them.
        robot: one of those there are, by name; None: the one that is there.
    """

    scenario: str
    controller: str
    changes: Mapping[str, Any]
    robot: str | None = None


def asks_for_run(query: str) -> bool:
    """Whether a query says anything about a run."""
    return any(_ours(key) for key, _ in parse_qsl(query[:_LONGEST], keep_blank_values=True))


def read_link(query: str) -> Link:
    """What a query asks for.

    Raises:
        InvalidInput: too long, an unknown key, a scenario or robot that is not one of ours (a link never names files).
    """
    if len(query) > _LONGEST:
        raise InvalidInput("link", f"{len(query)} characters", "is too long", [f"up to {_LONGEST}"])
    pairs = [(key, value) for key, value in parse_qsl(query, keep_blank_values=True) if key not in _OTHERS]
    if len(pairs) > _MOST:
        raise InvalidInput("link", f"{len(pairs)} values", "are too many", [f"up to {_MOST}"])
    scenario, controller, robot, changes = FIRST_SCENARIO, FIRST_CONTROLLER, None, {}
    for key, value in pairs:
        if key == SCENARIO:
            if value not in shipped_scenarios():
                raise InvalidInput("link: scenario", value, "no such scenario", shipped_scenarios())
            scenario = value
        elif key == CONTROLLER:
            controller = value
        elif key == ROBOT:
            if value not in available_robots():
                raise InvalidInput("link: robot", value, "no such robot", available_robots())
            robot = value
        elif "." in key and key.split(".")[0] in TABLES:
            changes.update([parse_change(f"{key}={value}")])
        else:
            valid = [SCENARIO, CONTROLLER, ROBOT, *(f"{table}.KEY" for table in TABLES)]
            raise InvalidInput(f"link: {key}", value, "unknown key", valid)
    return Link(scenario=scenario, controller=controller, changes=changes, robot=robot)


def link_target(link: Link, robot: str = FIRST_ROBOT) -> tuple[Scenario, dict[str, Any]]:
    """The scenario of a link, in proportion to its robot, and its settings of the controller.

    Args:
        link: what it asks for.
        robot: whose scenario it is where the link names none, as scenarios say it; it may be a file.

    Raises:
        InvalidInput: the link asks for what there is not.
    """
    if link.scenario not in shipped_scenarios():
        raise InvalidInput("link: scenario", link.scenario, "no such scenario", shipped_scenarios())
    ours = {key: value for key, value in link.changes.items() if key.startswith("controller.")}
    settings = {key.partition(".")[2]: value for key, value in ours.items()}
    controller_named(link.controller).settings(settings)  # a wrong one is refused with the valid ones listed
    changes = {key: value for key, value in link.changes.items() if key not in ours}
    changes[ROBOT] = robot if link.robot is None else link.robot
    return load_scenario(link.scenario, changes, robot_files=link.robot is None), settings


def link_text(link: Link) -> str:
    """What a link asks for, in words."""
    changed = f", {changes_text(link.changes)}" if link.changes else ""
    robot = f", robot {link.robot}" if link.robot is not None else ""
    return f"scenario {link.scenario}, controller {link.controller}{robot}{changed}"


def changes_text(changes: Mapping[str, Any]) -> str:
    """Changed values, in words."""
    return ", ".join(f"{key} = {_plain(value)}" for key, value in changes.items())


def link_query(snapshot: Snapshot) -> str | None:
    """The query that brings back the scenario, the robot, the controller and what differs of its settings.

    It names the robot always: a page has one of its own, and what was changed was said for this one.

    None when the scenario is not a shipped one, with changed values or without, or the robot none of ours: a link never
    names files. None too when there is more to say than a link may.
    """
    changes = snapshot.changes
    if snapshot.scenario not in shipped_scenarios() or changes is None or is_robot_file(snapshot.robot.key):
        return None
    if not all("." in key or key == ROBOT for key in changes):
        return None
    try:
        scenario = load_scenario(snapshot.scenario, changes)
        defaults = controller_named(snapshot.controller).settings(scenario.controller)
    except SurefootError:
        return None
    pairs = [(SCENARIO, snapshot.scenario), (CONTROLLER, snapshot.controller), (ROBOT, snapshot.robot.key)]
    pairs += [
        (f"controller.{name}", _plain(value)) for name, _, value in settings_differences(defaults, snapshot.settings)
    ]
    changes = {key: value for key, value in changes.items() if key not in (_FRICTION, ROBOT)}
    if snapshot.friction != load_scenario(snapshot.scenario).physics.friction:
        changes[_FRICTION] = snapshot.friction
    pairs += [(key, _plain(value)) for key, value in changes.items()]
    query = urlencode(pairs, quote_via=quote)
    return query if len(pairs) <= _MOST and len(query) <= _LONGEST else None


def _plain(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_plain, value))}]"
    if isinstance(value, float):
        short = f"{value:.12g}"
        return short if float(short) == value else repr(value)
    return str(value)


def _ours(key: str) -> bool:
    return key in (SCENARIO, CONTROLLER, ROBOT) or ("." in key and key not in _OTHERS)
