"""The families of disturbances that a robot stands: every case is a scenario file with one value that grows.

All episodes last 3.5 s: what happens begins at 0.3 s, which leaves about two seconds (after a stone and a push 1.2 s)
to come to rest before the last second is judged.
"""

from collections.abc import Callable, Sequence
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.cells import Case
from surefoot.experiments.bench.ladders import BIP, EIGHT, TWO, WORDS, in_proportion, rungs
from surefoot.experiments.bench.walk_families import WALK, WALK_FAMILIES
from surefoot.experiments.scenario.bounds import capture_margin
from surefoot.experiments.scenario.proportions import proportions_of, scaled
from surefoot.experiments.scenario.robots import robot_named
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.experiments.scenario.sole_places import sole_places
from surefoot.robot.feet import Support

# family -> (quick, full), for Bip
LADDERS = {
    "swing": (rungs(0.01, 0.07, 7), rungs(0.005, 0.075, 15)),
    "stone": ((0.006, 0.008, 0.010, 0.012, 0.014, 0.020, 0.028), rungs(0.002, 0.032, 31)),
    "landing": (rungs(0.006, 0.018, 3), rungs(0.002, 0.023, 15)),
    "push": ((0.5, 0.65, 0.8, 0.9, 0.95, 1.0, 1.1), rungs(0.45, 1.2, 31)),
    "push-double": ((0.8, 0.95, 1.05), rungs(0.45, 1.2, 31)),
    "trunk": (rungs(15.0, 45.0, 3), rungs(2.0, 62.0, 31)),
    "stone-push": (rungs(10.0, 30.0, 3), rungs(2.0, 62.0, 31)),
    "slope": ((1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0), rungs(1.0, 15.0, 15)),
    "tilt": (rungs(2.0, 14.0, 7), rungs(1.0, 15.0, 15)),
    "stand": ((10.0,), (60.0,)),
}


DURATION_S = 3.5
EVENT_S = 0.3
SECOND_EVENT_S = 1.2
PUSH_DURATION_S = 0.1
DROP_HEIGHT_M = 0.03
_STONE_M = 0.06
_HEIGHT_M = 0.010  # of a stone, until the level says it; the goal too
_STONE_BEFORE_PUSH_M = 0.008
_ETA_GOAL = 0.95
_CAPTURE_STEP_S = 0.005


def cases(names: Sequence[str] = (), *, quick: bool = False, robot: str = BIP) -> list[Case]:
    """The cases of some families: by default of all that stand; ``walk`` is all that step.

    Lengths and impulses are Bip's, another robot's in proportion; angles, durations and shares of J_cap are the same.

    Args:
        names: of the families.
        quick: fewer, with coarser levels.
        robot: as scenarios name it.

    Raises:
        InvalidInput: an unknown name, a robot that cannot be used.
    """
    known = {**FAMILIES, **QUIET_FAMILIES, **WALK_FAMILIES}
    for name in names:
        if name != WALK and name not in known:
            raise InvalidInput("--families", name, "no such family", [*FAMILIES, *QUIET_FAMILIES, WALK, *WALK_FAMILIES])
    wanted = {*(names or FAMILIES), *(WALK_FAMILIES if WALK in names else ())}
    return [case for name, make in known.items() if name in wanted for case in make(robot, quick)]


def coarse_levels(case: Case) -> tuple[float, ...]:
    """The levels of a case's quick sibling."""
    ratio = case.levels[-1] / LADDERS[case.family][1][-1]
    return in_proportion(LADDERS[case.family][0], ratio)


def _table(robot: str, support: Support = Support.LEFT, **more: Any) -> dict[str, Any]:
    return {"robot": robot, "support": support.value, "duration_s": DURATION_S, **more}


def _case(
    family: str, name: str, quick: bool, table: dict[str, Any], knob: str, unit: str, ratio: float = 1.0, **more: Any
) -> Case:
    levels = in_proportion(LADDERS[family][0 if quick else 1], ratio)
    return Case(family=family, name=name, table=table, knob=knob, unit=unit, levels=levels, **more)


def _push(direction: float, link: str = "com", start_s: float = EVENT_S) -> list[dict[str, Any]]:
    return [
        {
            "link": link,
            "direction_deg": direction,
            "impulse_ns": 0.0,
            "start_s": start_s,
            "duration_s": PUSH_DURATION_S,
        }
    ]


def stone_size(robot: str) -> list[float]:
    """Length and width [m] of the stones that come up or lie under the robot's sole."""
    ratios = proportions_of(robot)
    return [scaled(_STONE_M, ratios.sole_length), scaled(_STONE_M, ratios.sole_width)]


def _rising(robot: str, place: tuple[float, float], height_m: float) -> list[dict[str, Any]]:
    return [
        {
            "x_m": place[0],
            "y_m": place[1],
            "height_m": height_m,
            "size_m": stone_size(robot),
            "rise_start_s": EVENT_S,
            "rise_duration_s": 0.3,
        }
    ]


