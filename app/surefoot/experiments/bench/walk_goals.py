"""The figures that walks and steps are to reach: what is played for each, in which order, and its bar."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from surefoot.experiments.bench.cells import Case
from surefoot.experiments.bench.ladders import BIP
from surefoot.experiments.bench.walk_families import WALK_FAMILIES, walk_table


@dataclass(frozen=True, kw_only=True)
class Goal:
    """One figure.

    Attributes:
        what: is to be survived.
        bar: which share of the runs is to survive it.
        cases: what is played, each at one level.
        most_seeds: more are not played, because they are near copies of one another, or tell nothing new; None: all.
    """

    what: str
    bar: float
    cases: tuple[Case, ...]
    most_seeds: int | None = None


_FEWER = 20  # where the bar is far from every result, this many tell
# Controllers to compare with; a cell of 50 steps takes half a minute.
_MOST_SEEDS_OF = {"soft-qp": 14, "optimization": 8, "two-part-literal": 8}


def walk_goals() -> list[Goal]:
    """All of them, the most important first."""
    return [
        _stones(0.02, 0.95),
        _tiles(0.03, 0.90),
        _stones(0.03, 0.70, most_seeds=_FEWER),
        *_ledges(0.06, 0.80),
        *_slopes(5.0),
        _turns(10.0),
        _starts(0.2),
        _flat(200, 0.2, 0.8),
        _flat(50, 0.4, 0.6),
        _pushes("two feet", 0.85, forward=0.83),
        _pushes("one foot", 0.85),
    ]


def in_order(seeds: Sequence[int], controllers: Mapping[str, str]) -> Iterator[tuple[Case, str, int]]:
    """Case, label of a controller and seed of all that is played.

    Seed by seed over all goals, so that all have as many where it is ended.

    Args:
        seeds: to be played.
        controllers: label -> name in the registry; those that are there for comparison play fewer seeds.
    """
    for i, seed in enumerate(seeds):
        for goal in walk_goals():
            if goal.most_seeds is None or i < goal.most_seeds:
                playing = [label for label, name in controllers.items() if i < _MOST_SEEDS_OF.get(name, len(seeds))]
                yield from ((case, label, seed) for case in goal.cases for label in playing)


def goals_as_data() -> list[dict[str, Any]]:
    """For the manifest: what the table is made from, beside the shares."""
    return [
        {"what": goal.what, "bar": goal.bar, "cases": [[case.family, case.name] for case in goal.cases]}
        for goal in walk_goals()
    ]


def _made(family: str, level: float, name: str, which: str | None = None) -> Case:
    """A case of a family at one level, under a name of its own: the levels of other goals are other cases."""
    found = next(case for case in WALK_FAMILIES[family](BIP, False) if which in (None, case.name))
    return replace(found, name=name, levels=(level,))


def _stones(height_m: float, bar: float, most_seeds: int | None = None) -> Goal:
    what = f"a stone of {1e3 * height_m:.0f} mm under each of 50 steps (0.15 m, 0.7 s)"
    case = _made("walk-stones", height_m, f"{1e3 * height_m:.0f} mm, 50 steps")
    return Goal(what=what, bar=bar, cases=(case,), most_seeds=most_seeds)


def _tiles(amplitude_m: float, bar: float) -> Goal:
    name = f"{1e3 * amplitude_m:.0f} mm, 30 steps"
    what = f"tiles of 10 cm, +-{1e3 * amplitude_m:.0f} mm, 30 steps (0.2 m, 0.8 s)"
    return Goal(what=what, bar=bar, cases=(_made("walk-tiles", amplitude_m, name),))


def _ledges(height_m: float, bar: float) -> list[Goal]:
    return [
        Goal(
            what=f"an unannounced ledge of {1e3 * height_m:.0f} mm {word} in 8 steps (0.2 m, 0.8 s)",
            bar=bar,
            cases=(_made("walk-ledge", height_m, f"{1e3 * height_m:.0f} mm {word}", word),),
            most_seeds=_FEWER,
        )
        for word in ("up", "down")
    ]


def _slopes(slope_deg: float) -> list[Goal]:
    return [
        Goal(
            what=f"a slope of {slope_deg:g} degrees {case.name}, 10 steps (0.2 m, 0.8 s)",
            bar=1.0,
            cases=(replace(case, name=f"{slope_deg:g} deg {case.name}", levels=(slope_deg,)),),
            most_seeds=10,
        )
        for case in WALK_FAMILIES["walk-slope"](BIP, False)
    ]


def _turns(turn_deg: float) -> Goal:
    cases = tuple(
        replace(case, name=f"{turn_deg:g} deg {case.name}", levels=(turn_deg,))
        for case in WALK_FAMILIES["walk-turn"](BIP, False)
    )
    what = f"12 turns of {turn_deg:g} degrees on the spot, to the left and to the right"
    return Goal(what=what, bar=1.0, cases=cases, most_seeds=1)


def _starts(length_m: float) -> Goal:
    what = f"20 starts and stops: walks of two steps of {length_m:g} m"
    return Goal(what=what, bar=1.0, cases=(_made("walk-starts", length_m, "20 walks"),), most_seeds=1)


def _flat(steps: int, length_m: float, period_s: float) -> Goal:
    what = f"{steps} steps of {length_m:g} m at {period_s:g} s on flat ground"
    case = Case(
        family="walk-flat",
        name=f"{steps} steps, {period_s:g} s",
        table=walk_table(steps, length_m, period_s),
        knob="reference.step_length_m",
        levels=(length_m,),
        unit="m",
    )
    return Goal(what=what, bar=1.0, cases=(case,), most_seeds=1)


def _pushes(feet: str, level: float, *, forward: float | None = None) -> Goal:
    """In all directions from two feet or one; ``forward``: another level in that direction."""
    cases = [case for case in WALK_FAMILIES["step-push"](BIP, False) if case.name.startswith(f"{feet}, ")]
    at = {f"{feet}, forward": forward or level}
    but = f" (forward {forward:g})" if forward else ""
    return Goal(
        what=f"a push of {level:g} J_cap1{but} caught with steps from {feet}, {len(cases)} directions",
        bar=1.0,
        cases=tuple(replace(case, name=f"{case.name}, goal", levels=(at.get(case.name, level),)) for case in cases),
        most_seeds=1,
    )
