"""Which runs the report is made of, and the gains of its sweep: from soft (like capture-point control) to stiff."""

from dataclasses import dataclass, replace
from typing import Any

from surefoot.control.settings import ControllerSettings
from surefoot.experiments.runs.cases import Case
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

# The paper's baseline both ways, its technique as recommended here and as printed, and a modern baseline
CONTENDERS: tuple[tuple[str, Changes], ...] = (
    ("optimization", LATCHED),
    ("optimization", ()),
    ("two-part", ()),
    ("two-part-literal", ()),
    ("soft-qp", ()),
)


@dataclass(frozen=True)
class Plan:
    """What is run for a report.

    Attributes:
        cases: runs whose ticks are kept and drawn.
        sweep: runs of the gain sweep, of which only the summary is kept.
        gains: the gain sets of the sweep, in the order of its columns.
        swept: its scenarios.
    """

    cases: tuple[Case, ...]
    sweep: tuple[Case, ...]
    gains: tuple[GainSet, ...]
    swept: tuple[str, ...]


def full_plan() -> Plan:
    """Every run of the report."""
    cases = [Case(scenario, name, changes) for scenario in COMPARED for name, changes in CONTENDERS]
    cases += [Case(scenario, "optimization") for scenario in PREDICTED if scenario not in COMPARED]
    cases += [Case(scenario, "two-part", changes) for changes in (OVERRIDE, NO_TANGENTIAL) for scenario in COMPARED]
    cases += [Case(scenario, "two-part", GRAVITY_ONLY) for scenario in (SWING, STONE)]
    cases += [Case("stand_double", "two-part"), Case("stand_double", "two-part-literal", NO_SPLIT)]
    cases += [Case(BEYOND, "two-part"), Case(DELTA_REFERENCE, "two-part")]
    return Plan(tuple(cases), _sweep(GAINS, COMPARED), GAINS, COMPARED)


def shortened(plan: Plan, duration_s: float) -> Plan:
    """A reduced plan for a quick look: shorter runs, and a sweep of the softest and the stiffest gains only."""
    cut = (("duration_s", duration_s),)
    gains, swept = (plan.gains[0], plan.gains[-1]), plan.swept[:1]
    return replace(
        plan,
        cases=tuple(case.with_changes(*cut) for case in plan.cases),
        sweep=tuple(case.with_changes(*cut) for case in _sweep(gains, swept)),
        gains=gains,
        swept=swept,
    )


def _sweep(gains: tuple[GainSet, ...], scenarios: tuple[str, ...]) -> tuple[Case, ...]:
    default = ControllerSettings()
    return tuple(
        Case(scenario, name, (*changes, *gain.changes))
        for scenario in scenarios
        for name, changes in CONTENDERS
        for gain in gains
        if (gain.stiffness, gain.damping) != (default.com_stiffness, default.com_damping)
    )
