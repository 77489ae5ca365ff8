"""A run as a link: ``?scenario=swing_inward&controller=optimization&controller.guard=false``."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import parse_qsl, quote, urlencode

from surefoot.control.registry import controller_named
from surefoot.control.settings import settings_differences
from surefoot.dashboard.messages.snapshot import Snapshot
from surefoot.errors import InvalidInput, SurefootError
from surefoot.experiments.scenario.scenario import Scenario, load_scenario, parse_change, shipped_scenarios

SCENARIO, CONTROLLER = "scenario", "controller"
TABLES = (  # what a dotted path may begin with
    *("controller", "physics", "reference", "footsteps"),
    *("stones", "pushes", "ground", "stones_under_steps", "ledges"),
)
FIRST_SCENARIO, FIRST_CONTROLLER = "stand_left", "two-part"
_LONGEST, _MOST = 4000, 60
_OTHERS = ("token", "websocket")  # not ours: the gate's and viser's own


@dataclass(frozen=True)
class Link:
    """What a link asks for.

    Attributes:
        scenario: a shipped one by name.
        controller: name in the registry.
        changes: dotted path -> value, as ``--set`` takes them.
    """

    scenario: str
    controller: str
    changes: Mapping[str, Any]


def asks_for_run(query: str) -> bool:
    """Whether a query says anything about a run."""
    return any(_ours(key) for key, _ in parse_qsl(query[:_LONGEST], keep_blank_values=True))


def read_link(query: str) -> Link:
    """What a query asks for.

    Raises:
        InvalidInput: too long, an unknown key, a scenario that is not a shipped one (a link never names files).
    """
    if len(query) > _LONGEST:
        raise InvalidInput("link", f"{len(query)} characters", "is too long", [f"up to {_LONGEST}"])
    pairs = [(key, value) for key, value in parse_qsl(query, keep_blank_values=True) if key not in _OTHERS]
    if len(pairs) > _MOST:
        raise InvalidInput("link", f"{len(pairs)} values", "are too many", [f"up to {_MOST}"])
    scenario, controller, changes = FIRST_SCENARIO, FIRST_CONTROLLER, {}
    for key, value in pairs:
        if key == SCENARIO:
            if value not in shipped_scenarios():
                raise InvalidInput("link: scenario", value, "no such scenario", shipped_scenarios())
            scenario = value
        elif key == CONTROLLER:
            controller = value
        elif "." in key and key.split(".")[0] in TABLES:
            changes.update([parse_change(f"{key}={value}")])
        else:
            valid = [SCENARIO, CONTROLLER, *(f"{table}.KEY" for table in TABLES)]
            raise InvalidInput(f"link: {key}", value, "unknown key", valid)
    return Link(scenario=scenario, controller=controller, changes=changes)


def link_target(link: Link) -> tuple[Scenario, dict[str, Any]]:
    """The scenario of a link, and its settings of the controller. Raises InvalidInput."""
    if link.scenario not in shipped_scenarios():
        raise InvalidInput("link: scenario", link.scenario, "no such scenario", shipped_scenarios())
    ours = {key: value for key, value in link.changes.items() if key.startswith("controller.")}
    settings = {key.partition(".")[2]: value for key, value in ours.items()}
    controller_named(link.controller).settings(settings)  # a wrong one is refused with the valid ones listed
    return load_scenario(link.scenario, {k: v for k, v in link.changes.items() if k not in ours}), settings


def link_text(link: Link) -> str:
    """What a link asks for, in words."""
    changed = "".join(f", {key} = {_plain(value)}" for key, value in link.changes.items())
    return f"scenario {link.scenario}, controller {link.controller}{changed}"


def link_query(snapshot: Snapshot) -> str | None:
    """The query that brings back the scenario, the controller and what differs of its settings.

    None when the scenario is not a shipped one: a link never names files.
    """
    if snapshot.scenario not in shipped_scenarios():
        return None
    try:
        scenario = load_scenario(snapshot.scenario)
        defaults = controller_named(snapshot.controller).settings(scenario.controller)
    except SurefootError:
        return None
    pairs = [(SCENARIO, snapshot.scenario), (CONTROLLER, snapshot.controller)]
    pairs += [
        (f"controller.{name}", _plain(value)) for name, _, value in settings_differences(defaults, snapshot.settings)
    ]
    if snapshot.friction != scenario.physics.friction:
        pairs.append(("physics.friction", _plain(snapshot.friction)))
    return urlencode(pairs, quote_via=quote)


def _plain(value: Any) -> str:
    return (
        str(value).lower() if isinstance(value, bool) else f"{value:.12g}" if isinstance(value, float) else str(value)
    )


def _ours(key: str) -> bool:
    return key in (SCENARIO, CONTROLLER) or ("." in key and key not in _OTHERS)
