"""The figures of the report: file, title, caption and what a reader who cannot see them should know."""

from collections.abc import Callable
from dataclasses import dataclass

from surefoot.experiments.paper.claims import outcome
from surefoot.experiments.paper.findings import Findings, com_margin
from surefoot.experiments.paper.plan import LATCHED, STEPPERS, SWING, SWING_HARDER, TOLD
from surefoot.experiments.paper.steps import COMPLETED, completed, ending, lifts_after_s, stones, time_at_stop_s
from surefoot.experiments.runs.cases import CaseResult
from surefoot.experiments.scenario.step_onto_stone import NO_STONE


@dataclass(frozen=True)
class FigureText:
    """One figure of the report.

    Attributes:
        name: file name without suffix.
        title: as the heading.
        caption: written from the runs.
    """

    name: str
    title: str
    caption: Callable[[Findings], str]


def _figure_1(f: Findings) -> str:
    a, b = f.static_case
    end = f"falls at {a.fall_time_s:.2f} s" if a.fall_time_s else "stands"
    other = f"falls at {b.fall_time_s:.2f} s" if b.fall_time_s else "stands"
    return (
        f"A 10 mm stone rises under the outer edge of the left foot. (a) `{a.case.row}` {end}; (b) `{b.case.row}` "
        f"{other}. Left: the robot from behind; dashed: where its centre of mass G projects. Middle: the stance foot, "
        "heights drawn twice as large. Right: the sole from above. Grey: before the stone, blue: the last tick. The "
        "sole rolls over the stone in both; only where G ends up differs."
    )


def _figure_5(f: Findings) -> str:
    runs = f.run(SWING, "two-part"), f.run(SWING, "optimization"), f.run(SWING, "optimization", LATCHED)
    margin = runs[0].summary["zmp_margin_min_m"]
    return (
        "Measured ZMP over the left sole, origin at P; a circle marks the start, a square the end, a cross a fall. "
        f"(a) `two-part` {outcome(runs[0])}, its least margin is {1e3 * margin:.1f} mm. (b) `optimization` "
        f"{outcome(runs[1])} when it tries again at every tick, and {outcome(runs[2])} latched: then the ZMP runs "
        "along the edge over which the foot tips. Dotted: the ZMP that the reference's own motion needs, delta_P "
        "included; it leaves the sole on both sides. The swing is calibrated so that this first happens at 0.92 s."
    )


def _figure_6(f: Findings) -> str:
    two_part, latched = f.run(SWING, "two-part"), f.run(SWING, "optimization", LATCHED)
    inside, outside = (1e3 * com_margin(run, f.sole, f.place) for run in (two_part, latched))
    return (
        f"Centre of mass G on the same swing. With the technique it stays {inside:.0f} mm or more inside the sole, "
        "is held back while the ZMP is limited, and arrives late; latched, the baseline's G ends "
        f"{-outside:.0f} mm outside. In (a) the lines lie on each other and are drawn with different widths."
    )


def _figure_7(f: Findings) -> str:
    return (
        "G and ZMP with the technique (`two-part`). The ZMP first goes outward to start the swing, is held inside the "
        "sole by margin and guard (flat parts), goes inward to brake, and comes to rest under G."
    )


def _figure_8(f: Findings) -> str:
    since = f.run(SWING, "optimization", LATCHED).summary["qp_infeasible_first_s"]
    when = f"from {since:.2f} s on (calibrated)" if since else "(it never is)"
    return (
        f"Torques of the left ankle. The baseline's are constant while its QP is infeasible, {when}: for ever if it "
        "latches, as the paper's figure shows, or until there are contact forces again. The technique provides "
        "torques throughout. Signs are those of our joints: sagittal positive presses the toes down, frontal positive "
        "lifts the outer edge."
    )


def _figure_9(f: Findings) -> str:
    return (
        "Total rate of angular momentum about P below the left ankle with the technique, signs by the paper's axes. "
        "Commanded (what the law computes) and measured (from the contact forces) agree but for a few ticks after a "
        "kink; both return to the reference value 0. Dotted: what the reference's own motion needs; the difference is "
        "what limits and feedback change. The sagittal part is small because the swing is lateral."
    )


def _second(f: Findings) -> str:
    runs = [f.run(SWING_HARDER, "two-part"), f.run(SWING_HARDER, "optimization")]
    return (
        f"The second calibrated swing, 45 mm in 0.6 s. (a) ZMP, (b) G (dotted: wanted). Here the baseline that tries "
        f"again {outcome(runs[1])} too, and `two-part` {outcome(runs[0])}."
    )


def _prediction(f: Findings) -> str:
    return (
        "Margin of the reference's own ZMP to the edge of the sole (blue), where it crosses 0 (circle), and the first "
        "tick at which the hard QP has no solution in the simulation (dashed). Grey: the same margin for a point mass, "
        "that is without the rate of angular momentum about G: it crosses later, or much later."
    )


def _sweep(f: Findings) -> str:
    return (
        "How each run ended, for every controller and for gains of the centre of mass from soft (k: K_P = k omega^2, "
        "K_D = (1 + k) omega) to stiff; the other gains stay at 60/14. Numbers: largest CoM error of a run that "
        "stands, time of a fall."
    )


def _steps(f: Findings) -> str:
    flat = sum(ending(f.step(NO_STONE, 0.0, contender)) == COMPLETED for contender in STEPPERS)
    counts = ", ".join(f"`{who[0]}` {len(completed(f, who, f.plan.places))}" for who in STEPPERS)
    return (
        f"Who completes the walk when its first step lands on a stone; of {stones(f)} stones: {counts}. Words: what "
        f"began the fall. Without a stone {flat} of {len(STEPPERS)} complete the same walk."
    )


def _step_end(result: CaseResult) -> str:
    return f"falls ({ending(result).replace('_', ' ')})" if result.fell else ending(result)


def _step_in_time(f: Findings) -> str:
    place, height_m = TOLD
    told = {who[0]: f.step(place, height_m, who) for who in STEPPERS}
    ends = ", ".join(f"`{name}` {_step_end(result)}" for name, result in told.items())
    stops = ", ".join(f"{time_at_stop_s(result):.2f}" for result in told.values())
    lifts = ", ".join("never" if s is None else f"{s:.2f}" for s in map(lifts_after_s, told.values()))
    return (
        f"The step onto a stone of {1e3 * height_m:g} mm below the {place} edge: {ends}. Top: roll angle of the ankle "
        f"that has landed, positive with the outer edge up; it is at its stop (grey) for {stops} s. Below: measured "
        "ZMP and centre of mass G (dotted: wanted), outward from P of the foot as it was to land; the band is its "
        f"sole. Blue: the time on the stone alone, which begins {lifts} s after the first touch. Dashed: the fall."
    )


FIGURES = (
    FigureText("figure_1", "Figure 1: the static case", _figure_1),
    FigureText("figure_5", "Figure 5: ZMP of both controllers", _figure_5),
    FigureText("figure_6", "Figure 6: centre of mass with and without the technique", _figure_6),
    FigureText("figure_7", "Figure 7: centre of mass and ZMP", _figure_7),
    FigureText("figure_8", "Figure 8: ankle torques of both controllers", _figure_8),
    FigureText("figure_9", "Figure 9: delta_P, commanded and measured", _figure_9),
    FigureText("second_swing", "The second swing", _second),
    FigureText("step_onto_stone", "A step onto a stone", _steps),
    FigureText("step_in_time", "The same step in time", _step_in_time),
    FigureText("prediction", "Prediction of infeasibility", _prediction),
    FigureText("gain_sweep", "Gain sweep", _sweep),
)
