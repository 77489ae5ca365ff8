"""What the paper claims of balance: Figures 1 and 5 to 8, and its summary."""

from surefoot.experiments.paper.claims import Check, Claim, falls, outcome, stands, zmp_inside
from surefoot.experiments.paper.findings import Findings, com_margin, torque_spread_after
from surefoot.experiments.paper.plan import BEYOND, CONTENDERS, LATCHED, STONE, SWING, SWING_HARDER
from surefoot.experiments.runs.cases import Case

PAPER_INFEASIBLE_S = 0.92
_SAME_TIME_S = 0.01
_CONSTANT_NM = 1e-9
_HARDER = "on the 45 mm swing"


def _stone_without(f: Findings) -> list[Check]:
    return [
        falls("the baseline, latched,", f.run(STONE, "optimization", LATCHED)),
        falls("the baseline, unlatched,", f.run(STONE, "optimization")),
    ]


def _inevitable(f: Findings) -> list[Check]:
    checks = [*_stone_without(f), falls("a soft QP, which knows nothing of the stone either,", f.run(STONE, "soft-qp"))]
    for column, gain in enumerate(f.plan.gains):
        result = f.gain_run(STONE, ("optimization", ()), column) if STONE in f.plan.swept else None
        if result is not None and not result.fell:
            checks.append(Check(False, f"the baseline with CoM gains {gain.label} stands"))
    return checks


def _stone_with(f: Findings) -> list[Check]:
    two_part = f.run(STONE, "two-part")
    margin = com_margin(two_part, f.sole, f.place)
    return [
        stands("two-part", two_part),
        stands("the law as printed", f.run(STONE, "two-part-literal")),
        Check(margin > 0.0, f"two-part: G's projection keeps {1e3 * margin:.1f} mm or more from the sole's edge"),
    ]


def _zmp_kept(f: Findings) -> list[Check]:
    checks = []
    for scenario, who in ((SWING, "two-part"), (SWING_HARDER, f"two-part {_HARDER}")):
        asked = float(f.predictions[scenario].margin.min())
        checks.append(Check(asked < 0.0, f"the reference's own ZMP leaves the sole by {-1e3 * asked:.1f} mm"))
        checks.append(zmp_inside(who, f.run(scenario, "two-part")))
    return checks


def _zmp_kept_unlimited(f: Findings) -> list[Check]:
    literal, harder = f.run(SWING, "two-part-literal"), f.run(SWING_HARDER, "two-part-literal")
    return [zmp_inside("as printed", literal), zmp_inside(f"as printed {_HARDER}", harder)]


def _baseline_falls(f: Findings) -> list[Check]:
    return [
        falls("latched, it", f.run(SWING, "optimization", LATCHED)),
        falls("unlatched, it", f.run(SWING, "optimization")),
        falls(f"{_HARDER}, latched, it", f.run(SWING_HARDER, "optimization", LATCHED)),
        falls(f"{_HARDER}, unlatched, it", f.run(SWING_HARDER, "optimization")),
    ]


def _com_displaced(f: Findings) -> list[Check]:
    two_part, latched = f.run(SWING, "two-part"), f.run(SWING, "optimization", LATCHED)
    inside, outside = (com_margin(result, f.sole, f.place) for result in (two_part, latched))
    away, wanted = (f.place[1] - two_part.column(name) for name in ("com_y_m", "com_ref_y_m"))
    held, beyond = 1e3 * float((wanted - away).max()), 1e3 * float(away.max() - wanted.max())
    return [
        Check(inside > 0.0, f"two-part keeps G {1e3 * inside:.1f} mm or more inside the sole"),
        Check(outside < 0.0, f"the latched baseline's G comes within {1e3 * outside:+.1f} mm of the edge (- outside)"),
        Check(held > 1.0, f"during the swing two-part holds G up to {held:.1f} mm nearer to the foot than wanted"),
        Check(beyond < 0.0, f"its furthest point lies {beyond:+.2f} mm beyond the reference's"),
    ]


def _torques_constant(f: Findings) -> list[Check]:
    checks = []
    for who, changes in (("latched", LATCHED), ("trying again each tick", ())):
        run = f.run(SWING, "optimization", changes)
        since = run.summary["qp_infeasible_first_s"]
        if since is None:
            checks.append(Check(False, f"{who}: the QP is never infeasible"))
            continue
        spread = torque_spread_after(run, since)
        text = f"{who}: from {since:.3f} s on Gamma_5 and Gamma_6 change by {spread:.3g} N m"
        checks.append(Check(spread < _CONSTANT_NM, text))
    return checks


