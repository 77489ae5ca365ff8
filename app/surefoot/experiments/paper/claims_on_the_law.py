"""What the paper claims of the law itself: delta_P, smoothness, independence, neglected terms."""

import numpy as np

from surefoot.control.delta_reference import standing_prediction
from surefoot.control.registry import controller_named
from surefoot.dynamics.model import DynamicsModel
from surefoot.experiments.paper.claims import Check, Claim, outcome, stands
from surefoot.experiments.paper.findings import Findings, com_error, torque_travel
from surefoot.experiments.paper.plan import (
    DELTA_REFERENCE,
    GRAVITY_ONLY,
    NO_SPLIT,
    NO_TANGENTIAL,
    OVERRIDE,
    STONE,
    SWING,
    SWING_HARDER,
)
from surefoot.experiments.scenario.references import start_posture
from surefoot.experiments.scenario.scenario import load_scenario
from surefoot.robot.description import load_robot

_AT_REST_NM = 1.0
_AGREE = 0.1
_AS_GOOD = 1.1
_WITHIN = 0.05


def _smoother(f: Findings) -> list[Check]:
    checks = []
    for scenario in (SWING, SWING_HARDER):
        ours = f.run(scenario, "two-part")
        for who, other in (
            ("the unlatched baseline", f.run(scenario, "optimization")),
            ("soft-qp", f.run(scenario, "soft-qp")),
        ):
            until = min(float(run.column("time_s")[-1]) for run in (ours, other))
            a, b = 1e3 * com_error(ours, until), 1e3 * com_error(other, until)
            where = f"{scenario} until {until:.2f} s"
            checks.append(Check(a < b, f"{where}, CoM error (rms): two-part {a:.2f} mm, {who} {b:.2f} mm"))
            a, b = torque_travel(ours, until), torque_travel(other, until)
            text = f"{where}, travel of Gamma_5 and Gamma_6: two-part {a:.0f} N m, {who} {b:.0f} N m"
            checks.append(Check(a < b, text))
    return checks


def _independent(f: Findings) -> list[Check]:
    checks = []
    for scenario in (SWING, SWING_HARDER, STONE):
        consistent, override = f.run(scenario, "two-part"), f.run(scenario, "two-part", OVERRIDE)
        a, b = 1e3 * consistent.summary["com_error_max_m"], 1e3 * override.summary["com_error_max_m"]
        checks.append(stands(f"{scenario}: ankles overridden afterwards,", override))
        text = f"{scenario}: CoM error at most {b:.1f} mm overridden, {a:.1f} mm when the other joints take part"
        checks.append(Check(b <= _AS_GOOD * a, text))
    return checks


def _delta_zero(f: Findings) -> list[Check]:
    run = f.run(SWING, "two-part")
    checks = []
    for plane, axis in (("frontal", "x"), ("sagittal", "y")):
        commanded, measured = (run.column(f"delta_{kind}_{axis}_nm") for kind in ("commanded", "measured"))
        peak, end = float(np.abs(commanded).max()), max(abs(float(commanded[-1])), abs(float(measured[-1])))
        checks.append(Check(end < _AT_REST_NM, f"{plane}: peak {peak:.1f} N m, {end:.2f} N m at the end"))
    commanded, measured = (run.column(f"delta_{kind}_x_nm") for kind in ("commanded", "measured"))
    rms = float(np.sqrt(((commanded - measured) ** 2).mean())) / max(float(np.abs(commanded).max()), 1e-9)
    checks.append(Check(rms < _AGREE, f"frontal: measured follows commanded to {100 * rms:.1f} % of its peak (rms)"))
    return checks


def _zero_keeps_balance(f: Findings) -> list[Check]:
    checks = []
    for scenario in (SWING, STONE):
        run = f.run(scenario, "two-part", GRAVITY_ONLY)
        error = 1e3 * run.summary["com_error_max_m"]
        text = f"{scenario}: with delta_P = 0 imposed two-part {outcome(run)}, CoM error at most {error:.0f} mm"
        follows = outcome(f.run(scenario, "two-part"))
        checks.append(Check(not run.fell, f"{text} (with that of the tracking law it {follows})"))
    return checks


