"""What is played for a price list: few cases of the bench's families, and the figure that each family gives."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from surefoot.errors import InvalidInput
from surefoot.experiments.bench.cells import Case
from surefoot.experiments.bench.families import FAMILIES
from surefoot.experiments.bench.ladders import BIP, rungs
from surefoot.experiments.bench.walk_families import WALK_FAMILIES, walk_table

STEPS = "steps"  # the unit of a figure that counts the steps made, at one level; others are the largest level survived


@dataclass(frozen=True, kw_only=True)
class Figure:
    """One family of a price list.

    Attributes:
        family: of the bench.
        what: is measured.
        unit: of the figure: that of the levels, or steps.
        names: of the cases that are played; quick: the first two.
        levels: quick and full; of walks the one that is walked at.
    """

    family: str
    what: str
    unit: str
    names: tuple[str, ...]
    levels: tuple[tuple[float, ...], tuple[float, ...]]

    def cases(self, *, quick: bool) -> list[Case]:
        """What is played."""
        if self.family == _FLAT:
            (length,) = self.levels[0]
            table, knob = walk_table(20, length, 0.8), "reference.step_length_m"
            return [Case(family=_FLAT, name=self.names[0], table=table, knob=knob, levels=(length,), unit="m")]
        made = {**FAMILIES, **WALK_FAMILIES}[self.family](BIP, self.unit == STEPS and quick)
        known = {case.name: case for case in made}
        chosen = self.names[:2] if quick else self.names
        # No goal: these are not the bench's own figures
        return [replace(known[name], levels=self.levels[0 if quick else 1], goal=None) for name in chosen]


_FLAT = "walk-flat"
# From near 0, so that a loss is known however large it is, and finest where most is left; 15 and 31 levels are bisected
# in 4 and 5 episodes
_PUSHES = (
    (0.1, 0.25, 0.4, 0.5, 0.6, *rungs(0.68, 1.0, 9), 1.1),
    (0.1, 0.2, 0.3, 0.4, 0.48, 0.56, *rungs(0.62, 1.06, 23), 1.1, 1.2),
)
_STONES = (rungs(0.002, 0.030, 15), rungs(0.001, 0.031, 31))
_DIRECTIONS = ("forward", "left", "backward", "right")
FIGURES = {
    figure.family: figure
    for figure in (
        Figure(
            family="push-double",
            what="push survived from two feet",
            unit="J/J_cap",
            names=_DIRECTIONS[:3],  # from two feet right is left
            levels=_PUSHES,
        ),
        Figure(family="push", what="push survived from one foot", unit="J/J_cap", names=_DIRECTIONS, levels=_PUSHES),
        Figure(
            family="stone",
            what="stone survived under the stance foot",
            unit="m",
            names=("outer", "toe", "toe-outer", "inner"),
            levels=_STONES,
        ),
        Figure(
            family=_FLAT,
            what="steps made of 20 on flat ground (0.2 m, 0.8 s)",
            unit=STEPS,
            names=("20 steps, 0.8 s",),
            levels=((0.2,), (0.2,)),
        ),
        Figure(
            family="walk-stones",
            what="steps made over stones of 20 mm (0.15 m, 0.7 s; 50 steps, quick: 20)",
            unit=STEPS,
            names=("0.15 m, 0.7 s",),
            levels=((0.02,), (0.02,)),
        ),
    )
}
BY_DEFAULT = ("push-double", "push", "stone")


def figures_named(names: Sequence[str]) -> list[Figure]:
    """Those of some families, in the order of the list; those that stand for none. Raises InvalidInput."""
    for name in names:
        if name not in FIGURES:
            raise InvalidInput("--families", name, "has no figure in a price list", FIGURES)
    return [FIGURES[name] for name in FIGURES if name in (names or BY_DEFAULT)]