def _constant_since(f: Findings) -> list[Check]:
    since = f.run(SWING, "optimization", LATCHED).summary["qp_infeasible_first_s"]
    near = since is not None and abs(since - PAPER_INFEASIBLE_S) < _SAME_TIME_S
    return [Check(near, "the QP is never infeasible" if since is None else f"first infeasible tick at {since:.3f} s")]


def _balance_lost_then(f: Findings) -> list[Check]:
    return [
        falls("the same baseline, allowed to try again each tick,", f.run(SWING, "optimization")),
        falls("a soft QP on the same swing", f.run(SWING, "soft-qp")),
        falls("two-part on the same swing", f.run(SWING, "two-part")),
    ]


def _torques_throughout(f: Findings) -> list[Check]:
    checks = []
    for scenario in (SWING, SWING_HARDER, STONE):
        summary = f.run(scenario, "two-part").summary
        failed = summary["qp_infeasible_ticks"] + summary["fallback_ticks"]
        checks.append(Check(failed == 0, f"{scenario}: {failed} ticks without a solution"))
    return checks


def _assured(f: Findings) -> list[Check]:
    runs = [f.run(scenario, "two-part") for scenario in (SWING, SWING_HARDER, STONE)]
    swept = [
        f.gain_run(scenario, CONTENDERS[2], column) for scenario in f.plan.swept for column in range(len(f.plan.gains))
    ]
    fallen = sum(result.fell for result in swept)
    beyond = f.run(BEYOND, "two-part")
    return [
        Check(not any(result.fell for result in runs), "two-part stands on the swings and on the stone"),
        Check(fallen == 0, f"with other gains two-part falls in {fallen} of {len(swept)} runs"),
        stands("the law as printed on the 35 mm swing", f.run(SWING, "two-part-literal")),
        Check(
            not beyond.fell,
            f"a push beyond the capture impulse (`{Case(BEYOND, 'two-part').command}`) "
            f"{'is survived' if not beyond.fell else outcome(beyond).replace('falls', 'ends in a fall')}",
        ),
    ]


BALANCE_CLAIMS = (
    Claim(
        "A stone under the foot makes the robot lose its balance when the ankle torques do not heed it",
        "Introduction, Figure 1(a)",
        "Figure 1",
        _stone_without,
    ),
    Claim(
        "Without the technique that fall is inevitable",
        "Introduction",
        "Figure 1, gain sweep",
        _inevitable,
        universal=True,
    ),
    Claim(
        "With other ankle torques balance is kept, G projecting into the hull of the contacts",
        "Introduction, Figure 1(b)",
        "Figure 1",
        _stone_with,
    ),
    Claim(
        "With the technique the ZMP stays inside the sole although the trajectory's own ZMP leaves it",
        "Simulations, Figure 5(a)",
        "Figure 5 (two-part: with limits)",
        _zmp_kept,
    ),
    Claim(
        "The unlimited law (28) keeps the ZMP inside the sole",
        "Simulations, Figure 5(a); no limit is printed",
        "Results (two-part-literal)",
        _zmp_kept_unlimited,
    ),
    Claim("Under optimization the robot falls", "Simulations, Figure 5(b)", "Figure 5", _baseline_falls),
    Claim("The technique displaces G into the support area", "Simulations, Figure 6", "Figure 6", _com_displaced),
    Claim(
        "Under optimization the ankle torques become constant", "Simulations, Figure 8", "Figure 8", _torques_constant
    ),
    Claim(
        "They do so from about 0.92 s on",
        "Simulations, Figure 8",
        "Figure 8; the swing was chosen for it",
        _constant_since,
        put_in=True,
    ),
    Claim(
        "They become constant because balance can no longer be kept from then on",
        "Simulations",
        "Figures 5 and 8, Results",
        _balance_lost_then,
    ),
    Claim(
        "The technique provides torques during the whole trajectory",
        "Simulations, Figure 8",
        "Figure 8, Results",
        _torques_throughout,
    ),
    Claim("Balance is assured", "Abstract, Introduction", "Results, gain sweep", _assured, universal=True),
)
