"""Which runs the report is made of, and the gains of its sweep: from soft (like capture-point control) to stiff."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.experiments.runs.cases import Case
from surefoot.experiments.scenario.step_onto_stone import NO_STONE, PLACES, SCENE, stone_changes
from surefoot.momentum.zmp import natural_frequency
from surefoot.task.posture import DEFAULT_COM_HEIGHT

CAPTURE_SHAPES = (0.3, 0.6, 1.0)  # k: K_P = k omega^2, K_D = (1 + k) omega puts one pole at -omega, one at -k omega
STIFF = ((20.0, 9.0), (60.0, 14.0), (100.0, 20.0))  # K_P [1/s2], K_D [1/s]


@dataclass(frozen=True)
class GainSet:
    """One column of the sweep.

    Attributes:
        label: how tables call it.
        stiffness, damping: K_P [1/s2] and K_D [1/s] of the centre of mass.
    """

    label: str
    stiffness: float
    damping: float

    @property
    def changes(self) -> tuple[tuple[str, Any], ...]:
        """What a case has to change."""
        return (("controller.com_stiffness", self.stiffness), ("controller.com_damping", self.damping))


def _capture_shaped(k: float) -> GainSet:
    omega = natural_frequency(DEFAULT_COM_HEIGHT)
    stiffness, damping = round(k * omega**2, 2), round((1.0 + k) * omega, 2)
    return GainSet(f"k = {k:g}: {stiffness:.3g}/{damping:.3g}", stiffness, damping)


GAINS = (
    *(_capture_shaped(k) for k in CAPTURE_SHAPES),
    *(GainSet(f"{stiffness:g}/{damping:g}", stiffness, damping) for stiffness, damping in STIFF),
)


STONE, SWING, SWING_HARDER = "paper_figure1_stone", "paper_swing_35", "paper_swing_45"
BEYOND, DELTA_REFERENCE = "paper_push_beyond", "paper_delta_reference"
COMPARED = (SWING, SWING_HARDER, STONE)
PREDICTED = (
    SWING,
    SWING_HARDER,
    "paper_predict_inward_25",
    "paper_predict_inward_40_slow",
    "paper_predict_inward_50_slow",
    "paper_predict_outward_30",
    "paper_predict_forward_80",
    "paper_predict_backward_60",
)

Changes = tuple[tuple[str, Any], ...]
LATCHED: Changes = (("controller.latched", True),)
OVERRIDE: Changes = (("controller.composition", "override"),)
NO_TANGENTIAL: Changes = (("controller.p_point", "ground"), ("controller.tangential_term", False))
GRAVITY_ONLY: Changes = (("controller.delta_source", "gravity"),)
NO_SPLIT: Changes = (("controller.double_support_split", False),)
JOINT_RANGES: Changes = (("controller.joint_ranges", True),)  # off in walks, where nothing is said

# The paper's baseline both ways, its technique as recommended here and as printed, and a modern baseline
CONTENDERS: tuple[tuple[str, Changes], ...] = (
    ("optimization", LATCHED),
    ("optimization", ()),
    ("two-part", ()),
    ("two-part-literal", ()),
    ("soft-qp", ()),
)

# Who steps onto the stones: the hard baseline, the law as printed, the law in two parts, the soft QP
STEPPERS: tuple[tuple[str, Changes], ...] = (
    ("optimization", ()),
    ("two-part-literal", ()),
    ("two-part", ()),
    ("soft-qp", ()),
)
STEP_VARIANTS: tuple[tuple[str, Changes], ...] = (("optimization", LATCHED), ("two-part", JOINT_RANGES))
VARIED_PLACE = "outer"  # where the variants step
STONE_HEIGHTS_M = (0.005, 0.010, 0.015, 0.020, 0.025, 0.030)
TOLD = ("outer", 0.015)  # the stone of the shipped scenario: with it the four are shown in time


@dataclass(frozen=True)
class Plan:
    """What is run for a report.

    Attributes:
        cases: runs whose ticks are kept and drawn.
        told: steps onto one stone whose ticks are kept and drawn.
        steps: all other steps onto a stone, of which only the summary is kept.
        sweep: runs of the gain sweep, of which only the summary is kept.
        gains: the gain sets of the sweep, in the order of its columns.
        swept: its scenarios.
        places, heights_m: of the stones that are stepped onto.
    """

    cases: tuple[Case, ...]
    told: tuple[Case, ...]
    steps: tuple[Case, ...]
    sweep: tuple[Case, ...]
    gains: tuple[GainSet, ...]
    swept: tuple[str, ...]
    places: tuple[str, ...]
    heights_m: tuple[float, ...]

    @property
    def groups(self) -> tuple[tuple[str, tuple[Case, ...], bool], ...]:
        """Everything that is run, in order: what it is, its runs, whether their ticks are kept."""
        return (
            ("runs", self.cases, True),
            ("steps onto a stone", self.told, True),
            ("steps onto a stone", self.steps, False),
            ("gain sweep", self.sweep, False),
        )

    @property
    def all_cases(self) -> tuple[Case, ...]:
        """Every run, in order."""
        return tuple(case for _, cases, _ in self.groups for case in cases)


def full_plan() -> Plan:
    """Every run of the report."""
    cases = [Case(scenario, name, changes) for scenario in COMPARED for name, changes in CONTENDERS]
    cases += [Case(scenario, "optimization") for scenario in PREDICTED if scenario not in COMPARED]
    cases += [Case(scenario, "two-part", changes) for changes in (OVERRIDE, NO_TANGENTIAL) for scenario in COMPARED]
    cases += [Case(scenario, "two-part", GRAVITY_ONLY) for scenario in (SWING, STONE)]
    cases += [Case("stand_double", "two-part"), Case("stand_double", "two-part-literal", NO_SPLIT)]
    cases += [Case(BEYOND, "two-part"), Case(DELTA_REFERENCE, "two-part")]
    told = tuple(step_case(*TOLD, contender) for contender in STEPPERS)
    steps = [step_case(NO_STONE, 0.0, contender) for contender in STEPPERS]
    steps += _steps(PLACES, STONE_HEIGHTS_M, STEPPERS) + _steps((VARIED_PLACE,), STONE_HEIGHTS_M, STEP_VARIANTS)
    return Plan(
        cases=tuple(cases),
        told=told,
        steps=tuple(case for case in steps if case not in told),
        sweep=_sweep(GAINS, COMPARED),
        gains=GAINS,
        swept=COMPARED,
        places=PLACES,
        heights_m=STONE_HEIGHTS_M,
    )


def shortened(plan: Plan, duration_s: float) -> Plan:
    """A reduced plan for a quick look: shorter runs, softest and stiffest gains only, steps onto one stone only."""
    gains, swept = (plan.gains[0], plan.gains[-1]), plan.swept[:1]

    def cut(cases: Iterable[Case]) -> tuple[Case, ...]:
        return tuple(case.with_changes(("duration_s", duration_s)) for case in cases)

    place, height_m = TOLD
    return replace(
        plan,
        cases=cut(plan.cases),
        told=cut(plan.told),
        steps=cut(step_case(NO_STONE, 0.0, contender) for contender in STEPPERS),
        sweep=cut(_sweep(gains, swept)),
        gains=gains,
        swept=swept,
        places=(place,),
        heights_m=(height_m,),
    )


def step_case(place: str, height_m: float, contender: tuple[str, Changes]) -> Case:
    """One step onto a stone. Raises InvalidInput: no such place."""
    name, changes = contender
    return Case(SCENE, name, (*stone_changes(place, height_m), *changes))


def _steps(places: Iterable[str], heights_m: Iterable[float], contenders: Iterable[tuple[str, Changes]]) -> list[Case]:
    return [step_case(*each) for each in product(places, heights_m, contenders)]


def _sweep(gains: tuple[GainSet, ...], scenarios: tuple[str, ...]) -> tuple[Case, ...]:
    default = ControllerSettings()
    return tuple(
        Case(scenario, name, (*changes, *gain.changes))
        for scenario in scenarios
        for name, changes in CONTENDERS
        for gain in gains
        if (gain.stiffness, gain.damping) != (default.com_stiffness, default.com_damping)
    )
