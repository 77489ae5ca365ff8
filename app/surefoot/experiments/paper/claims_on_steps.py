"""What the paper claims of walking: a foot is set on bad ground while the other is about to take off."""

from surefoot.experiments.paper.claims import Check, Claim
from surefoot.experiments.paper.findings import Findings
from surefoot.experiments.paper.plan import STEPPERS, TOLD
from surefoot.experiments.paper.steps import Contender, completed, stones, time_at_stop_s

BASELINE, AS_PRINTED, TWO_PART, SOFT_QP = STEPPERS
_WHO = {
    BASELINE: "the baseline",
    AS_PRINTED: "the law as printed",
    TWO_PART: "two-part",
    SOFT_QP: "a soft QP without the law",
}


def _inevitable(f: Findings) -> list[Check]:
    checks = []
    for contender in (BASELINE, SOFT_QP):
        for place in f.plan.places:
            count, held = len(f.plan.heights_m), len(completed(f, contender, (place,)))
            text = f"stones below {place}: {_WHO[contender]} does not complete {count - held} of {count} walks"
            checks.append(Check(held == 0, text))
    return checks


def _kept(f: Findings) -> list[Check]:
    checks = []
    for contender in (AS_PRINTED, TWO_PART):
        for place in f.plan.places:
            count, held = len(f.plan.heights_m), len(completed(f, contender, (place,)))
            checks.append(Check(held == count, f"stones below {place}: {_WHO[contender]} completes {held} of {count}"))
    return checks


def _more_than(f: Findings, other: Contender) -> list[Check]:
    """Both forms of the law complete the walk on more stones than another controller."""
    others, checks = completed(f, other, f.plan.places), []
    for contender in (AS_PRINTED, TWO_PART):
        ours = completed(f, contender, f.plan.places)
        text = (
            f"{_WHO[contender]} completes {len(ours)} of {stones(f)} walks, {_WHO[other]} {len(others)} "
            f"({len(ours - others)} only with the law, {len(others - ours)} only without)"
        )
        checks.append(Check(len(ours) > len(others), text))
    return checks


def _torques_throughout(f: Findings) -> list[Check]:
    runs = {who: [f.step(place, h, who) for place in f.plan.places for h in f.plan.heights_m] for who in STEPPERS}
    fallen = [run for run in runs[BASELINE] if run.fell]
    without = sum(run.summary["qp_infeasible_ticks"] > 0 for run in fallen)
    holds = bool(fallen) and without == len(fallen)
    checks = [Check(holds, f"in {without} of its {len(fallen)} falls the baseline's QP was without a solution")]
    for contender in (AS_PRINTED, TWO_PART):
        ticks = sum(run.summary["fallback_ticks"] for run in runs[contender])
        kept = sum(run.summary["fallback_ticks"] for run in runs[contender] if not run.fell)
        text = f"{_WHO[contender]}: {ticks} ticks without a solution, {kept} of them in walks that it completes"
        checks.append(Check(ticks == 0, text))
    return checks


def _limits_reached(f: Findings) -> list[Check]:
    place, height_m = TOLD
    checks = []
    for contender in (AS_PRINTED, TWO_PART):
        at_stop_s = time_at_stop_s(f.step(place, height_m, contender))
        text = f"{_WHO[contender]}, {1e3 * height_m:g} mm below {place}: ankle at its roll stop for {at_stop_s:.2f} s"
        checks.append(Check(at_stop_s > 0.0, text))
    return checks


STEP_CLAIMS = (
    Claim(
        "When a foot is set on a stone as the other takes off, ankle torques that do not heed it end in a fall",
        'Introduction: "the fall is inevitable"',
        "A step onto a stone",
        _inevitable,
        universal=True,
    ),
    Claim(
        "With the technique the balance is kept when the ground is irregular during the walking",
        "Before (17), Conclusions",
        "A step onto a stone",
        _kept,
        universal=True,
    ),
    Claim(
        "The technique carries steps onto stones that the optimization does not",
        "Simulations, Conclusions (there a swing, here the walk)",
        "A step onto a stone",
        lambda f: _more_than(f, BASELINE),
    ),
    Claim(
        "It is the law of the ankles that carries them",
        "Abstract, Conclusions: only the ankle torques are changed",
        "A step onto a stone (against a soft QP)",
        lambda f: _more_than(f, SOFT_QP),
    ),
    Claim(
        "The optimization becomes unable to keep the balance, the technique provides torques during the whole motion",
        "Simulations, Figure 8 (there a swing, here the walk)",
        "A step onto a stone",
        _torques_throughout,
    ),
    Claim("Mechanical limits could be attained", "Conclusions", "The same step in time", _limits_reached),
)