def _swings(robot: str, quick: bool) -> list[Case]:
    found, ratios = [], proportions_of(robot)
    for axis, sign, word in (
        ("lateral", -1.0, "inward"),
        ("lateral", 1.0, "outward"),
        ("sagittal", 1.0, "forward"),
        ("sagittal", -1.0, "backward"),
    ):
        for duration in (0.5,) if quick else (0.3, 0.4, 0.5, 0.7, 1.0):
            spec = {"kind": "swing", "axis": axis, "amplitude_m": 0.0, "duration_s": duration, "start_s": EVENT_S}
            case = _case(
                "swing",
                f"{word} {duration:.1f} s",
                quick,
                _table(robot, reference=spec),
                "reference.amplitude_m",
                "m",
                ratios.along(axis),
                sign=sign,
            )
            found.append(_with_capture_goal(case))
    return found


def _with_capture_goal(case: Case) -> Case:
    """The goal of a swing: the largest level whose reference keeps its capture point inside the sole."""
    inside = [
        level
        for level in case.levels
        if capture_margin(scenario_from_table(case.table_at(level), robot_files=True), _CAPTURE_STEP_S) >= 0.0
    ]
    return Case(**{**case.__dict__, "goal": max(inside, default=None)})


def _stones(robot: str, quick: bool) -> list[Case]:
    places, ratio = sole_places(robot, Support.LEFT), proportions_of(robot).sole_width
    height, knob = scaled(_HEIGHT_M, ratio), "stones.0.height_m"
    chosen = ("toe", "outer", "toe-outer", "inner") if quick else tuple(places)
    return [
        _case(
            "stone",
            name,
            quick,
            _table(robot, stones=_rising(robot, places[name], height)),
            knob,
            "m",
            ratio,
            goal=height,
        )
        for name in chosen
    ]


def _landings(robot: str, quick: bool) -> list[Case]:
    places, found, ratios = sole_places(robot, Support.LEFT), [], proportions_of(robot)
    height, drop = scaled(_HEIGHT_M, ratios.sole_width), scaled(DROP_HEIGHT_M, ratios.leg)
    for name in ("toe", "outer") if quick else tuple(places):
        x, y = places[name]
        stone = {"x_m": x, "y_m": y, "height_m": height, "size_m": stone_size(robot), "lying": True}
        table = _table(robot, drop_height_m=drop, stones=[stone])
        found.append(_case("landing", name, quick, table, "stones.0.height_m", "m", ratios.sole_width, goal=height))
    return found


def _pushes(robot: str, quick: bool) -> list[Case]:
    return [
        _case("push", WORDS[d], quick, _table(robot, pushes=_push(d)), "pushes.0.impulse_ns", "J/J_cap", goal=_ETA_GOAL)
        for d in EIGHT
    ]


def _pushes_on_two_feet(robot: str, quick: bool) -> list[Case]:
    knob, both = "pushes.0.impulse_ns", Support.DOUBLE
    return [
        _case("push-double", WORDS[d], quick, _table(robot, both, pushes=_push(d)), knob, "J/J_cap", goal=_ETA_GOAL)
        for d in (TWO if quick else EIGHT)
    ]


def _trunk_pushes(robot: str, quick: bool) -> list[Case]:
    knob, link, ratios = "pushes.0.impulse_ns", robot_named(robot).trunk, proportions_of(robot)
    return [
        _case("trunk", WORDS[d], quick, _table(robot, pushes=_push(d, link)), knob, "N s", ratios.impulse(d))
        for d in (TWO if quick else EIGHT)
    ]


def _stone_and_push(robot: str, quick: bool) -> list[Case]:
    places, found, ratios = sole_places(robot, Support.LEFT), [], proportions_of(robot)
    height, knob = scaled(_STONE_BEFORE_PUSH_M, ratios.sole_width), "pushes.0.impulse_ns"
    for place in ("outer",) if quick else ("outer", "toe-outer", "toe"):
        for d in TWO if quick else EIGHT:
            stones = _rising(robot, places[place], height)
            table = _table(robot, stones=stones, pushes=_push(d, start_s=SECOND_EVENT_S))
            name = f"{1e3 * height:g} mm {place}, {WORDS[d]}"
            found.append(_case("stone-push", name, quick, table, knob, "N s", ratios.impulse(d)))
    return found


def _slopes(robot: str, quick: bool) -> list[Case]:
    return [
        _case(
            "slope", f"rises {WORDS[d]}", quick, _table(robot, ground={"direction_deg": d}), "ground.slope_deg", "deg"
        )
        for d in (TWO if quick else EIGHT)
    ]


def _tilts(robot: str, quick: bool) -> list[Case]:
    tilting = {"tilt_start_s": EVENT_S, "tilt_duration_s": 0.5}
    return [
        _case(
            "tilt",
            f"rises {WORDS[d]}",
            quick,
            _table(robot, ground={"direction_deg": d, **tilting}),
            "ground.slope_deg",
            "deg",
        )
        for d in (TWO if quick else EIGHT)
    ]


def _standing(robot: str, quick: bool) -> list[Case]:
    return [
        _case("stand", name, quick, _table(robot, support), "duration_s", "s")
        for name, support in (("two feet", Support.DOUBLE), ("left foot", Support.LEFT))
    ]


FAMILIES: dict[str, Callable[[str, bool], list[Case]]] = {
    "swing": _swings,
    "stone": _stones,
    "landing": _landings,
    "push": _pushes,
    "push-double": _pushes_on_two_feet,
    "trunk": _trunk_pushes,
    "stone-push": _stone_and_push,
    "slope": _slopes,
    "tilt": _tilts,
}
# Nothing happens: what is measured is how well a robot that does not know its state stands. By name only
QUIET_FAMILIES = {"stand": _standing}
