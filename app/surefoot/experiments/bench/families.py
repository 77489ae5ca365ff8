"""The families of disturbances that a robot stands: every case is a scenario file with one value that grows.

All episodes last 3.5 s: what happens begins at 0.3 s, which leaves about two seconds (after a stone and a push 1.2 s)
to come to rest before the last second is judged.
"""

from collections.abc import Callable, Sequence
from typing import Any

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.bounds import capture_margin
from surefoot.experiments.bench.cells import Case
from surefoot.experiments.bench.ladders import EIGHT, TWO, WORDS, rungs
from surefoot.experiments.bench.walk_families import WALK, WALK_FAMILIES
from surefoot.experiments.scenario.scenario import scenario_from_table
from surefoot.experiments.scenario.sole_places import sole_places
from surefoot.robot.feet import Support

# family -> (quick, full)
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
}


DURATION_S = 3.5
EVENT_S = 0.3
SECOND_EVENT_S = 1.2
PUSH_DURATION_S = 0.1
DROP_HEIGHT_M = 0.03
_STONE_M = [0.06, 0.06]
_STONE_GOAL_M = 0.010
_ETA_GOAL = 0.95
_CAPTURE_STEP_S = 0.005


def cases(names: Sequence[str] = (), *, quick: bool = False) -> list[Case]:
    """The cases of some families: by default of all that stand; ``walk`` is all that step.

    Raises:
        InvalidInput: an unknown name.
    """
    known = {**FAMILIES, **WALK_FAMILIES}
    for name in names:
        if name != WALK and name not in known:
            raise InvalidInput("--families", name, "no such family", [*FAMILIES, WALK, *WALK_FAMILIES])
    wanted = {*(names or FAMILIES), *(WALK_FAMILIES if WALK in names else ())}
    return [case for name, make in known.items() if name in wanted for case in make(quick)]


def _table(support: Support = Support.LEFT, **more: Any) -> dict[str, Any]:
    return {"robot": "bip", "support": support.value, "duration_s": DURATION_S, **more}


def _case(family: str, name: str, quick: bool, table: dict[str, Any], knob: str, unit: str, **more: Any) -> Case:
    return Case(
        family=family, name=name, table=table, knob=knob, unit=unit, levels=LADDERS[family][0 if quick else 1], **more
    )


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


def _rising(place: tuple[float, float], height_m: float = 0.01) -> list[dict[str, Any]]:
    return [
        {
            "x_m": place[0],
            "y_m": place[1],
            "height_m": height_m,
            "size_m": _STONE_M,
            "rise_start_s": EVENT_S,
            "rise_duration_s": 0.3,
        }
    ]


def _swings(quick: bool) -> list[Case]:
    found = []
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
                _table(reference=spec),
                "reference.amplitude_m",
                "m",
                sign=sign,
            )
            found.append(_with_capture_goal(case))
    return found


def _with_capture_goal(case: Case) -> Case:
    """The goal of a swing: the largest level whose reference keeps its capture point inside the sole."""
    inside = [
        level
        for level in case.levels
        if capture_margin(scenario_from_table(case.table_at(level)), _CAPTURE_STEP_S) >= 0.0
    ]
    return Case(**{**case.__dict__, "goal": max(inside, default=None)})


def _stones(quick: bool) -> list[Case]:
    places = sole_places("bip", Support.LEFT)
    chosen = ("toe", "outer", "toe-outer", "inner") if quick else tuple(places)
    return [
        _case("stone", name, quick, _table(stones=_rising(places[name])), "stones.0.height_m", "m", goal=_STONE_GOAL_M)
        for name in chosen
    ]


def _landings(quick: bool) -> list[Case]:
    places, found = sole_places("bip", Support.LEFT), []
    for name in ("toe", "outer") if quick else tuple(places):
        stone = {"x_m": places[name][0], "y_m": places[name][1], "height_m": 0.01, "size_m": _STONE_M, "lying": True}
        table = _table(drop_height_m=DROP_HEIGHT_M, stones=[stone])
        found.append(_case("landing", name, quick, table, "stones.0.height_m", "m", goal=_STONE_GOAL_M))
    return found


def _pushes(quick: bool) -> list[Case]:
    return [
        _case("push", WORDS[d], quick, _table(pushes=_push(d)), "pushes.0.impulse_ns", "J/J_cap", goal=_ETA_GOAL)
        for d in EIGHT
    ]


def _pushes_on_two_feet(quick: bool) -> list[Case]:
    knob, both = "pushes.0.impulse_ns", Support.DOUBLE
    return [
        _case("push-double", WORDS[d], quick, _table(both, pushes=_push(d)), knob, "J/J_cap", goal=_ETA_GOAL)
        for d in (TWO if quick else EIGHT)
    ]


def _trunk_pushes(quick: bool) -> list[Case]:
    return [
        _case("trunk", WORDS[d], quick, _table(pushes=_push(d, "trunk")), "pushes.0.impulse_ns", "N s")
        for d in (TWO if quick else EIGHT)
    ]


def _stone_and_push(quick: bool) -> list[Case]:
    places, found = sole_places("bip", Support.LEFT), []
    for place in ("outer",) if quick else ("outer", "toe-outer", "toe"):
        for d in TWO if quick else EIGHT:
            table = _table(stones=_rising(places[place], 0.008), pushes=_push(d, start_s=SECOND_EVENT_S))
            found.append(_case("stone-push", f"8 mm {place}, {WORDS[d]}", quick, table, "pushes.0.impulse_ns", "N s"))
    return found


def _slopes(quick: bool) -> list[Case]:
    return [
        _case("slope", f"rises {WORDS[d]}", quick, _table(ground={"direction_deg": d}), "ground.slope_deg", "deg")
        for d in (TWO if quick else EIGHT)
    ]


def _tilts(quick: bool) -> list[Case]:
    tilting = {"tilt_start_s": EVENT_S, "tilt_duration_s": 0.5}
    return [
        _case(
            "tilt",
            f"rises {WORDS[d]}",
            quick,
            _table(ground={"direction_deg": d, **tilting}),
            "ground.slope_deg",
            "deg",
        )
        for d in (TWO if quick else EIGHT)
    ]


FAMILIES: dict[str, Callable[[bool], list[Case]]] = {
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