def _tangential(f: Findings) -> list[Check]:
    checks = []
    for scenario in (SWING, SWING_HARDER, STONE):
        without = f.run(scenario, "two-part", NO_TANGENTIAL)
        kept, lost = (1e3 * run.summary["zmp_margin_min_m"] for run in (f.run(scenario, "two-part"), without))
        checks.append(stands(f"{scenario}: P on the ground without the term,", without))
        text = f"{scenario}: least ZMP margin {lost:+.2f} mm without it, {kept:+.2f} mm with P at the ankle"
        checks.append(Check(lost > min(kept - 0.5, 0.0), text))
    return checks


def _each_leg(f: Findings) -> list[Check]:
    whole, split = f.run("stand_double", "two-part-literal", NO_SPLIT), f.run("stand_double", "two-part")
    limit, when = whole.summary["first_limit"], whole.summary["first_limit_time_s"]
    rolled = f"its first limit goes at {when:.3f} s ({limit}: the soles roll over)" if limit else "no limit goes"
    return [
        Check(
            not whole.fell,
            f"two-part-literal on both feet, each ankle given the whole F_N, {outcome(whole)} "
            f"(two-part, which shares the load by the lever rule, {outcome(split)})",
        ),
        Check(limit is None, rolled),
    ]


def _strong_enough(f: Findings) -> list[Check]:
    robot, checks = load_robot("bip"), []
    for number in ("5", "6"):
        limit = robot.joint_numbered(int(number)).torque_limit_nm
        for who in ("two-part", "two-part-literal"):
            peak = f.run(SWING, who).summary["torque_peak_nm"][number]
            checks.append(Check(peak < limit, f"{who}: |Gamma_{number}| at most {peak:.1f} of {limit:.0f} N m"))
    return checks


def _reference_usable(f: Findings) -> list[Check]:
    run, scenario = f.run(DELTA_REFERENCE, "two-part"), load_scenario(DELTA_REFERENCE)
    robot = scenario.robot_description()
    settings = controller_named("two-part").settings(scenario.controller)
    predicted = 1e3 * float(standing_prediction(DynamicsModel(robot), start_posture(scenario), settings)[1])
    found = 1e3 * float(run.column("com_y_m")[-1] - run.column("com_ref_y_m")[-1])
    bias = settings.delta_ref_frontal_nm
    return [
        stands(f"with delta_ref = {bias:g} N m, two-part", run),
        Check(
            abs(found - predicted) < _WITHIN * abs(predicted),
            f"the CoM moves by {found:.2f} mm, as predicted ({predicted:.2f} mm)",
        ),
    ]


LAW_CLAIMS = (
    Claim("Tracking becomes smoother", "Abstract, Introduction", "Figures 6 and 8", _smoother),
    Claim(
        "The rest of the robot can be controlled independently of the ankles",
        "Abstract, Introduction",
        "Results (composition = override)",
        _independent,
    ),
    Claim("delta_P is brought to its reference, 0", "Simulations, Figure 9", "Figure 9", _delta_zero),
    Claim(
        "delta_P = 0 is what keeps the balance",
        "Simulations, Figure 9",
        "Results (delta_source = gravity)",
        _zero_keeps_balance,
    ),
    Claim(
        "The tangential contact force can be ignored in (28)", "Before (28)", "Results (p_point = ground)", _tangential
    ),
    Claim("(28) with the total F_N serves each leg", "(28), Figure 4", "Results (stand_double)", _each_leg),
    Claim("The torques suit a robot of 105 kg", "Conclusions", "Results; the limits are chosen", _strong_enough),
    Claim(
        "A reference delta_P other than 0 can be used",
        "Conclusions (future work)",
        "Results (paper_delta_reference)",
        _reference_usable,
    ),
)
