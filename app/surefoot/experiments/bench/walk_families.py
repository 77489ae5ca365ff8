"""The families in which the robot steps: walks over bad ground, a step onto a stone, pushes.

They are asked for by name, or all with ``walk``; the ranking of the standing families does not hold them.
"""

from collections.abc import Callable
from typing import Any

from surefoot.experiments.bench.cells import Case
from surefoot.experiments.bench.ladders import BIP, EIGHT, TWO, WORDS, in_proportion, rungs
from surefoot.experiments.runs.walk_tally import STANDS_S
from surefoot.experiments.scenario.proportions import proportions_of, scaled
from surefoot.experiments.scenario.step_onto_stone import PLACES, scene_table
from surefoot.experiments.scenario.uneven_ground import StonesUnderSteps
from surefoot.gait.walk import FIRST_SHIFT_S, LAST_SHIFT_S
from surefoot.robot.feet import Support

WALK = "walk"  # names all of them

# family -> (quick, full), for Bip
LADDERS = {
    "walk-stones": (rungs(0.005, 0.035, 7), rungs(0.004, 0.032, 15)),
    "walk-tiles": (rungs(0.005, 0.035, 7), rungs(0.0025, 0.0375, 15)),
    "walk-ledge": (rungs(0.01, 0.07, 7), rungs(0.005, 0.075, 15)),
    "walk-flat": (rungs(0.1, 0.4, 7), rungs(0.03, 0.45, 15)),
    "walk-long": (rungs(0.1, 0.4, 7), rungs(0.03, 0.45, 15)),
    "walk-slope": (rungs(1.0, 7.0, 7), rungs(1.0, 15.0, 15)),
    "walk-turn": (rungs(2.0, 20.0, 7), rungs(6.0, 20.0, 15)),
    "walk-starts": (rungs(0.1, 0.4, 7), rungs(0.03, 0.45, 15)),
    "walk-push": (rungs(10.0, 70.0, 7), rungs(4.0, 64.0, 31)),
    "step-push": (rungs(0.3, 1.2, 7), rungs(0.2, 1.4, 31)),
    "step-onto-stone": (rungs(0.006, 0.030, 7), rungs(0.005, 0.030, 26)),
}
MEANING = {
    "walk-stones": "height of a stone under each step of a walk",
    "walk-tiles": "amplitude of tiles of 10 cm walked over",
    "walk-ledge": "height of a ledge that nobody announced",
    "walk-flat": "length of the steps on flat ground",
    "walk-long": "length of each of 50 steps on flat ground",
    "walk-slope": "slope of the ground walked over",
    "walk-turn": "turn in each of 12 steps on the spot",
    "walk-starts": "length of the steps of 20 walks of two steps, standing in between",
    "walk-push": "impulse through the CoM during a walk",
    "step-push": "impulse through the CoM, caught with steps",
    "step-onto-stone": "height of a stone under one step, after which the other foot lifts",
}
# Of these a seed draws the ground: each seed is a trial of its own. Of the others seeds are near copies, unless they
# draw noise and errors of the model
GROUND_BY_SEED = ("walk-stones", "walk-tiles", "walk-ledge")

_START_S = 0.2
# More time than planned: feet that find lower ground land late, and the weight may take up to 0.45 s to shift after a
# step (gait.weight_shift), which in a walk of 0.7 s a step is that share of it
_LATE_SHARE, _LATE_S = 0.45, 1.0
_LEDGE_LIFT_M = 0.09  # higher than the highest ledge: who lifts 0.05 m stumbles over one of 0.06
_CAUGHT_S = 5.0  # in which a push is caught, and the robot comes to rest
_STARTS, _REST_S = 20, 0.5  # walks of two steps, and how long it stands between them
_PUSH_S = (3.0, 0.1)  # when, how long


def walk_table(steps: int, length_m: float, period_s: float, *, robot: str = BIP, **more: Any) -> dict[str, Any]:
    """The scenario file of a walk on flat ground that lasts until its robot has stood long enough at its end.

    Args:
        steps: how many.
        length_m: of each; Bip's, another robot's in proportion.
        period_s: from touch-down to touch-down; Bip's, another robot's in proportion.
        robot: who walks.
        more: further tables.
    """
    ratios = proportions_of(robot)
    length_m, period_s = scaled(length_m, ratios.leg), _period(robot, period_s)
    walk = {"kind": "walk", "steps": steps, "step_length_m": length_m, "step_period_s": period_s, "start_s": _START_S}
    return {**_lasting(robot, steps * period_s), "reference": walk, **more}


def _period(robot: str, period_s: float) -> float:
    return round(scaled(period_s, proportions_of(robot).time), 2)


def _lasting(robot: str, steps_s: float) -> dict[str, Any]:
    planned_s = _START_S + FIRST_SHIFT_S + steps_s + LAST_SHIFT_S + STANDS_S
    duration_s = round(planned_s + _LATE_SHARE * steps_s + _LATE_S, 3)
    return {"robot": robot, "support": Support.DOUBLE.value, "duration_s": duration_s}


def _case(
    family: str, name: str, quick: bool, table: dict[str, Any], knob: str, unit: str, ratio: float = 1.0, **more: Any
) -> Case:
    levels = in_proportion(LADDERS[family][0 if quick else 1], ratio)
    return Case(family=family, name=name, table=table, knob=knob, unit=unit, levels=levels, **more)


def _pace(table: dict[str, Any]) -> str:
    """Length and period of the steps, in words."""
    walk = table["reference"]
    return f"{walk['step_length_m']:g} m, {walk['step_period_s']:g} s"


def _stones(robot: str, quick: bool) -> list[Case]:
    ratios = proportions_of(robot)
    size = {} if robot == BIP else {"size_m": scaled(StonesUnderSteps.size_m, ratios.sole_width)}
    table = walk_table(
        20 if quick else 50, 0.15, 0.7, robot=robot, stones_under_steps={"height_m": 0.0, "seed": 0, **size}
    )
    return [_case("walk-stones", _pace(table), quick, table, "stones_under_steps.height_m", "m", ratios.leg)]


def _tiles(robot: str, quick: bool) -> list[Case]:
    ratios = proportions_of(robot)
    tiles = {"size_m": scaled(0.1, ratios.sole_length), "amplitude_m": 0.001, "seed": 0}
    table = walk_table(30, 0.2, 0.8, robot=robot, ground={"tiles": tiles})
    return [_case("walk-tiles", _pace(table), quick, table, "ground.tiles.amplitude_m", "m", ratios.leg)]


def _ledges(robot: str, quick: bool) -> list[Case]:
    leg = proportions_of(robot).leg
    table = walk_table(8, 0.2, 0.8, robot=robot, ledges=[{"x_m": scaled(0.7, leg), "height_m": 0.0}])
    table["reference"]["lift_m"] = scaled(_LEDGE_LIFT_M, leg)
    return [
        _case("walk-ledge", word, quick, table, "ledges.0.height_m", "m", leg, sign=sign)
        for word, sign in (("up", 1.0), ("down", -1.0))
    ]


def _flat(robot: str, quick: bool) -> list[Case]:
    leg, knob, found = proportions_of(robot).leg, "reference.step_length_m", []
    for period in (0.5, 0.6, 0.8, 1.0, 1.2):
        table = walk_table(10, 0.1, period, robot=robot)
        found.append(_case("walk-flat", f"{_period(robot, period)} s", quick, table, knob, "m", leg))
    return found


def _long(robot: str, quick: bool) -> list[Case]:
    table, leg = walk_table(50, 0.1, 0.8, robot=robot), proportions_of(robot).leg
    return [_case("walk-long", f"{_period(robot, 0.8)} s", quick, table, "reference.step_length_m", "m", leg)]


def _slopes(robot: str, quick: bool) -> list[Case]:
    return [
        _case(
            "walk-slope",
            word,
            quick,
            walk_table(10, 0.2, 0.8, robot=robot, ground={"direction_deg": direction}),
            "ground.slope_deg",
            "deg",
        )
        for word, direction in (("up", 0.0), ("down", 180.0), ("across, the left higher", 90.0))
    ]


def _turns(robot: str, quick: bool) -> list[Case]:
    table = walk_table(12, 0.0, 0.8, robot=robot)
    return [
        _case("walk-turn", word, quick, table, "reference.turn_deg_per_step", "deg", sign=sign)
        for word, sign in (("left", 1.0), ("right", -1.0))
    ]


def _starts(robot: str, quick: bool) -> list[Case]:
    once, period, leg = walk_table(2, 0.1, 0.8, robot=robot), _period(robot, 0.8), proportions_of(robot).leg
    table = {
        **once,
        **_lasting(robot, _STARTS * 2 * period + (_STARTS - 1) * (FIRST_SHIFT_S + LAST_SHIFT_S + _REST_S)),
        "reference": {**once["reference"], "walks": _STARTS, "rest_s": _REST_S},
    }
    return [_case("walk-starts", f"{_STARTS} walks, {period} s", quick, table, "reference.step_length_m", "m", leg)]


def _pushes(robot: str, quick: bool) -> list[Case]:
    (start_s, duration_s), ratios = _PUSH_S, proportions_of(robot)
    push = {"link": "com", "impulse_ns": 0.0, "start_s": scaled(start_s, ratios.time), "duration_s": duration_s}
    return [
        _case(
            "walk-push",
            WORDS[direction],
            quick,
            walk_table(10, 0.24, 0.6, robot=robot, pushes=[{**push, "direction_deg": direction}]),
            "pushes.0.impulse_ns",
            "N s",
            ratios.impulse(direction),
        )
        for direction in (TWO if quick else EIGHT)
    ]


def _pushes_to_step(robot: str, quick: bool) -> list[Case]:
    push = {"link": "com", "impulse_ns": 0.0, "start_s": 0.5, "duration_s": _PUSH_S[1]}
    return [
        _case(
            "step-push",
            f"{feet}, {WORDS[direction]}",
            quick,
            {
                "robot": robot,
                "support": support.value,
                "duration_s": _CAUGHT_S,
                "reference": {"kind": "hold", "step_when_needed": True},
                "pushes": [{**push, "direction_deg": direction}],
            },
            "pushes.0.impulse_ns",
            "J/J_cap1",
        )
        for feet, support in (("two feet", Support.DOUBLE), ("one foot", Support.LEFT))
        for direction in (TWO if quick else EIGHT)
    ]


def _onto_stones(robot: str, quick: bool) -> list[Case]:
    ratio, knob = proportions_of(robot).sole_width, "stones.0.height_m"
    return [
        _case("step-onto-stone", place, quick, scene_table(place, scaled(0.01, ratio), robot), knob, "m", ratio)
        for place in PLACES
    ]


WALK_FAMILIES: dict[str, Callable[[str, bool], list[Case]]] = {
    "walk-stones": _stones,
    "walk-tiles": _tiles,
    "walk-ledge": _ledges,
    "walk-flat": _flat,
    "walk-long": _long,
    "walk-slope": _slopes,
    "walk-turn": _turns,
    "walk-starts": _starts,
    "walk-push": _pushes,
    "step-push": _pushes_to_step,
    "step-onto-stone": _onto_stones,
}
